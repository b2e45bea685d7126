// SPDX-License-Identifier: LGPL-3.0-or-later
// The first contact of a vertex, its edges and its faces, on each combination of sides of walls.
#include "vertex_move.h"

#include <cellwalk/internal/edge/edge_contact.h>
#include <cellwalk/internal/edge/furthest_move.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/kernel/uncertified.h>

#include <utility>

#include "body/shape/body_faces.h"
#include "chains_in_place.h"
#include "meets_before.h"

namespace cellwalk::detail {
namespace {

/// Writes the chain of an edge that is in place or relinked as it is seen from the vertex.
template <int D>
void show_chain(Body_state<D>& body, const Corner& corner, Moved_chain<D>& moved) {
  if (moved.is_in_place) moved.chain = Edge_words<D>(body).chain(corner);
  if (corner.is_reversed) moved.chain = reversed(*body.snapshot, moved.chain);
  moved.is_relinked = false;
}

/// As find_contact(), while the vertex takes the given sides of walls or, without, those that it prefers.
/// \pre its edges are not stale
template <int D>
std::optional<Contact<D>> contact_on_sides(Body_state<D>& body, Move_scratch<D>& scratch,
                                           std::uint32_t vertex, const Point<D>& target,
                                           const Sweep_options& options, Body_counts& counts, bool any,
                                           Particle<D>& to, Sides_taken* choices, Walk_result<D>& walked) {
  const Snapshot<D>& snapshot = *body.snapshot;
  const auto corners = body.topology.corners_of(vertex);
  const Particle<D> from = body.particles[vertex];
  to = from;
  scratch.clear_walk();
  walked = move_on_sides(snapshot, to, target, counts.edges.walk, {&scratch.visited, &scratch.crossed, !any},
                         choices);
  to.position = target;
  const Vertex_path<D> path{from, to, scratch.visited, scratch.crossed, walked.contact.has_value()};
  std::optional<Contact<D>> first;
  const auto keep = [&](const Contact<D>& contact, std::uint32_t feature) {
    first = contact;
    first->vertex = vertex;
    first->feature = feature;
  };
  if (walked.contact)
    keep(vertex_contact(snapshot, from.position, target, *walked.contact, counts.edges.walk), vertex);
  // Before it is blocked, a vertex may touch walls that no edge touches off its start: edges may lie in its
  // line.
  if (options.touch == Touch::stop && !(any && first))
    if (const auto touch = first_touch(snapshot, from, target, counts.edges))
      if (!first || meets_before(*touch, *first)) keep(*touch, vertex);
  if (any && first) return first;

  scratch.take_up_chains(corners.size());
  Float_point<D> mapped{};
  const bool may_confirm = may_be_in_place(body, options, false) && snapshot.frame().map(target, mapped);
  Chains_in_place<D> in_place(body, to, mapped, path.blocked);
  const Half_facet wall = path.blocked ? walked.contact->facet : Half_facet::none;
  const bool may_relink = may_confirm && (!path.blocked || walked.contact->kind == Contact_kind::facet);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    Moved_chain<D>& moved = scratch.chains[i];
    moved.is_stale = moved.is_relinked = false;
    moved.is_in_place = may_confirm && in_place.confirms(corner);
    bool meets_wall = false;
    if (may_relink && !moved.is_in_place) {
      const Relink_answer relinked = in_place.relink(corner, from, wall, moved);
      moved.is_relinked = relinked == Relink_answer::free;
      meets_wall = relinked == Relink_answer::blocked;
    }
    moved.is_free = moved.is_in_place || moved.is_relinked;
    if (moved.is_free) {
      // Faces look into the chains of their sides.
      if (options.sweep == Sweep::faces) show_chain(body, corner, moved);
      continue;
    }
    if (any && options.touch == Touch::pass) {
      // Walls that an edge meets on the way count only where triangles are swept.
      auto free = meets_wall && options.sweep != Sweep::three_segments
                      ? std::nullopt
                      : free_chain(snapshot, path, body.particles[corner.other], body.seen_from(corner),
                                   options, counts.edges);
      if (!free) {
        in_place.add_to(counts.edges);
        return Contact<D>{};
      }
      moved.chain = std::move(free->chain);
      moved.is_free = true;
      continue;
    }
    std::optional<Contact<D>> met;
    if (meets_wall && body.particles[corner.other].dimension == D)
      met = contact_at_ridge<D>(snapshot, {from.position, target, body.particles[corner.other].position},
                                scratch.relink);
    Sweep_result<D> swept = sweep_edge_along(snapshot, path, body.particles[corner.other],
                                             body.seen_from(corner), options, counts.edges, met);
    if (swept.contact && (!first || meets_before(*swept.contact, *first))) {
      keep(*swept.contact, swept.contact->body == Body_feature::edge ? corner.edge : vertex);
      if (any) break;
    }
    moved.chain = swept.chain;
    moved.is_free = !swept.contact;
  }
  in_place.add_to(counts.edges);
  if (any && first) return first;
  scratch.supporting_walls.clear();
  if constexpr (D == 3)
    if (options.sweep == Sweep::faces && body.has_thin(vertex, options.sweep))
      sweep_faces(body, scratch, vertex, path, first, counts.faces);
  return first;
}

template <int D>
void refresh_star(Body_state<D>& body, std::uint32_t vertex, Body_counts& counts) {
  body.refresh_vertex(vertex, counts);
  for (const Corner& corner : body.topology.corners_of(vertex)) body.refresh_edge(corner.edge, counts);
}

/// The first contact of a vertex if one of its edges or faces with a radius is in the way. If none is, those
/// without one are left.
template <int D>
std::optional<Contact<D>> contact_of_thick(Body_state<D>& body, Move_scratch<D>& scratch,
                                           std::uint32_t vertex, const Point<D>& target,
                                           const Sweep_options& options, Body_counts& counts, bool any) {
  refresh_star(body, vertex, counts);
  if (body.thick.is_free(body, vertex, target, options.sweep)) return {};
  if (any) return Contact<D>{};
  auto first = body.thick.first_contact(body, vertex, target, options.sweep);
  if (!first) refuse_uncertified();
  if (body.has_thin(vertex, options.sweep)) {
    Particle<D> to;
    const auto thin = find_contact(body, scratch, vertex, target, options, counts, any, to);
    if (thin && meets_before(*thin, *first)) first = thin;
  }
  return first;
}

}  // namespace

