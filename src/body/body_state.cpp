// SPDX-License-Identifier: LGPL-3.0-or-later
// Untested moves in regions free of walls, and the registration of stale vertices and edges afterwards.
#include "body_state.h"

#include <utility>

#include "body/step/chains_in_place.h"

namespace cellwalk::detail {

Body_certificates worthwhile(Body_certificates chosen, const Body_topology& topology, std::size_t vertices) {
  if (vertices < chosen.least_vertices_of_parts ||
      topology.edges().size() >= chosen.least_edges_a_vertex * vertices)
    return chosen;
  chosen.body_region = chosen.star_regions = false;
  return chosen;
}

template <int D>
Body_state<D>::Body_state(const Snapshot<D>& of_snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                          const Registered_before<D>& before, const Body_certificates& of_body)
    : Body_state(of_snapshot, soup.points,
                 Body_topology(soup.points.size(), soup.edges,
                               D == 3 ? soup.faces : std::vector<std::array<std::uint32_t, 3>>()),
                 soup.radii, of_body) {
  Registered<D> registered = register_body(of_snapshot, locator, soup, before);
  particles = std::move(registered.particles);
  chains = std::move(registered.chains);
  pool.prepare(of_snapshot, particles);
  // Without regions the first step tests all edges.
  const Body_certificates used = worthwhile(of_body, topology, positions.size());
  if (!used.body_region && !used.star_regions)
    for (std::uint32_t e = 0; e < chains.size(); ++e) read_corners(e);
}

template <int D>
Body_state<D>::Body_state(const Snapshot<D>& of_snapshot, std::vector<Point<D>> points, Body_topology joined,
                          std::span<const double> radii, const Body_certificates& of_body)
    : snapshot(&of_snapshot),
      epoch(of_snapshot.epoch()),
      positions(std::move(points)),
      topology(std::move(joined)),
      particles(positions.size()),
      chains(topology.edges().size()),
      corners_of_chains(chains.size()),
      corners_epoch(of_snapshot.geometry_epoch()),
      supporting_walls(topology.faces().size()),
      thick(radii, topology, positions.size()),
      region(positions.size(), topology.edges().size(), worthwhile(of_body, topology, positions.size()),
             thick.largest()),
      pool(positions.size(), worthwhile(of_body, topology, positions.size()), thick.largest()),
      certificates(of_body) {}

template <int D>
void Body_state<D>::begin_regions(const Body_certificates& chosen) {
  give_region_up();
  certificates = chosen;
  const Body_certificates used = worthwhile(chosen, topology, positions.size());
  region = Region_cache<D>(positions.size(), chains.size(), used, thick.largest());
  pool = Region_pool<D>(positions.size(), used, thick.largest());
  pool.prepare(*snapshot, particles);
}

template <int D>
Body_soup<D> Body_state<D>::soup() const {
  Body_soup<D> result{positions, topology.edges(), topology.faces()};
  if (thick.radius_of_vertices() > 0)
    result.radii = {thick.radius_of_vertices()};
  else
    result.radii.assign(thick.radii().begin(), thick.radii().end());
  return result;
}

template <int D>
Chain Body_state<D>::seen_from(const Corner& corner) const {
  const Chain& chain = chains[corner.edge];
  return corner.is_reversed && !chain.empty() ? reversed(*snapshot, chain) : chain;
}

template <int D>
void Body_state<D>::set_chain(std::uint32_t edge, const Chain& chain) {
  chains[edge] = chain;
  corners_of_chains[edge].clear();
}

template <int D>
void Body_state<D>::read_corners(std::uint32_t edge) {
  std::vector<Facet_corners<D>>& corners = corners_of_chains[edge];
  try {
    corners.reserve(2 * chains[edge].size());
    for (const Half_facet f : chains[edge]) append_corners(*snapshot, f, corners);
  } catch (...) {  // memory ran out: a part must not be taken for all
    corners.clear();
    throw;
  }
}

template <int D>
void Body_state<D>::forget_corners() {
  for (auto& corners : corners_of_chains) corners.clear();
  corners_epoch = snapshot->geometry_epoch();
}

/// Not to be inlined: the step before is short.
template <int D>
[[gnu::noinline]] bool Body_state<D>::try_move_all_in_new_region(std::span<const Point<D>> targets,
                                                                 bool clearance, Body_counts& counts) {
  pool.begin_step(clearance);
  if (region.holds_body()) is_apart = true;
  if (!clearance) {
    const bool was_apart = is_apart;
    refresh_all(counts);
    give_region_up();
    is_apart = was_apart;
    return false;
  }
  if (!renew_region(targets, counts)) {
    spread_marks();
    return false;
  }
  move_all(targets, counts);
  return true;
}

template <int D>
bool Body_state<D>::move_in_region(std::uint32_t vertex, const Point<D>& target, Body_counts& counts) {
  move_untested(vertex, target, counts);
  if (pool.holds(vertex)) pool.forget(vertex);
  return true;
}

template <int D>
bool Body_state<D>::try_move_in_pool(std::uint32_t vertex, const Point<D>& target, Body_counts& counts) {
  if (!pool.try_move_in_known(vertex, target, topology)) {
    if (!pool.try_move_in_other(vertex, target, positions, topology)) {
      if (!pool.should_search(vertex)) return false;
      refresh_vertex(vertex, counts);
      if (!pool.search(*snapshot, particles[vertex], vertex, target, positions, topology, counts) ||
          !pool.try_move_in_known(vertex, target, topology))
        return false;
    }
  }
  move_untested(vertex, target, counts);
  if (region.has_region()) region.set_outside(vertex, !region.holds(target), topology);
  return true;
}

template <int D>
inline void Body_state<D>::move_untested(std::uint32_t vertex, const Point<D>& target, Body_counts& counts) {
  positions[vertex] = target;
  region.mark_moved(vertex);
  if (may_have_supporting_walls)
    for (const Face_corner& corner : topology.face_corners_of(vertex)) supporting_walls[corner.face].clear();
  ++counts.in_region;
}

template <int D>
void Body_state<D>::give_region_up() {
  region.give_up();
  pool.clear();
  is_apart = false;  // walls may be put up next
}

/// Looks for a region that holds the body where it is and where it goes; vertices outside of it are
/// registered. True if it holds all.
template <int D>
bool Body_state<D>::renew_region(std::span<const Point<D>> targets, Body_counts& counts) {
  if (region.must_wait()) return false;
  spread_marks();
  const std::uint32_t anchor = region.anchor_vertex();
  refresh_vertex(anchor, counts);
  const auto found = region.search(*snapshot, particles[anchor], positions, targets, counts);
  // Vertices that leave the old region are registered while that is still there.
  if (region.loses_vertices(found, positions))
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      const bool is_outside = !found || !found->holds(positions[v]);
      region.set_outside(v, is_outside, topology);
      if (is_outside && !pool.holds(v)) refresh_vertex(v, counts);
    }
  return region.take(found, targets, counts);
}

