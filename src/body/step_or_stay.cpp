// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body by the rule of the paper: what meets a wall stays where it is.
#include <cellwalk/body/body.h>

#include <utility>

namespace cellwalk {
template <int D>
void Body<D>::step_or_stay(std::span<const Point<D>> targets, const Body_options& options,
                           std::vector<Blocked_move<D>>& blocked, Body_counts& counts) {
  if (moves_at_once(targets, options, counts)) return;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (moves_in_region(v, targets[v], counts)) continue;
    const Blocked_move<D> answer = move_or_stay(v, targets[v], options, counts);
    if (!answer.is_vertex_blocked && (answer.edges | answer.swept_edges) == 0) continue;
    counts.contacts += answer.stays();
    blocked.push_back(answer);
  }
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
  Walk_options recorded;
  if (needs_way) {
    recorded.visited = &visited_;
    recorded.crossed = &crossed_;
  }
  if (const Walk_result<D> walked = move(*snapshot_, to, target, counts.edges.walk, recorded);
      walked.contact) {
    answer.is_vertex_blocked = true;
    answer.contact = walked.contact;
    return answer;
  }
  const Way<D> way{from, to, visited_, crossed_, false};
  const std::uint32_t begin = corner_begin_[vertex], end = corner_begin_[vertex + 1];
  moved_chains_.resize(end - begin);
  for (std::uint32_t i = begin; i < end; ++i) {
    Moved_chain& moved = moved_chains_[i - begin];
    const bool is_in_region = is_inside && !is_outside_[corners_[i].other];
    moved.is_behind = !needs_way || is_in_region;
    if (is_in_region) continue;
    const bool is_met = needs_way ? sweep_meets_at_end(way, i, options.sweep, moved.chain, answer, counts)
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
  ++edges.edges;
  if (options.certificates.same_cell && q.cell == way.to.cell) {
    ++edges.same_cell;
    return false;
  }
  if (options.certificates.convex_pair &&
      convex_passage(*snapshot_, way.to.cell, q.cell) != Half_facet::none) {
    ++edges.convex_pair;
    return false;
  }
  const Walk_result<D> walked = walk(*snapshot_, way.to, q.position, edges.walk);
  if (walked.status == Walk_status::arrived && walked.cell == q.cell) return false;
  // Where a wall is passed in its inside, no other way helps.
  std::optional<Wall_contact<D>> contact = walked.contact;
  if (!contact || contact->kind != Contact_kind::facet)
    contact = find_any_chain(*snapshot_, way.to, q, edges.walk).contact;
  if (contact && !answer.contact) answer.contact = contact;
  return contact.has_value();
}

/// Sweeps the edge of a corner while its vertex goes its way. True if it is blocked where that ends.
template <int D>
bool Body<D>::sweep_meets_at_end(const Way<D>& way, std::uint32_t corner_number, const Sweep_options& options,
                                 Chain& moved, Blocked_move<D>& answer, Body_counts& counts) {
  const Corner& corner = corners_[corner_number];
  catch_up_vertex(corner.other, counts);
  const Particle<D>& q = particles_[corner.other];
  if (is_plainly_free(way.from, way.to, q, options, moved, counts.edges)) return false;
  catch_up_edge(corner.edge, counts);
  std::optional<Chain> chain = free_chain(*snapshot_, way, q, seen_from(corner), options, counts.edges);
  if (!chain) {
    answer.swept_edges |= std::uint64_t{1} << (corner_number - corner_begin_[answer.vertex]);
    Chain_result<D> anew = find_chain(*snapshot_, way.to, q, counts.edges.walk);
    if (anew.contact && (anew.contact->kind != Contact_kind::facet || anew.contact->time == 1))
      anew = find_any_chain(*snapshot_, way.to, q, counts.edges.walk);
    if (anew.contact) {
      if (!answer.contact) answer.contact = anew.contact;
      return true;
    }
    chain = std::move(anew.chain);
  }
  moved = *chain;
  return false;
}

/// True if the cells of its ends alone prove an edge free, whatever its chain was: one cell, or two with a convex union, and
/// ends inside of them, so that there is but one chain from one to the other.
template <int D>
bool Body<D>::is_plainly_free(const Particle<D>& from, const Particle<D>& to, const Particle<D>& q,
                              const Sweep_options& options, Chain& chain, Edge_counts& counts) const {
  if (from.cell != to.cell || from.dimension != D || q.dimension != D) return false;
  if (q.cell == to.cell) {
    if (!options.certificates.same_cell) return false;
    ++counts.edges;
    ++counts.same_cell;
    chain.clear();
    return true;
  }
  if (!options.certificates.convex_pair) return false;
  const Half_facet passage = convex_passage(*snapshot_, to.cell, q.cell);
  if (passage == Half_facet::none) return false;
  ++counts.edges;
  ++counts.convex_pair;
  chain.assign(1, passage);
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template void Body<D>::step_or_stay(std::span<const Point<D>>, const Body_options&,                       \
                                      std::vector<Blocked_move<D>>&, Body_counts&);                         \
  template bool Body<D>::is_plainly_free(const Particle<D>&, const Particle<D>&, const Particle<D>&,        \
                                         const Sweep_options&, Chain&, Edge_counts&) const;                 \
  template bool Body<D>::meets_at_end(const Way<D>&, std::uint32_t, const Sweep_options&, Blocked_move<D>&, \
                                      Body_counts&);                                                        \
  template bool Body<D>::sweep_meets_at_end(const Way<D>&, std::uint32_t, const Sweep_options&, Chain&,     \
                                            Blocked_move<D>&, Body_counts&);                                \
  template Blocked_move<D> Body<D>::move_or_stay(std::uint32_t, const Point<D>&, const Body_options&,       \
                                                 Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
