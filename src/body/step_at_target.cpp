// SPDX-License-Identifier: LGPL-3.0-or-later
#include "step_at_target.h"

#include <cellwalk/internal/edge/furthest_move.h>

#include <bit>
#include <utility>

#include "vertex_move.h"

namespace cellwalk::detail {

/// Moves vertex by vertex. Not to be inlined: the step before is short.
template <int D>
[[gnu::noinline]] void Target_step<D>::move_each(std::span<const Point<D>> targets, Reported reported,
                                                 bool parallel, Step_report<D>& report) {
  find_out_if_apart();
  // Planes prove that nothing is touched where nothing was.
  const bool may_be_certified = body_.certificates.planes && (sweep_.touch == Touch::pass || body_.is_apart);
  body_.make_free_moves(targets, parallel, counts_);
  for (std::uint32_t v = body_.free_moves.next_left(0); v < targets.size();
       v = body_.free_moves.next_left(v + 1)) {
    if (body_.try_move_in_region(v, targets[v], counts_) ||
        (may_be_certified && try_certified_move(v, targets[v])))
      continue;
    Tried_move<D> tried = try_to_move(v, targets[v]);
    const Rejected_move<D>& answer = tried.answer;
    if (!answer.is_vertex_blocked && (answer.edges | answer.swept_edges) == 0) continue;
    counts_.contacts += answer.stays();
    counts_.held += answer.stays();
    if (reported == Reported::contacts) {
      if (answer.stays()) report.contacts.push_back(first_contact(answer, targets[v]));
      continue;
    }
    report.blocked.push_back(std::move(tried.answer));
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
void Target_step<D>::locate_wall(Rejected_move<D>& answer, std::optional<Wall_contact<D>>& met,
                                 const Point<D>& target) const {
  if (!answer.stays()) return;
  const std::uint32_t v = answer.vertex;
  const Corner* edge = answer.is_vertex_blocked ? nullptr : &first_blocked(answer);
  const Body_feature body = edge ? Body_feature::edge : Body_feature::vertex;
  if (met) {
    const Point<D>&from = edge ? target : body_.positions[v],
          &to = edge ? body_.positions[edge->other] : target;
    locate_contact(snapshot(), from, to, *met);
    answer.contact.emplace(to_contact(*met, Exact_time(met->time), body));
  }
  answer.contact->body = body;
  answer.contact->vertex = v;
  answer.contact->feature = edge ? edge->edge : v;
}

/// The contact of a vertex that stays.
template <int D>
Contact<D> Target_step<D>::first_contact(const Rejected_move<D>& blocked, const Point<D>& target) {
  const std::uint32_t vertex = blocked.vertex;
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
void Target_step<D>::find_out_if_apart() {
  if (sweep_.touch == Touch::pass)
    body_.is_apart = false;  // what moves now may touch
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

/// Moves a vertex that stays strictly inside its cell, if its edges certainly meet nothing: so are most moves
/// outside of regions.
template <int D>
bool Target_step<D>::try_certified_move(std::uint32_t vertex, const Point<D>& target) {
  body_.refresh_vertex(vertex, counts_);
  const Particle<D>& from = body_.particles[vertex];
  if (!certainly_inside(snapshot(), from.cell, target, counts_.edges.walk)) return false;
  const Particle<D> to{target, from.cell, D, from.aimed};
  const bool is_inside = body_.region.holds_way(vertex, target);
  const auto corners = body_.topology.corners_of(vertex);
  Edge_proofs proofs;       // the edges of a move that is not made here are counted where it is decided
  std::uint64_t stale = 0;  // edges whose chain is left to be found when it is asked for
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    if (!is_inside || body_.region.is_outside(corner.other)) {
      body_.refresh_vertex(corner.other, counts_);
      const Particle<D>& q = body_.particles[corner.other];
      if (sweep_.sweep == Sweep::three_segments) {
        if (!is_certified_free(to, q, proofs)) return false;
      } else if (!is_certified_free(from, to, q, proofs)) {
        if (!refresh_certified_chain(from, to, corner, proofs)) return false;
        continue;
      }
    }
    stale |= std::uint64_t{1} << i;
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (stale >> i & 1) body_.region.mark_edge(corners[i].edge, true);
  proofs.add_to(counts_.edges);
  body_.are_faces_swept = false;
  body_.particles[vertex] = to;
  body_.place(vertex, target);
  return true;
}

/// True if an edge certainly meets no wall where it is.
template <int D>
template <class Counts>
inline bool Target_step<D>::is_certified_free(const Particle<D>& p, const Particle<D>& q, Counts& proofs) {
  if (sweep_.certificates.same_cell && q.cell == p.cell)
    ++proofs.same_cell;
  else if (sweep_.certificates.convex_pair && snapshot().convex_passage(p.cell, q.cell) != Half_facet::none)
    ++proofs.convex_pair;
  else if (!body_.certificates.planes || certain_end(snapshot(), p, q.position, counts_.edges.walk) != q.cell)
    return false;
  ++proofs.edges;
  return true;
}

/// True if the cells of its ends alone prove an edge free, whatever its chain was: one cell, or two with a
/// convex union, and ends inside of them, so that there is but one chain from one to the other.
template <int D>
template <class Counts>
inline bool Target_step<D>::is_certified_free(const Particle<D>& from, const Particle<D>& to,
                                              const Particle<D>& q, Counts& proofs) {
  if (from.cell != to.cell || from.dimension != D || q.dimension != D) return false;
  if (sweep_.certificates.same_cell && q.cell == to.cell)
    ++proofs.same_cell;
  else if (sweep_.certificates.convex_pair && q.cell != to.cell &&
           snapshot().convex_passage(to.cell, q.cell) != Half_facet::none)
    ++proofs.convex_pair;
  else
    return false;
  ++proofs.edges;
  return true;
}

/// True if an edge certainly has one chain, and the same, at both ends of the way of its vertex. It is kept
/// then, and not stale.
template <int D>
bool Target_step<D>::refresh_certified_chain(const Particle<D>& from, const Particle<D>& to,
                                             const Corner& corner, Edge_proofs& proofs) {
  if (!sweep_.certificates.same_chain) return false;
  const Particle<D>& q = body_.particles[corner.other];
  const auto finds = [&](const Particle<D>& p, Chain& chain) {
    const Particle<D>&start = corner.is_reversed ? q : p, &end = corner.is_reversed ? p : q;
    return certain_end(snapshot(), start, end.position, counts_.edges.walk, &chain) == end.cell;
  };
  Chain chain;
  if (!finds(to, chain)) return false;
  Chain& kept = body_.chains[corner.edge];
  if (body_.region.is_edge_stale(corner.edge)) {
    kept.clear();
    if (!finds(from, kept)) return false;
    body_.region.mark_edge(corner.edge, false);
  }
  if (chain != kept) return false;
  ++proofs.edges;
  ++proofs.same_chain;
  proofs.chain_facets += chain.size();
  return true;
}

/// Moves a vertex, or leaves it where it is.
template <int D>
Tried_move<D> Target_step<D>::try_to_move(std::uint32_t vertex, const Point<D>& target) {
  body_.refresh_vertex(vertex, counts_);
  Particle<D> to;
  bool had_choice = false;
  Tried_move<D> tried = try_on_sides(vertex, target, nullptr, to, had_choice);
  if (tried.hindrance() != 0 && had_choice && !tried.answer.is_vertex_blocked && sweep_.touch == Touch::pass)
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
    Tried_move<D> tried = try_on_sides(vertex, target, &choices, to, had_choice);
    if (tried.hindrance() == 0) return tried;
    if (!tried.answer.is_vertex_blocked && (!best || tried.hindrance() < best->hindrance())) {
      best = std::move(tried);
      best_choices = choices;
    }
    if (!take_next_sides(choices)) break;
  }
  return try_on_sides(vertex, target, &best_choices, to, had_choice);
}

/// What comes of a move while the vertex takes the given sides of walls or, without, those that it prefers.
/// If nothing hinders it, the scratch has its chains.
template <int D>
Tried_move<D> Target_step<D>::try_on_sides(std::uint32_t vertex, const Point<D>& target, Sides_taken* choices,
                                           Particle<D>& to, bool& had_choice) {
  Tried_move<D> tried;
  Rejected_move<D>& answer = tried.answer;
  answer.vertex = vertex;
  // In the region, only edges that leave it can meet anything.
  const bool is_inside = body_.region.holds_way(vertex, target);
  const Particle<D> from = body_.particles[vertex];
  to = from;
  Move_scratch& scratch = body_.scratch;
  scratch.clear_walk();
  // Chains are carried along where triangles are swept; where only ends count, they are looked for when asked
  // for.
  const bool needs_way = sweep_.sweep != Sweep::three_segments;
  const std::uint64_t signs_before = signs();
  Walk_options recorded;
  recorded.locates_contact = false;
  if (needs_way) {
    recorded.visited = &scratch.visited;
    recorded.crossed = &scratch.crossed;
  }
  const Walk_result<D> walked = move_on_sides(snapshot(), to, target, counts_.edges.walk, recorded, choices);
  had_choice = walked.had_choice;
  if (walked.contact) {
    answer.is_vertex_blocked = tried.keep(walked.contact);
    return tried;
  }
  // Planes alone prove that nothing is touched; where a sign was asked for, walls are.
  const bool is_apart = body_.is_apart && signs() == signs_before;
  if (sweep_.touch == Touch::stop && !is_apart)
    if (const auto touch =
            closed_meeting<D>(snapshot(), from.cell, {from.position, target, from.position}, counts_.edges)) {
      answer.is_vertex_blocked = tried.keep(touch);
      return tried;
    }
  const Vertex_path<D> path{from, to, scratch.visited, scratch.crossed, false, is_apart};
  const auto corners = body_.topology.corners_of(vertex);
  scratch.chains.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Moved_chain& moved = scratch.chains[i];
    const bool is_in_region = is_inside && !body_.region.is_outside(corners[i].other);
    moved.is_stale = !needs_way || is_in_region;
    if (is_in_region) continue;
    const bool is_met = needs_way ? sweep_meets_at_end(path, i, corners[i], moved, tried)
                                  : meets_at_end(path, corners[i], tried);
    if (is_met) answer.edges |= std::uint64_t{1} << i;
  }
  return tried;
}

/// True if the edge of a corner meets a wall where its vertex goes.
template <int D>
bool Target_step<D>::meets_at_end(const Vertex_path<D>& path, const Corner& corner, Tried_move<D>& tried) {
  body_.refresh_vertex(corner.other, counts_);
  const Particle<D>& q = body_.particles[corner.other];
  Edge_counts& edges = counts_.edges;
  // What proves the edge free without a sign proves that it touches nothing either, if its ends do not and p
  // is inside of a cell.
  const bool stops = sweep_.touch == Touch::stop;
  if (is_certified_free(path.to, q, edges)) {
    if (!stops || (body_.is_apart && path.to.dimension == D)) return false;
  } else {
    ++edges.edges;
  }
  const std::uint64_t signs_before = signs();
  Walk_options plain;
  plain.locates_contact = false;
  const Walk_result<D> walked = walk(snapshot(), path.to, q.position, edges.walk, plain);
  const bool is_plain = body_.is_apart && signs() == signs_before;
  if (walked.status == Walk_status::arrived && walked.cell == q.cell && (!stops || is_plain)) return false;
  // Where a wall is passed in its inside, no other way helps.
  if (walked.contact && walked.contact->kind == Contact_kind::facet) return tried.keep(walked.contact);
  if (!stops) return tried.keep(find_any_chain(snapshot(), path.to, q, edges.walk).contact);
  return tried.keep(
      closed_meeting<D>(snapshot(), path.to.cell, {path.to.position, q.position, path.to.position}, edges));
}

/// Sweeps the edge of a corner while its vertex goes its way. True if it is blocked where that ends.
template <int D>
bool Target_step<D>::sweep_meets_at_end(const Vertex_path<D>& path, std::size_t number, const Corner& corner,
                                        Moved_chain& moved, Tried_move<D>& tried) {
  body_.refresh_vertex(corner.other, counts_);
  const Particle<D>& q = body_.particles[corner.other];
  if (is_certified_free(path.from, path.to, q, counts_.edges)) {
    moved.is_stale = true;
    return false;
  }
  body_.refresh_edge(corner.edge, counts_);
  Edge_counts& edges = counts_.edges;
  const auto meeting = [&](const Cell start, const Swept_triangle<D>& triangle) {
    return closed_meeting(snapshot(), start, triangle, edges);
  };
  const bool stops = sweep_.touch == Touch::stop;
  std::optional<Free_chain> free = free_chain(snapshot(), path, q, body_.seen_from(corner), sweep_, edges);
  if (free && stops && !free->is_apart &&
      meeting(path.from.cell, {path.from.position, path.to.position, q.position}))
    free.reset();
  if (free) {
    moved.chain = std::move(free->chain);
    return false;
  }
  tried.answer.swept_edges |= std::uint64_t{1} << number;
  const std::uint64_t signs_before = signs();
  Chain_result<D> anew = find_chain(snapshot(), path.to, q, edges.walk, false);
  // Where a wall is passed in its inside, no other way helps.
  const bool is_crossed =
      anew.contact && anew.contact->kind == Contact_kind::facet && anew.contact->time != 1;
  if (stops && !is_crossed) {
    const bool is_plain = path.is_apart && signs() == signs_before;
    if (anew.contact || !is_plain) {
      if (tried.keep(meeting(path.to.cell, {path.to.position, q.position, path.to.position}))) return true;
      anew = find_any_chain(snapshot(), path.to, q, edges.walk);
    }
  } else if (anew.contact && !is_crossed) {
    anew = find_any_chain(snapshot(), path.to, q, edges.walk);
  }
  if (tried.keep(anew.contact)) return true;
  moved.chain = std::move(anew.chain);
  return false;
}

template class Target_step<2>;
template class Target_step<3>;

}  // namespace cellwalk::detail
