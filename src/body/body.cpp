// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/body.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "registration.h"

namespace cellwalk {

namespace {

/// As is_before(), but among contacts of several edges the half-facet says nothing: ties go to the first edge.
template <int D>
bool meets_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.impact <=> b.impact; order != 0) return order < 0;
  return std::tuple(a.body, a.kind) < std::tuple(b.body, b.kind);
}

}  // namespace

template <int D>
Body<D>::Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup)
    : Body(snapshot, locator, soup, {}) {}

template <int D>
Body<D>::Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
              std::span<const Particle<D>> before)
    : snapshot_(&snapshot),
      epoch_(snapshot.epoch()),
      positions_(soup.points),
      edges_(soup.edges),
      is_outside_(soup.points.size()),
      outside_near_(soup.points.size()),
      vertex_behind_(soup.points.size()),
      edge_behind_(soup.edges.size()) {
  detail::Registered<D> registered = detail::register_body(snapshot, locator, soup, before);
  particles_ = std::move(registered.particles);
  chains_ = std::move(registered.chains);
  link_edges();
  if (D != 3 || soup.faces.empty()) return;
  faces_ = soup.faces;
  link_faces();
  Face_counts counts;
  register_faces(Error_code::outside, counts);
}

template <int D>
void Body<D>::register_again(const Locator<D>& locator) {
  *this = Body(*snapshot_, locator, {positions_, edges_, faces_}, particles_);
}

template <int D>
void Body<D>::link_edges() {
  corner_begin_.assign(positions_.size() + 1, 0);
  for (const auto& [u, v] : edges_) {
    ++corner_begin_[u + 1];
    ++corner_begin_[v + 1];
  }
  for (std::size_t v = 0; v < positions_.size(); ++v) corner_begin_[v + 1] += corner_begin_[v];
  corners_.resize(2 * edges_.size());
  std::vector<std::uint32_t> next(corner_begin_.begin(), corner_begin_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const auto [u, v] = edges_[e];
    corners_[next[u]++] = {e, v, false};
    corners_[next[v]++] = {e, u, true};
  }
}

template <int D>
Chain Body<D>::seen_from(const Corner& corner) const {
  const Chain& chain = chains_[corner.edge];
  return corner.is_reversed && !chain.empty() ? reversed(*snapshot_, chain) : chain;
}

template <int D>
std::optional<Body_contact<D>> Body<D>::move_vertex(std::uint32_t vertex, const Point<D>& target,
                                                    const Body_options& options, Body_counts& counts) {
  leave_region(counts);  // which asks for the epoch
  return try_move(vertex, target, options, counts);
}

template <int D>
std::optional<Body_contact<D>> Body<D>::try_move(std::uint32_t vertex, const Point<D>& target,
                                                 const Body_options& options, Body_counts& counts, bool any) {
  if (options.sweep.sweep == Sweep::faces) take_up_faces(counts);
  if (target == positions_[vertex]) return {};
  catch_up_vertex(vertex, counts);
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i)
    catch_up_edge(corners_[i].edge, counts);
  const Particle<D> from = particles_[vertex];
  Particle<D> to = from;
  visited_.clear();
  crossed_.clear();
  const Walk_result<D> walked =
      move(*snapshot_, to, target, counts.edges.walk, {Walk_strategy::certified, &visited_, &crossed_});
  to.position = target;
  const Way<D> way{from, to, visited_, crossed_, walked.contact.has_value()};
  std::optional<Body_contact<D>> first;
  if (walked.contact)
    first = {vertex_contact(*snapshot_, from.position, target, *walked.contact, counts.edges.walk), vertex,
             vertex};
  else if (options.sweep.touch == Touch::stop)
    if (const auto touch = first_touch(*snapshot_, from, target, counts.edges))
      first = {*touch, vertex, vertex};
  if (any && first) return first;

  moved_chains_.resize(corner_begin_[vertex + 1] - corner_begin_[vertex]);
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i) {
    const Corner& corner = corners_[i];
    Sweep_result<D> swept = sweep_edge_along(*snapshot_, way, particles_[corner.other], seen_from(corner),
                                             options.sweep, counts.edges);
    if (swept.contact && (!first || meets_before(*swept.contact, first->contact))) {
      const bool is_edge = swept.contact->body == Body_feature::edge;
      first = {*swept.contact, vertex, is_edge ? corner.edge : vertex};
      if (any) return first;
    }
    Moved_chain& moved = moved_chains_[i - corner_begin_[vertex]];
    moved.chain = swept.chain;
    moved.is_free = !swept.contact;
    moved.is_behind = false;
  }
  moved_rests_.clear();
  if (options.sweep.sweep == Sweep::faces) sweep_faces(vertex, way, first, counts);
  if (first) return first;
  are_faces_swept_ &= options.sweep.sweep == Sweep::faces;
  is_apart_ = false;
  for (const auto& [face, rests] : moved_rests_) rests_[face] = rests;
  commit(vertex, to);
  return {};
}

/// Takes the chains of a moved vertex over, and its place.
template <int D>
void Body<D>::commit(std::uint32_t vertex, const Particle<D>& particle) {
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i) {
    const Corner& corner = corners_[i];
    const Moved_chain& moved = moved_chains_[i - corner_begin_[vertex]];
    edge_behind_[corner.edge] = moved.is_behind;
    if (moved.is_behind) continue;
    chains_[corner.edge] =
        corner.is_reversed && !moved.chain.empty() ? reversed(*snapshot_, moved.chain) : moved.chain;
  }
  particles_[vertex] = particle;
  place(vertex, particle.position);
}

template <int D>
std::vector<std::uint32_t> Body<D>::neighbours(std::uint32_t vertex) const {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i)
    result.push_back(corners_[i].other);
  return result;
}

template <int D>
void Body<D>::validate() const {
  check_epoch();
  Walk_counts counts;
  for (std::size_t v = 0; v < particles_.size(); ++v) {
    const Particle<D>& p = particles_[v];
    if (p.position == positions_[v] && p.cell != Cell::none && !snapshot_->is_solid(p.cell) &&
        in_closure(*snapshot_, p.cell, p.position))
      continue;
    throw Error(Error_code::other,
                fmt::format("vertex {} of a body is not in the closure of its cell, at ({})", v,
                            fmt::join(p.position, ", ")));
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [u, v] = edges_[e];
    if (is_chain(*snapshot_, particles_[u], particles_[v], chains_[e], counts)) continue;
    throw Error(Error_code::other,
                fmt::format("edge {} of a body has no valid chain, from ({}) to ({})", e,
                            fmt::join(positions_[u], ", "), fmt::join(positions_[v], ", ")));
  }
  if (!are_faces_swept_) return;
  Face_counts face_counts;
  for (std::uint32_t f = 0; f < rests_.size(); ++f) {
    const Face_registration found = register_face_here(f, face_counts);
    if (found.piercing == Half_facet::none && found.rests == rests_[f]) continue;
    throw Error(Error_code::other, fmt::format("a wall pierces face {} of a body, at ({})", f,
                                               fmt::join(positions_[faces_[f][0]], ", ")));
  }
}

// With the accessors of the header, which unoptimised builds need; other members are compiled in files of their own.
template class Body<2>;
template class Body<3>;

}  // namespace cellwalk