template <int D>
std::optional<Contact<D>> try_move(Body_state<D>& body, Move_scratch<D>& scratch, std::uint32_t vertex,
                                   const Point<D>& target, const Sweep_options& options, Body_counts& counts,
                                   bool any) {
  if constexpr (D == 3)
    if (options.sweep == Sweep::faces) take_up_faces(body, counts);
  if (target == body.positions[vertex]) return {};
  if (!body.thick.are_none()) [[unlikely]]
    if (auto first = contact_of_thick(body, scratch, vertex, target, options, counts, any)) return first;
  Settled_move<D> settled;
  if (options.sweep != Sweep::faces && may_be_in_place(body, options, false) &&
      try_move_in_place(body, vertex, target, settled, counts)) {
    body.are_faces_swept = false;
    body.is_apart = false;
    return {};
  }
  Particle<D> to;
  if (auto first = find_contact(body, scratch, vertex, target, options, counts, any, to)) return first;
  body.are_faces_swept &= options.sweep == Sweep::faces;
  body.is_apart = false;
  for (const auto& [face, supporting_walls] : scratch.supporting_walls)
    body.supporting_walls[face] = supporting_walls;
  body.may_have_supporting_walls |= !scratch.supporting_walls.empty();
  body.commit(vertex, to, scratch.chains);
  return {};
}

template <int D>
std::optional<Contact<D>> find_contact(Body_state<D>& body, Move_scratch<D>& scratch, std::uint32_t vertex,
                                       const Point<D>& target, const Sweep_options& options,
                                       Body_counts& counts, bool any, Particle<D>& to) {
  refresh_star(body, vertex, counts);
  Walk_result<D> walked;
  const auto move = [&](const Sweep_options& chosen, bool some, Sides_taken* choices) {
    return contact_on_sides(body, scratch, vertex, target, chosen, counts, some, to, choices, walked);
  };
  const Snapshot<D>& snapshot = *body.snapshot;
  const Point<D>& from = body.positions[vertex];
  std::optional<Contact<D>> contact = move(options, any, nullptr);
  if (contact && may_pass_on_other_sides(snapshot, from, target, walked, *contact, options.touch,
                                         counts.edges.walk)) [[unlikely]] {
    Sweep_options exact = options;
    exact.search = nullptr;
    Sides_taken choices;
    contact = furthest_move<D>(snapshot, from, target, choices,
                               [&](Sides_taken& tried) { return move(exact, false, &tried); });
    if (contact && !any) contact = move(options, false, &choices);
  }
  return contact;
}

#define CELLWALK_INSTANTIATE(D)                                                                              \
  template std::optional<Contact<D>> try_move(Body_state<D>&, Move_scratch<D>&, std::uint32_t,               \
                                              const Point<D>&, const Sweep_options&, Body_counts&, bool);    \
  template std::optional<Contact<D>> find_contact(Body_state<D>&, Move_scratch<D>&, std::uint32_t,           \
                                                  const Point<D>&, const Sweep_options&, Body_counts&, bool, \
                                                  Particle<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