template <int D>
void Body_state<D>::spread_marks() {
  if (!region.are_all_stale()) return;
  region.spread_marks();
  pool.forget_all();
  if (may_have_supporting_walls)
    for (Supporting_walls& of_face : supporting_walls) of_face.clear();
  may_have_supporting_walls = false;
}

template <int D>
inline void Body_state<D>::follow(std::uint32_t vertex, Particle<D>& particle, Walk_counts& walks) const {
  const Point<D>& position = positions[vertex];
  // The pool is out of date once all vertices were moved at once.
  const bool is_in_pool = !region.are_all_stale() && pool.holds(vertex);
  const Particle<D>& anchor = is_in_pool ? pool.region_of(vertex).anchor() : region.anchor();
  // A point strictly inside a cell is in no other one, whichever way it came. Else, between two points of the
  // region is no wall.
  Cell cell = particle.cell;
  if (!certainly_inside(*snapshot, cell, position, walks))
    cell = certain_end(*snapshot, anchor, position, walks);
  if (cell != Cell::none) {
    particle = {position, cell, D, 0};
    return;
  }
  particle = anchor;
  cellwalk::move(*snapshot, particle, position, walks);
}

template <int D>
void Body_state<D>::refresh_vertex(std::uint32_t vertex, Body_counts& counts) {
  if (!region.is_vertex_stale(vertex)) return;
  region.pass_mark_on(vertex, topology);
  thick.forget_vertex(topology, vertex);
  Particle<D>& particle = particles[vertex];
  // On a facet, a vertex that is where it was keeps its cell: on which side of walls in that plane it slides
  // depends on it.
  if (particle.position == positions[vertex]) return;
  ++counts.catch_ups;
  follow(vertex, particle, counts.edges.walk);
}

template <int D>
void Body_state<D>::refresh_edge(std::uint32_t edge, Body_counts& counts) {
  const auto [u, v] = topology.edges()[edge];
  refresh_vertex(u, counts);
  refresh_vertex(v, counts);
  if (!region.is_edge_stale(edge)) return;
  region.mark_edge(edge, false);
  thick.forget(topology, edge);
  const Particle<D>&p = particles[u], &q = particles[v];
  // Between points inside of a cell there is but one chain.
  if (p.dimension == D && q.dimension == D && p.cell == q.cell) return set_chain(edge, {});
  set_chain(edge, find_any_chain(*snapshot, p, q, counts.edges.walk).chain);
}

template <int D>
void Body_state<D>::refresh_all(Body_counts& counts) {
  spread_marks();
  for (std::uint32_t v = 0; v < positions.size(); ++v) refresh_vertex(v, counts);
  for (std::uint32_t e = 0; e < chains.size(); ++e) refresh_edge(e, counts);
}

template <int D>
void Body_state<D>::commit(std::uint32_t vertex, const Particle<D>& particle,
                           std::vector<Moved_chain<D>>& moved) {
  const auto corners = topology.corners_of(vertex);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    region.mark_edge(corner.edge, moved[i].is_stale);
    if (moved[i].is_stale) continue;
    if (moved[i].is_in_place) {
      Edge_words<D>(*this).take_over(corner);
      continue;
    }
    const Chain& chain = moved[i].chain;
    if (moved[i].is_relinked) {
      chains[corner.edge] = chain;
      corners_of_chains[corner.edge].swap(moved[i].corners);
      continue;
    }
    set_chain(corner.edge, corner.is_reversed && !chain.empty() ? reversed(*snapshot, chain) : chain);
  }
  particles[vertex] = particle;
  place(vertex, particle.position);
}

template <int D>
void Body_state<D>::place(std::uint32_t vertex, const Point<D>& position) {
  positions[vertex] = position;
  if (region.has_region()) region.set_outside(vertex, !region.holds(position), topology);
  pool.place(vertex, position);
}

template struct Body_state<2>;
template struct Body_state<3>;

}  // namespace cellwalk::detail
