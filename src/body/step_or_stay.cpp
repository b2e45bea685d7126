// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body by the rule of the paper: what meets a wall stays where it is.
#include <cellwalk/body/body.h>

#include <utility>

namespace cellwalk {
template <int D>
void Body<D>::step_or_stay(std::span<const Point<D>> targets, const Body_options& options,
                           std::vector<Blocked_move<D>>& blocked, Body_counts& counts) {
  if (!moves_at_once(targets, options, counts)) move_each_or_stay(targets, options, blocked, counts);
}

/// The same vertex by vertex. Not to be inlined: the step above is short.
template <int D>
[[gnu::noinline]] void Body<D>::move_each_or_stay(std::span<const Point<D>> targets,
                                                  const Body_options& options,
                                                  std::vector<Blocked_move<D>>& blocked,
                                                  Body_counts& counts) {
  note_apart(options, counts);
  // Planes prove that nothing is touched where nothing was.
  const bool may_be_plain = options.sweep.touch == Touch::pass || is_apart_;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (moves_in_region(v, targets[v], counts) ||
        (may_be_plain && moves_plainly(v, targets[v], options.sweep, counts)))
      continue;
    const Blocked_move<D> answer = move_or_stay(v, targets[v], options, counts);
    if (!answer.is_vertex_blocked && (answer.edges | answer.swept_edges) == 0) continue;
    counts.contacts += answer.stays();
    blocked.push_back(answer);
  }
}

/// Finds out whether the body is apart from all walls, where that matters and is not known.
template <int D>
void Body<D>::note_apart(const Body_options& options, Body_counts& counts) {
  if (region_ && outside_ == 0)
    is_apart_ = true;
  else if (options.sweep.touch == Touch::pass)
    is_apart_ = false;  // what moves now may touch
  else if (!is_apart_)
    is_apart_ = !touches_wall(counts);
}

/// True if a vertex or an edge touches a wall.
template <int D>
bool Body<D>::touches_wall(Body_counts& counts) {
  const auto touches = [&](std::uint32_t u, std::uint32_t v) {
    catch_up_vertex(u, counts);
    return closed_meeting<D>(*snapshot_, particles_[u].cell, {positions_[u], positions_[v], positions_[u]},
                             counts.edges)
        .has_value();
  };
  for (const auto& [u, v] : edges_)
    if (touches(u, v)) return true;
  for (std::uint32_t v = 0; v < positions_.size(); ++v)
    if (corner_begin_[v] == corner_begin_[v + 1] && touches(v, v)) return true;
  return false;
}

/// Moves a vertex that stays strictly inside its cell, if its edges certainly meet nothing: so are most moves outside of regions.
template <int D>
bool Body<D>::moves_plainly(std::uint32_t vertex, const Point<D>& target, const Sweep_options& options,
                            Body_counts& counts) {
  catch_up_vertex(vertex, counts);
  const Particle<D>& from = particles_[vertex];
  if (!detail::certainly_inside(*snapshot_, from.cell, target, counts.edges.walk)) return false;
  const Particle<D> to{target, from.cell, D, from.aimed};
  const bool is_inside = region_ && !is_outside_[vertex] && region_->holds(target);
  const std::uint32_t begin = corner_begin_[vertex], end = corner_begin_[vertex + 1];
  // What is given up here is counted where it is decided.
  Edge_counts& edges = counts.edges;
  const auto give_up = [&edges, all = edges.edges, same_cell = edges.same_cell,
                        convex_pair = edges.convex_pair, same_chain = edges.same_chain,
                        chain_facets = edges.chain_facets] {
    edges.edges = all;
    edges.same_cell = same_cell;
    edges.convex_pair = convex_pair;
    edges.same_chain = same_chain;
    edges.chain_facets = chain_facets;
    return false;
  };
  std::uint64_t behind = 0;  // edges whose chain is left to be found when it is asked for
  for (std::uint32_t i = begin; i < end; ++i) {
    const Corner& corner = corners_[i];
    if (!is_inside || is_outside_[corner.other]) {
      catch_up_vertex(corner.other, counts);
      const Particle<D>& q = particles_[corner.other];
      if (options.sweep == Sweep::three_segments) {
        if (!is_free_at_end(to, q, options, edges)) return give_up();
      } else if (!is_plainly_free(from, to, q, options, edges)) {
        if (!keeps_chain(from, to, corner, options, edges)) return give_up();
        continue;
      }
    }
    behind |= std::uint64_t{1} << (i - begin);
  }
  for (std::uint32_t i = begin; i < end; ++i)
    if (behind >> (i - begin) & 1) edge_behind_[corners_[i].edge] = true;
  are_faces_swept_ = false;
  particles_[vertex] = to;
  place(vertex, target);
  return true;
}

