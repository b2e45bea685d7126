// SPDX-License-Identifier: LGPL-3.0-or-later
// A catheter: an elastic rod that is pushed in through an entry, and turned there.
#ifndef CELLWALK_SIMULATION_ROD_H
#define CELLWALK_SIMULATION_ROD_H

#include <cellwalk/body/body.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/simulation/flight.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {
namespace detail {
template <int D>
struct Chain_state;
template <int D>
struct Natural_bend;
}  // namespace detail

/// A rod as a chain of vertices, the tip first. All of them start at the entry; they leave it one after the other as the rod
/// is pushed, so that edges wait there with length 0. A guide in front of the entry holds the base: the rod enters along the first
/// piece of its path.
///
/// The rod has no inertia. A step pushes it by `advance` along where it lies, lets it relax (position-based: links keep their
/// length, bends go back to the natural curve as far as the rod is stiff), and moves vertices and edges there as far as walls
/// allow (Body::step). It turns where its base is turned: the direction in which the tip is curved follows along the rod
/// without a twist of its own.
///
/// A link that walls stretch by half a spacing, and a rod that is pushed together by one, hold the base back until they are relieved.
template <int D>
class Rod {
 public:
  /// The body of a catheter before it enters.
  static Body_soup<D> at_entry(const Catheter<D>& catheter);

  /// At its entry, to be led along way points.
  /// \pre the body is at_entry(catheter), registered; the way begins with the entry, has at least two points, and no two in a row are alike
  Rod(const Snapshot<D>& snapshot, Body<D> body, const Catheter<D>& catheter, std::vector<Point<D>> way);

  /// Pushes it by one step. Contacts are appended. Only what is checked of bodies is taken from the conditions.
  /// Cost: about 1 us a vertex, and that of Body::step.
  void step(const Flight_conditions<D>& conditions, Step_report<D>& report, Body_counts& counts);

  Body<D>& body() { return body_; }
  const Body<D>& body() const { return body_; }
  /// Where the vertices went in the last step, walls or not.
  std::span<const Point<D>> targets() const { return targets_; }
  const Point<D>& tip() const { return body_.positions()[0]; }
  /// The length that has been pushed in.
  double length_inside() const { return inside_; }
  /// How far the base has been turned, in degrees.
  double twist() const { return twist_; }
  std::span<const Point<D>> way() const { return way_; }
  /// The way point that the tip aims at; way().size() once it has arrived.
  std::size_t next_way_point() const { return next_; }
  /// The steps in which the base was held back.
  std::uint32_t steps_waited() const { return waited_; }
  /// It has no velocity of its own.
  Vector<D> velocity() const { return {}; }
  bool has_arrived() const { return next_ == way_.size(); }

 private:
  bool is_held() const;
  bool sees(const Point<D>& x, Body_counts& counts);
  void pass_way_points(Body_counts& counts);
  void aim();
  double along(std::size_t vertex) const;
  detail::Chain_state<D> state() const;
  detail::Natural_bend<D> bend() const;

  const Snapshot<D>* snapshot_;
  Body<D> body_;
  Catheter<D> catheter_;
  std::vector<Point<D>> way_;
  std::vector<Point<D>> targets_;
  Vector<D> direction_{};  ///< of the guide
  Vector<D> heading_{};    ///< where the tip goes
  double inside_ = 0, twist_ = 0;
  std::size_t next_ = 1;
  std::uint32_t waited_ = 0;
};

extern template class Rod<2>;
extern template class Rod<3>;

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_ROD_H
