// SPDX-License-Identifier: LGPL-3.0-or-later
// The one friend of bodies: the access of the layer reshape while the environment around them changes, and
// their state, from which they are saved and restored.
#ifndef CELLWALK_INTERNAL_BODY_BODY_ACCESS_H
#define CELLWALK_INTERNAL_BODY_BODY_ACCESS_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/kernel/box.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {

template <int D>
class Body_access {
 public:
  explicit Body_access(Body<D>& body) : state_(body.state_.get()) {}

  static Body_state<D>& state_of(Body<D>& body) { return *body.state_; }
  static const Body_state<D>& state_of(const Body<D>& body) { return *body.state_; }
  /// The body that has this state.
  static Body<D> body_of(std::unique_ptr<Body_state<D>> state) { return Body<D>(std::move(state)); }

  const Snapshot<D>& snapshot() const;
  /// \throw Error(usage) if the environment was edited since the body was registered
  void check_epoch() const;
  /// The body is registered in the environment as that is now.
  void follow_epoch();

  /// The box of all places that the registration of the body depends on: its positions, those at which
  /// particles were registered last, the regions free of walls with their anchors, and all within its radii.
  /// Cost: reading them.
  Box<D> reach() const;
  /// Registers stale vertices and edges, and gives regions free of walls up.
  void leave_regions(Body_counts& counts);
  /// True if an edge or a vertex has a radius.
  static bool has_radii(const Body<D>& body);
  /// In the form of Body_soup::radii.
  /// Cost: a copy of the vertices, edges and faces.
  static std::vector<double> radii(const Body<D>& body);
  double radius_of_edge(std::uint32_t edge) const;
  double radius_of_face(std::uint32_t face) const;
  /// 0 if it has edges.
  double radius_of_vertex(std::uint32_t vertex) const;
  double largest_radius() const;
  /// True if no wall pierces a face, and that is to stay so.
  bool keeps_faces() const;

  /// \pre leave_regions() was called
  std::span<Particle<D>> particles();
  Chain& chain(std::size_t edge);
  /// The sides of a face, by edge.
  const std::array<std::uint32_t, 3>& sides(std::uint32_t face) const;
  const Supporting_walls& supporting_walls(std::uint32_t face) const;
  /// False if no face has any.
  bool has_supporting_walls() const;
  /// Takes no memory.
  void rest(std::uint32_t face, Supporting_walls&& walls) noexcept;

  /// Moves a vertex towards a target, as far as walls allow, as a step does; whatever the epoch.
  /// \pre leave_regions() was called; the target is finite
  void push(std::uint32_t vertex, const Point<D>& target, const Body_options& options, Body_counts& counts);

 private:
  Body_state<D>* state_;
};

extern template class Body_access<2>;
extern template class Body_access<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_BODY_BODY_ACCESS_H
