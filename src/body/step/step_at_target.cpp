// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of the paper, vertex by vertex: a move is made on the first sides that do not block it.
#include "step_at_target.h"

#include <cellwalk/internal/edge/furthest_move.h>
#include <cellwalk/internal/edge/sweep_along.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "chains_in_place.h"
#include "vertex_move.h"

namespace cellwalk::detail {

/// Moves vertex by vertex. Not to be inlined: the step before is short.
template <int D>
[[gnu::noinline]] void Target_step<D>::move_each(std::span<const Point<D>> targets, bool reports_blocked,
                                                 Step_report<D>& report) {
  update_is_apart();
  const bool in_place = body_.thick.are_none() && may_be_in_place(body_, sweep_, body_.is_apart);
  for (std::uint32_t v = 0; v < targets.size(); ++v) {
    if (body_.try_move_in_region(v, targets[v], counts_)) continue;
    // Its edges were tested when their other ends moved.
    if ((in_place || sweep_.touch == Touch::pass) && targets[v] == body_.positions[v]) continue;
    Settled_move<D> settled;
    if (in_place && try_move_in_place(body_, v, targets[v], settled, counts_)) {
      body_.are_faces_swept = false;
      continue;
    }
    Tried_move<D> tried = try_to_move(v, targets[v], settled);
    Rejected_move<D>& answer = tried.answer;
    if (!answer.is_vertex_blocked && (answer.edges | answer.swept_edges) == 0) continue;
    counts_.contacts += answer.stays();
    counts_.held += answer.stays();
    if (!reports_blocked) {
      if (answer.stays()) report.contacts.push_back(first_contact(answer, targets[v]));
      continue;
    }
    report.blocked.push_back(std::move(answer));
    locate_wall(report.blocked.back(), tried.met, targets[v]);
  }
}

/// The edge of a vertex that is the first to be blocked.
template <int D>
const Corner& Target_step<D>::first_blocked(const Rejected_move<D>& blocked) const {
  return body_.topology.corners_of(blocked.vertex)[static_cast<std::size_t>(std::countr_zero(blocked.edges))];
}

/// Completes the contact of a vertex that stays: walks and searches of chains left out where the wall is.
template <int D>
void Target_step<D>::locate_wall(Rejected_move<D>& answer, std::optional<Contact<D>>& met,
                                 const Point<D>& target) const {
  if (!answer.stays()) return;
  if (met) {
    const Point<D>& at = body_.positions[answer.vertex];
    const bool is_vertex = answer.is_vertex_blocked;
    locate_contact(snapshot(), is_vertex ? at : target,
                   is_vertex ? target : body_.positions[first_blocked(answer).other], *met);
    answer.contact = *met;
  }
  name_part(answer);
}

/// Names the vertex that stays, or its first edge that is blocked, as what meets the wall.
template <int D>
void Target_step<D>::name_part(Rejected_move<D>& answer) const {
  answer.contact->body = answer.is_vertex_blocked ? Body_feature::vertex : Body_feature::edge;
  answer.contact->vertex = answer.vertex;
  answer.contact->feature = answer.is_vertex_blocked ? answer.vertex : first_blocked(answer).edge;
}

/// The contact of a vertex that stays.
template <int D>
Contact<D> Target_step<D>::first_contact(Rejected_move<D>& blocked, const Point<D>& target) {
  const std::uint32_t vertex = blocked.vertex;
  if (!body_.thick.are_none() && blocked.contact) {
    name_part(blocked);
    return *blocked.contact;
  }
  Sweep_options segments = sweep_;
  segments.sweep = Sweep::three_segments;
  Particle<D> to;
  for (const Touch touch : {Touch::pass, Touch::stop}) {
    segments.touch = touch;
    if (const auto first = find_contact(body_, body_.scratch, vertex, target, segments, counts_, false, to))
      return *first;
  }
  // It touched a wall where it started.
  const Particle<D>& from = body_.particles[vertex];
  const auto meeting = [&](const Point<D>& q, std::uint32_t edge) {
    Contact<D> contact =
        closed_meeting<D>(snapshot(), from.cell, {from.position, target, q}, counts_.edges).value();
    if (blocked.is_vertex_blocked) contact.body = Body_feature::vertex;
    contact.vertex = vertex;
    contact.feature = contact.body == Body_feature::vertex ? vertex : edge;
    return contact;
  };
  if (blocked.is_vertex_blocked) return meeting(from.position, 0);
  const Corner& corner = first_blocked(blocked);
  return meeting(body_.positions[corner.other], corner.edge);
}

/// Finds out whether the body is apart from all walls, where that matters and is not known.
template <int D>
void Target_step<D>::update_is_apart() {
  if (sweep_.touch == Touch::pass)
    body_.is_apart = false;  // the moves to come may touch walls
  else if (body_.region.holds_body())
    body_.is_apart = true;
  else if (!body_.is_apart)
    body_.is_apart = !touches_wall();
}

/// True if a vertex or an edge touches a wall.
template <int D>
bool Target_step<D>::touches_wall() {
  const auto touches = [&](std::uint32_t u, std::uint32_t v) {
    body_.refresh_vertex(u, counts_);
    const Point<D>&p = body_.positions[u], &q = body_.positions[v];
    return closed_meeting<D>(snapshot(), body_.particles[u].cell, {p, q, p}, counts_.edges).has_value();
  };
  for (const auto& [u, v] : body_.topology.edges())
    if (touches(u, v)) return true;
  for (std::uint32_t v = 0; v < body_.positions.size(); ++v)
    if (body_.topology.corners_of(v).empty() && touches(v, v)) return true;
  return false;
}

/// Moves a vertex, or leaves it where it is.
template <int D>
Tried_move<D> Target_step<D>::try_to_move(std::uint32_t vertex, const Point<D>& target,
                                          const Settled_move<D>& settled) {
  body_.refresh_vertex(vertex, counts_);
  Particle<D> to;
  bool had_choice = false;
  Tried_move<D> tried = try_on_sides(vertex, target, settled, nullptr, to, had_choice);
  if (tried.severity() != 0 && had_choice && !tried.answer.is_vertex_blocked && sweep_.touch == Touch::pass)
      [[unlikely]]
    tried = try_on_all_sides(vertex, target, to);
  if (tried.answer.stays()) return tried;
  body_.are_faces_swept = false;
  body_.commit(vertex, to, body_.scratch.chains);
  return tried;
}

/// The move on the sides of walls on which least hinders it, the first of them in the order of preference.
template <int D>
Tried_move<D> Target_step<D>::try_on_all_sides(std::uint32_t vertex, const Point<D>& target,
                                               Particle<D>& to) {
  Sides_taken choices, best_choices;
  std::optional<Tried_move<D>> best;
  bool had_choice = false;
  for (int tries = 0; tries < most_side_tries; ++tries) {
    Tried_move<D> tried = try_on_sides(vertex, target, {}, &choices, to, had_choice);
    if (tried.severity() == 0) return tried;
    if (!tried.answer.is_vertex_blocked && (!best || tried.severity() < best->severity())) {
      best = std::move(tried);
      best_choices = choices;
    }
    if (!take_next_sides(choices)) break;
  }
  return try_on_sides(vertex, target, {}, &best_choices, to, had_choice);
}

/// The outcome of a move while the vertex takes the given sides of walls or, without, those that it prefers.
/// If nothing hinders it, the scratch has its chains.
/// \param settled the results known already
template <int D>
Tried_move<D> Target_step<D>::try_on_sides(std::uint32_t vertex, const Point<D>& target,
                                           const Settled_move<D>& settled, Sides_taken* choices,
                                           Particle<D>& to, bool& had_choice) {
  Tried_move<D> tried;
  Rejected_move<D>& answer = tried.answer;
  answer.vertex = vertex;
  // In the region, only edges that leave it can meet anything.
  const bool is_inside = body_.region.holds_way(vertex, target);
  const Particle<D> from = body_.particles[vertex];
  Move_scratch<D>& scratch = body_.scratch;
  const std::uint64_t signs_before = signs();
  const bool is_thick_free = body_.thick.are_none() || (!is_inside && is_sweep_of_thick_free(vertex, target));
  if (!is_thick_free && !is_inside && is_way_close(vertex, target, tried)) return tried;
  if (settled.to) {
    to = *settled.to;
    had_choice = false;
    if (sweeps()) scratch.visit_crossed(snapshot(), from.cell);
  } else {
    to = from;
    scratch.clear_walk();
    Walk_options recorded;
    recorded.locates_contact = false;
    if (sweeps()) recorded.visited = &scratch.visited;
    recorded.crossed = &scratch.crossed;
    const Walk_result<D> walked =
        move_on_sides(snapshot(), to, target, counts_.edges.walk, recorded, choices);
    had_choice = walked.had_choice;
    if (walked.contact) {
      answer.is_vertex_blocked = tried.keep_met(walked.contact);
      return tried;
    }
  }
  // Planes alone prove that nothing is touched; where a sign was computed, walls are tested.
  const bool is_apart = body_.is_apart && signs() == signs_before;
  if (sweep_.touch == Touch::stop && !is_apart)
    if (const auto touch =
            closed_meeting<D>(snapshot(), from.cell, {from.position, target, from.position}, counts_.edges)) {
      answer.is_vertex_blocked = tried.keep_located(touch);
      return tried;
    }
  const Vertex_path<D> path{from, to, scratch.visited, scratch.crossed, false, is_apart};
  const auto corners = body_.topology.corners_of(vertex);
  scratch.take_up_chains(corners.size());
  Float_point<D> mapped{};
  const bool may_confirm = may_be_in_place(body_, sweep_, is_apart) && snapshot().frame().map(target, mapped);
  Chains_in_place<D> in_place(body_, to, mapped, false);
  for (std::size_t i = settled.free_edges; i < corners.size(); ++i) {
    Moved_chain<D>& moved = scratch.chains[i];
    moved.is_in_place = moved.is_relinked = false;
    moved.is_stale = is_inside && !body_.region.is_outside(corners[i].other);
    if (moved.is_stale) continue;
    body_.refresh_edge(corners[i].edge, counts_);
    if (!is_thick_free) test_end_of_thick(vertex, i, to, tried);
    if (answer.edges >> i & 1) continue;
    const bool is_settled = settled.to && i == settled.free_edges;
    Relink_answer relinked = is_settled ? settled.next_edge : Relink_answer::open;
    if (may_confirm && !is_settled) {
      moved.is_in_place = in_place.confirms(corners[i]);
      if (moved.is_in_place) continue;
      relinked = in_place.relink(corners[i], path.from, Half_facet::none, moved);
      if (relinked == Relink_answer::free) continue;
    }
    const bool is_blocked = relinked == Relink_answer::blocked;
    if (meets_at_end(path, i, corners[i], is_blocked, moved, tried)) answer.edges |= std::uint64_t{1} << i;
  }
  in_place.add_to(counts_.edges);
  return tried;
}

/// True if edges with a radius, or a vertex alone, keep their distance all the way: most do, and need no
/// other test.
template <int D>
bool Target_step<D>::is_sweep_of_thick_free(std::uint32_t vertex, const Point<D>& target) {
  for (const Corner& corner : body_.topology.corners_of(vertex)) body_.refresh_edge(corner.edge, counts_);
  return body_.thick.is_free(body_, vertex, target, Sweep::triangle);
}

/// True if a wall is nearer to the way of a vertex than the radius of one of its edges, or its own.
/// \pre not all is free, see is_sweep_of_thick_free()
template <int D>
bool Target_step<D>::is_way_close(std::uint32_t vertex, const Point<D>& target, Tried_move<D>& tried) {
  const auto corners = body_.topology.corners_of(vertex);
  const auto is_free = [&](const Corner& corner) {
    return body_.thick.is_edge_free(body_, vertex, corner, target, Swept_part::way);
  };
  if (!corners.empty() && std::ranges::all_of(corners, is_free)) return false;
  tried.keep_located(body_.thick.contact_on_way(body_, vertex, target));
  return tried.answer.is_vertex_blocked = true;
}

/// Whether an edge with a radius, if this one has one, keeps its distance where the vertex goes and, where
/// triangles are swept, on the way.
/// \param to where the vertex goes, on a way that is free
template <int D>
void Target_step<D>::test_end_of_thick(std::uint32_t vertex, std::size_t number, const Particle<D>& to,
                                       Tried_move<D>& tried) {
  const Corner& corner = body_.topology.corners_of(vertex)[number];
  const std::uint64_t bit = std::uint64_t{1} << number;
  const auto is_free = [&](Swept_part part) {
    return body_.thick.is_edge_free(body_, vertex, corner, to.position, part);
  };
  if (sweeps() && !is_free(Swept_part::all)) tried.answer.swept_edges |= bit;
  if (is_free(Swept_part::end)) return;
  tried.answer.edges |= bit;
  // A particle as thick as the edge meets the wall as it goes along it.
  const Thick_motion<D> along{
      to.position, body_.positions[corner.other], {}, body_.thick.radius(corner.edge)};
  tried.keep_located(
      body_.thick.contact(body_, to.cell, body_.topology.edges()[corner.edge][0], along, Swept_part::all));
}

/// True if the edge of a corner is free while its vertex goes its way: then its chain is known.
template <int D>
bool Target_step<D>::is_swept_free(const Vertex_path<D>& path, const Corner& corner, Moved_chain<D>& moved) {
  const Particle<D>& q = body_.particles[corner.other];
  std::optional<Free_chain> free =
      free_chain(snapshot(), path, q, body_.seen_from(corner), sweep_, counts_.edges);
  if (!free) return false;
  if (sweep_.touch == Touch::stop && !free->is_apart &&
      closed_meeting<D>(snapshot(), path.from.cell, {path.from.position, path.to.position, q.position},
                        counts_.edges))
    return false;
  moved.chain = std::move(free->chain);
  return true;
}

/// True if the edge of a corner meets a wall where its vertex goes; its way is looked at where triangles are
/// swept.
/// \param is_blocked it is known that it meets one: at the target, or on the way where triangles are swept
template <int D>
bool Target_step<D>::meets_at_end(const Vertex_path<D>& path, std::size_t number, const Corner& corner,
                                  bool is_blocked, Moved_chain<D>& moved, Tried_move<D>& tried) {
  Edge_counts& edges = counts_.edges;
  if (is_blocked || !sweeps()) {
    ++edges.edges;
    edges.changed += sweeps();
  } else if (is_swept_free(path, corner, moved)) {
    return false;
  }
  if (sweeps()) tried.answer.swept_edges |= std::uint64_t{1} << number;
  const Particle<D>& q = body_.particles[corner.other];
  const bool stops = sweep_.touch == Touch::stop;
  const std::uint64_t signs_before = signs();
  Chain_result<D> anew = find_chain(snapshot(), path.to, q, edges.walk, false);
  // Where a wall is passed in its inside, no other way helps.
  const bool is_crossed =
      anew.contact && anew.contact->kind == Contact_kind::facet && anew.contact->time != 1;
  if (stops && !is_crossed) {
    const bool is_plain = path.is_apart && signs() == signs_before;
    if (anew.contact || !is_plain) {
      if (tried.keep_located(closed_meeting<D>(snapshot(), path.to.cell,
                                               {path.to.position, q.position, path.to.position}, edges)))
        return true;
      anew = find_any_chain(snapshot(), path.to, q, edges.walk);
    }
  } else if (anew.contact && !is_crossed) {
    anew = find_any_chain(snapshot(), path.to, q, edges.walk);
  }
  if (tried.keep_met(anew.contact)) return true;
  moved.chain = std::move(anew.chain);
  return false;
}

template class Target_step<2>;
template class Target_step<3>;

}  // namespace cellwalk::detail