/// True if an edge certainly meets no wall where it is.
template <int D>
bool Body<D>::is_free_at_end(const Particle<D>& p, const Particle<D>& q, const Sweep_options& options,
                             Edge_counts& counts) const {
  if (options.certificates.same_cell && q.cell == p.cell)
    ++counts.same_cell;
  else if (options.certificates.convex_pair && snapshot_->convex_passage(p.cell, q.cell) != Half_facet::none)
    ++counts.convex_pair;
  else if (detail::certain_end(*snapshot_, p, q.position, counts.walk) != q.cell)
    return false;
  ++counts.edges;
  return true;
}

/// True if an edge certainly has one chain, and the same, at both ends of the way of its vertex. It is kept then.
template <int D>
bool Body<D>::keeps_chain(const Particle<D>& from, const Particle<D>& to, const Corner& corner,
                          const Sweep_options& options, Edge_counts& counts) {
  if (!options.certificates.same_chain) return false;
  const Particle<D>& q = particles_[corner.other];
  const auto finds = [&](const Particle<D>& p, Chain& chain) {
    const Particle<D>&start = corner.is_reversed ? q : p, &end = corner.is_reversed ? p : q;
    return detail::certain_end(*snapshot_, start, end.position, counts.walk, &chain) == end.cell;
  };
  Chain chain;
  if (!finds(to, chain)) return false;
  Chain& kept = chains_[corner.edge];
  if (edge_behind_[corner.edge]) {
    kept.clear();
    if (!finds(from, kept)) return false;
    edge_behind_[corner.edge] = false;
  }
  if (chain != kept) return false;
  ++counts.edges;
  ++counts.same_chain;
  counts.chain_facets += chain.size();
  return true;
}

template <int D>
Blocked_move<D> Body<D>::move_or_stay(std::uint32_t vertex, const Point<D>& target,
                                      const Body_options& options, Body_counts& counts) {
  Blocked_move<D> answer;
  answer.vertex = vertex;
  // In the region, only edges that leave it can meet anything.
  const bool is_inside = region_ && !is_outside_[vertex] && region_->holds(target);
  catch_up_vertex(vertex, counts);
  const Particle<D> from = particles_[vertex];
  Particle<D> to = from;
  visited_.clear();
  crossed_.clear();
  // Chains are carried along where triangles are swept; where only ends count, they are looked for when asked for.
  const bool needs_way = options.sweep.sweep != Sweep::three_segments;
  const std::uint64_t signs = counts.edges.walk.predicates.orientations;
  Walk_options recorded;
  recorded.locates_contact = false;
  if (needs_way) {
    recorded.visited = &visited_;
    recorded.crossed = &crossed_;
  }
  if (const Walk_result<D> walked = move(*snapshot_, to, target, counts.edges.walk, recorded);
      walked.contact) {
    answer.is_vertex_blocked = true;
    answer.contact = walked.contact;
    locate_contact(*snapshot_, from.position, target, *answer.contact);
    return answer;
  }
  // Planes alone prove that nothing is touched; where a sign was asked for, walls are.
  const bool is_apart = is_apart_ && counts.edges.walk.predicates.orientations == signs;
  if (options.sweep.touch == Touch::stop && !is_apart)
    if (const auto touch =
            closed_meeting<D>(*snapshot_, from.cell, {from.position, target, from.position}, counts.edges)) {
      answer.is_vertex_blocked = true;
      answer.contact = *touch;
      return answer;
    }
  const Way<D> way{from, to, visited_, crossed_, false, is_apart};
  const std::uint32_t begin = corner_begin_[vertex], end = corner_begin_[vertex + 1];
  moved_chains_.resize(end - begin);
  for (std::uint32_t i = begin; i < end; ++i) {
    Moved_chain& moved = moved_chains_[i - begin];
    const bool is_in_region = is_inside && !is_outside_[corners_[i].other];
    moved.is_behind = !needs_way || is_in_region;
    if (is_in_region) continue;
    const bool is_met = needs_way ? sweep_meets_at_end(way, i, options.sweep, moved, answer, counts)
                                  : meets_at_end(way, i, options.sweep, answer, counts);
    if (is_met) answer.edges |= std::uint64_t{1} << (i - begin);
  }
  if (answer.stays()) return answer;
  are_faces_swept_ = false;
  commit(vertex, to);
  return answer;
}

