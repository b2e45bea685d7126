// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body by the rule of the paper: what meets a wall stays where it is.
#include <cellwalk/body/body.h>

namespace cellwalk {

template <int D>
void Body<D>::step_or_stay(std::span<const Point<D>> targets, const Body_options& options,
                           std::vector<Blocked_move>& blocked, Body_counts& counts) {
  if (positions_.empty()) return;
  counts.moves += positions_.size();
  if (!options.clearance)
    leave_region(counts);
  else if (moves_in_region(targets, counts))
    return;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    if (moves_in_region(v, targets[v], counts)) continue;
    const Blocked_move answer = move_or_stay(v, targets[v], options, counts);
    if (!answer.is_vertex_blocked && (answer.edges | answer.swept_edges) == 0) continue;
    counts.contacts += answer.stays();
    blocked.push_back(answer);
  }
}

template <int D>
Blocked_move Body<D>::move_or_stay(std::uint32_t vertex, const Point<D>& target, const Body_options& options,
                                   Body_counts& counts) {
  Blocked_move answer;
  answer.vertex = vertex;
  catch_up_vertex(vertex, counts);
  const Particle<D> from = particles_[vertex];
  Particle<D> to = from;
  visited_.clear();
  crossed_.clear();
  const Walk_result<D> walked =
      move(*snapshot_, to, target, counts.edges.walk, {Walk_strategy::certified, &visited_, &crossed_});
  if (walked.contact) {
    answer.is_vertex_blocked = true;
    return answer;
  }
  const Way<D> way{from, to, visited_, crossed_, false};
  Sweep_options at_end = options.sweep;
  at_end.sweep = Sweep::three_segments;
  const std::uint32_t begin = corner_begin_[vertex], end = corner_begin_[vertex + 1];
  moved_chains_.resize(end - begin);
  for (std::uint32_t i = begin; i < end; ++i) {
    const Corner& corner = corners_[i];
    const std::uint64_t bit = std::uint64_t{1} << (i - begin);
    catch_up_edge(corner.edge, counts);
    const Chain before = seen_from(corner);
    const Particle<D>& q = particles_[corner.other];
    std::optional<Chain> chain = free_chain(*snapshot_, way, q, before, options.sweep, counts.edges);
    if (!chain && options.sweep.sweep != Sweep::three_segments) {
      answer.swept_edges |= bit;
      chain = free_chain(*snapshot_, way, q, before, at_end, counts.edges);
    }
    if (chain)
      moved_chains_[i - begin].chain = *chain;
    else
      answer.edges |= bit;
  }
  if (answer.stays()) return answer;
  are_faces_swept_ = false;
  commit(vertex, to);
  return answer;
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template void Body<D>::step_or_stay(std::span<const Point<D>>, const Body_options&,                       \
                                      std::vector<Blocked_move>&, Body_counts&);                            \
  template Blocked_move Body<D>::move_or_stay(std::uint32_t, const Point<D>&, const Body_options&, Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
