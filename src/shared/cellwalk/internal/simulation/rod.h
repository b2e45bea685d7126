// SPDX-License-Identifier: LGPL-3.0-or-later
// A catheter: an elastic rod that is pushed in and turned at its base. Theory: docs/deformation.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_ROD_H
#define CELLWALK_INTERNAL_SIMULATION_ROD_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/rigid_body.h>
#include <cellwalk/internal/simulation/saved_parts.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {
namespace detail {
template <int D>
struct Rod_state;
template <int D>
struct Natural_bend;
}  // namespace detail

/// A rod as a polyline of vertices, the tip first. All vertices start at the entry, where edges of length 0
/// wait, and leave it one after the other as the rod is pushed. A guide in front of the entry holds the base,
/// so that the rod enters along the first piece of its path.
///
/// The rod has no inertia. A step pushes it by `advance` along its current shape, relaxes it (position-based:
/// links keep their length, bends return to the natural curve according to the stiffness), and moves vertices
/// and edges as far as walls allow (Body::step). A rotation of the base rotates the direction of the natural
/// curve along the whole rod, which has no twist of its own.
///
/// A link stretched by half a spacing, or a rod compressed by one spacing, holds the base back until the
/// strain is relieved.
template <int D>
class Rod {
 public:
  /// The body of a catheter before it enters.
  static Body_soup<D> at_entry(const Catheter<D>& catheter);

  /// A catheter at its entry.
  /// \param waypoints the first is the entry
  /// \pre the body is at_entry(catheter), registered; the waypoints begin with the entry, are at least two,
  ///      and successive ones differ
  Rod(const Snapshot<D>& snapshot, Body<D> body, const Catheter<D>& catheter,
      std::vector<Point<D>> waypoints);

  /// Pushes the rod by one step. Contacts are appended. Of the conditions only the options for bodies are
  /// used.
  /// \throw Error(input) naming the first vertex whose motion is not finite, and as Body::step
  /// Cost: about 1 us a vertex, and that of Body::step.
  void step(const Dynamics_options<D>& conditions, Step_report<D>& report, Body_counts& counts);

  Body<D>& body() { return body_; }
  const Body<D>& body() const { return body_; }
  /// The targets of the vertices in the last step.
  std::span<const Point<D>> targets() const { return targets_; }
  const Point<D>& tip() const { return body_.positions()[0]; }
  /// The distance between neighbours.
  double spacing() const { return catheter_.spacing; }
  /// The length that has been pushed in.
  double length_inside() const { return inside_; }
  /// The total rotation of the base, in degrees.
  double twist() const { return twist_; }
  std::span<const Point<D>> waypoints() const { return waypoints_; }
  /// The waypoint that the tip aims at; way().size() once it has arrived.
  std::size_t next_waypoint() const { return next_; }
  /// The share of the path that lies behind the tip; 1 once it has arrived.
  double travelled() const;
  /// The number of steps that the rest of the path takes if nothing holds the base back.
  std::size_t steps_left() const;
  /// True if walls hold the base back now.
  bool is_held() const;
  /// True if all of it has been pushed in.
  bool is_all_inside() const { return inside_ >= full_length(); }
  /// The number of steps in which the base was held back.
  std::uint32_t steps_waited() const { return waited_; }
  /// Always zero: the rod has no inertia.
  Vector<D> velocity() const { return {}; }
  bool has_arrived() const { return next_ == waypoints_.size(); }

 private:
  std::pair<double, double> whole_and_left() const;
  double full_length() const { return catheter_.spacing * static_cast<double>(body_.vertex_count() - 1); }
  bool sees(const Point<D>& x, Body_counts& counts);
  void pass_waypoints(Body_counts& counts);
  void aim();
  double along(std::size_t vertex) const;
  detail::Rod_state<D> state() const;
  detail::Natural_bend<D> bend() const;

  const Snapshot<D>* snapshot_;
  Body<D> body_;
  Catheter<D> catheter_;
  std::vector<Point<D>> waypoints_;
  std::vector<Point<D>> targets_;
  Vector<D> direction_{};  ///< of the guide
  Vector<D> heading_{};    ///< direction of the tip
  double inside_ = 0, twist_ = 0;
  std::size_t next_ = 1;
  std::uint32_t waited_ = 0;

  friend detail::State_access<D>;
};

extern template class Rod<2>;
extern template class Rod<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_ROD_H
