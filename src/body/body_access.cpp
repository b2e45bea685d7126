// SPDX-License-Identifier: LGPL-3.0-or-later
// The box that a body may reach, its cells, chains and supporting walls, read and written by edits.
#include <cellwalk/internal/body/body_access.h>

#include <utility>
#include <vector>

#include "body/step/vertex_move.h"
#include "body_state.h"

namespace cellwalk::detail {
namespace {

template <int D>
void extend(Box<D>& box, const Clear_region<D>& region) {
  Box<D> of_region;
  for (int k = 0; k < D; ++k) {
    of_region.low[k] = region.box().low(k);
    of_region.high[k] = region.box().high(k);
  }
  box.extend(of_region);
  box.extend(region.anchor().position);
}

}  // namespace

template <int D>
const Snapshot<D>& Body_access<D>::snapshot() const {
  return *state_->snapshot;
}

template <int D>
void Body_access<D>::check_epoch() const {
  state_->check_epoch();
}

template <int D>
void Body_access<D>::follow_epoch() {
  state_->epoch = state_->snapshot->epoch();
}

template <int D>
Box<D> Body_access<D>::reach() const {
  Box<D> box;
  for (const Point<D>& x : state_->positions) box.extend(x);
  for (const Particle<D>& particle : state_->particles) box.extend(particle.position);
  if (const Clear_region<D>* region = state_->region.region()) extend(box, *region);
  for (const Clear_region<D>& region : state_->pool.regions()) extend(box, region);
  return enlarged(box, largest_radius());
}

template <int D>
void Body_access<D>::leave_regions(Body_counts& counts) {
  state_->refresh_all(counts);
  state_->give_region_up();
}

template <int D>
bool Body_access<D>::has_radii(const Body<D>& body) {
  return !body.state_->thick.are_none();
}

template <int D>
std::vector<double> Body_access<D>::radii(const Body<D>& body) {
  return body.state_->soup().radii;
}

template <int D>
double Body_access<D>::radius_of_edge(std::uint32_t edge) const {
  return state_->thick.radius(edge);
}

template <int D>
double Body_access<D>::radius_of_face(std::uint32_t face) const {
  return state_->thick.radius_of_face(state_->topology, face);
}

template <int D>
double Body_access<D>::radius_of_vertex(std::uint32_t vertex) const {
  return state_->topology.corners_of(vertex).empty() ? state_->thick.radius_of_vertices() : 0;
}

template <int D>
double Body_access<D>::largest_radius() const {
  return state_->thick.largest();
}

template <int D>
bool Body_access<D>::keeps_faces() const {
  return state_->are_faces_swept && !state_->topology.faces().empty();
}

template <int D>
std::span<Particle<D>> Body_access<D>::particles() {
  return state_->particles;
}

template <int D>
Chain& Body_access<D>::chain(std::size_t edge) {
  state_->corners_of_chains[edge].clear();
  return state_->chains[edge];
}

template <int D>
const std::array<std::uint32_t, 3>& Body_access<D>::sides(std::uint32_t face) const {
  return state_->topology.sides(face);
}

template <int D>
const Supporting_walls& Body_access<D>::supporting_walls(std::uint32_t face) const {
  return state_->supporting_walls[face];
}

template <int D>
bool Body_access<D>::has_supporting_walls() const {
  return state_->may_have_supporting_walls;
}

template <int D>
void Body_access<D>::rest(std::uint32_t face, Supporting_walls&& walls) noexcept {
  state_->may_have_supporting_walls |= !walls.empty();
  state_->supporting_walls[face] = std::move(walls);
}

template <int D>
void Body_access<D>::push(std::uint32_t vertex, const Point<D>& target, const Body_options& options,
                          Body_counts& counts) {
  Body_options pushed = options;
  if (keeps_faces()) pushed.sweep.sweep = Sweep::faces;
  std::vector<Contact<D>> contacts;
  move_along_walls(*state_, vertex, target, pushed, contacts, counts);
}

template class Body_access<2>;
template class Body_access<3>;

}  // namespace cellwalk::detail