/// True if the edge of a corner meets a wall where its vertex goes.
template <int D>
bool Body<D>::meets_at_end(const Way<D>& way, std::uint32_t corner_number, const Sweep_options& options,
                           Blocked_move<D>& answer, Body_counts& counts) {
  const Corner& corner = corners_[corner_number];
  catch_up_vertex(corner.other, counts);
  const Particle<D>& q = particles_[corner.other];
  Edge_counts& edges = counts.edges;
  // What proves the edge free without a sign proves that it touches nothing either, if its ends do not and p is inside of a cell.
  const bool stops = options.touch == Touch::stop;
  if (is_free_at_end(way.to, q, options, edges)) {
    if (!stops || (is_apart_ && way.to.dimension == D)) return false;
  } else {
    ++edges.edges;
  }
  const std::uint64_t signs = edges.walk.predicates.orientations;
  Walk_options plain;
  plain.locates_contact = false;
  const Walk_result<D> walked = walk(*snapshot_, way.to, q.position, edges.walk, plain);
  const bool is_plain = is_apart_ && edges.walk.predicates.orientations == signs;
  if (walked.status == Walk_status::arrived && walked.cell == q.cell && (!stops || is_plain)) return false;
  // Where a wall is passed in its inside, no other way helps.
  std::optional<Wall_contact<D>> contact = walked.contact;
  if (!contact || contact->kind != Contact_kind::facet) {
    if (stops)
      contact =
          closed_meeting<D>(*snapshot_, way.to.cell, {way.to.position, q.position, way.to.position}, edges);
    else
      contact = find_any_chain(*snapshot_, way.to, q, edges.walk).contact;
  }
  if (contact && !answer.contact) {
    locate_contact(*snapshot_, way.to.position, q.position, *contact);
    answer.contact = contact;
  }
  return contact.has_value();
}

/// Sweeps the edge of a corner while its vertex goes its way. True if it is blocked where that ends.
template <int D>
bool Body<D>::sweep_meets_at_end(const Way<D>& way, std::uint32_t corner_number, const Sweep_options& options,
                                 Moved_chain& moved, Blocked_move<D>& answer, Body_counts& counts) {
  const Corner& corner = corners_[corner_number];
  catch_up_vertex(corner.other, counts);
  const Particle<D>& q = particles_[corner.other];
  if (is_plainly_free(way.from, way.to, q, options, counts.edges)) {
    moved.is_behind = true;
    return false;
  }
  catch_up_edge(corner.edge, counts);
  const auto meeting = [&](const Cell start, const Swept_triangle<D>& triangle) {
    return closed_meeting(*snapshot_, start, triangle, counts.edges);
  };
  const bool stops = options.touch == Touch::stop;
  std::optional<Free_chain> free = free_chain(*snapshot_, way, q, seen_from(corner), options, counts.edges);
  if (free && stops && !free->is_apart &&
      meeting(way.from.cell, {way.from.position, way.to.position, q.position}))
    free.reset();
  if (free) {
    moved.chain = std::move(free->chain);
    return false;
  }
  answer.swept_edges |= std::uint64_t{1} << (corner_number - corner_begin_[answer.vertex]);
  const std::uint64_t signs = counts.edges.walk.predicates.orientations;
  Chain_result<D> anew = find_chain(*snapshot_, way.to, q, counts.edges.walk, false);
  // Where a wall is passed in its inside, no other way helps.
  const bool is_crossed =
      anew.contact && anew.contact->kind == Contact_kind::facet && anew.contact->time != 1;
  if (stops && !is_crossed) {
    const bool is_plain = way.is_apart && counts.edges.walk.predicates.orientations == signs;
    if (anew.contact || !is_plain) {
      anew.contact = meeting(way.to.cell, {way.to.position, q.position, way.to.position});
      if (!anew.contact) anew = find_any_chain(*snapshot_, way.to, q, counts.edges.walk);
    }
  } else if (anew.contact && !is_crossed) {
    anew = find_any_chain(*snapshot_, way.to, q, counts.edges.walk);
  }
  if (anew.contact) {
    if (!answer.contact) {
      locate_contact(*snapshot_, way.to.position, q.position, *anew.contact);
      answer.contact = anew.contact;
    }
    return true;
  }
  moved.chain = std::move(anew.chain);
  return false;
}

/// True if the cells of its ends alone prove an edge free, whatever its chain was: one cell, or two with a convex union, and
/// ends inside of them, so that there is but one chain from one to the other.
template <int D>
bool Body<D>::is_plainly_free(const Particle<D>& from, const Particle<D>& to, const Particle<D>& q,
                              const Sweep_options& options, Edge_counts& counts) const {
  if (from.cell != to.cell || from.dimension != D || q.dimension != D) return false;
  if (options.certificates.same_cell && q.cell == to.cell)
    ++counts.same_cell;
  else if (options.certificates.convex_pair && q.cell != to.cell &&
           snapshot_->convex_passage(to.cell, q.cell) != Half_facet::none)
    ++counts.convex_pair;
  else
    return false;
  ++counts.edges;
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template void Body<D>::note_apart(const Body_options&, Body_counts&);                                     \
  template bool Body<D>::touches_wall(Body_counts&);                                                        \
  template void Body<D>::move_each_or_stay(std::span<const Point<D>>, const Body_options&,                  \
                                           std::vector<Blocked_move<D>>&, Body_counts&);                    \
  template void Body<D>::step_or_stay(std::span<const Point<D>>, const Body_options&,                       \
                                      std::vector<Blocked_move<D>>&, Body_counts&);                         \
  template bool Body<D>::is_plainly_free(const Particle<D>&, const Particle<D>&, const Particle<D>&,        \
                                         const Sweep_options&, Edge_counts&) const;                         \
  template bool Body<D>::moves_plainly(std::uint32_t, const Point<D>&, const Sweep_options&, Body_counts&); \
  template bool Body<D>::is_free_at_end(const Particle<D>&, const Particle<D>&, const Sweep_options&,       \
                                        Edge_counts&) const;                                                \
  template bool Body<D>::keeps_chain(const Particle<D>&, const Particle<D>&, const Corner&,                 \
                                     const Sweep_options&, Edge_counts&);                                   \
  template bool Body<D>::meets_at_end(const Way<D>&, std::uint32_t, const Sweep_options&, Blocked_move<D>&, \
                                      Body_counts&);                                                        \
  template bool Body<D>::sweep_meets_at_end(const Way<D>&, std::uint32_t, const Sweep_options&,             \
                                            Moved_chain&, Blocked_move<D>&, Body_counts&);                  \
  template Blocked_move<D> Body<D>::move_or_stay(std::uint32_t, const Point<D>&, const Body_options&,       \
                                                 Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
