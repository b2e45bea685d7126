// SPDX-License-Identifier: LGPL-3.0-or-later
// A body in a region free of walls: its vertices move without tests, and are registered when that is needed.
#include <cellwalk/body/body.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cstring>

namespace cellwalk {
namespace {

/// Steps without a search after one that lost a target: a wall is in its way, and may be for a while.
constexpr std::uint32_t patience_with_targets = 6;
/// After one that lost positions; twice as many after each of those in a row.
constexpr std::uint32_t least_patience = 1, most_patience = 64;
/// A search may look at so many cells: it must not cost more than the tests it saves.
constexpr std::size_t cells_per_vertex = 128, least_cells = 64, most_cells = 4096;

[[noreturn, gnu::noinline]] void refuse_rule(const Body_options& options) {
  throw Error(Error_code::usage,
              options.edges == Edge_rule::at_target
                  ? "a step that looks at edges where their vertex goes has no contact to slide "
                    "from: use Contact_policy::reject with Edge_rule::at_target"
                  : "a step that sweeps edges reports contacts only: use Edge_rule::at_target "
                    "to have what blocks reported");
}

void check_rule(const Body_options& options) {
  const bool is_at_target = options.edges == Edge_rule::at_target;
  if (is_at_target ? options.policy != Contact_policy::reject : options.reported != Reported::contacts)
    refuse_rule(options);
}

}  // namespace

/// Moves all vertices without registering them.
template <int D>
void Body<D>::take_all(std::span<const Point<D>> targets, Body_counts& counts) {
  std::memcpy(positions_.data(), targets.data(), targets.size_bytes());
  are_all_behind_ = true;
  counts.in_region += targets.size();
}

/// Begins a step: true if all vertices could be moved without a test, and were.
template <int D>
[[gnu::always_inline]] inline bool Body<D>::moves_at_once(std::span<const Point<D>> targets,
                                                          const Body_options& options, Body_counts& counts) {
  check_epoch();
  counts.moves += targets.size();
  if (options.clearance && region_ && outside_ == 0 && region_->holds_all(targets)) [[likely]] {
    take_all(targets, counts);
    return true;
  }
  return targets.empty() || moves_in_new_region(targets, options, counts);
}

/// The same where the region that there is does not do. Not to be inlined: the question above is short.
template <int D>
[[gnu::noinline]] bool Body<D>::moves_in_new_region(std::span<const Point<D>> targets,
                                                    const Body_options& options, Body_counts& counts) {
  if (region_ && outside_ == 0) is_apart_ = true;
  if (!options.clearance) {
    const bool is_apart = is_apart_;
    leave_region(counts);
    is_apart_ = is_apart;
    return false;
  }
  if (!renew_region(targets, counts)) {
    note_all_behind();
    return false;
  }
  take_all(targets, counts);
  return true;
}

/// Here, where the compiler sees the question with which most steps end.
template <int D>
void Body<D>::step(std::span<const Point<D>> targets, const Body_options& options, Step_report<D>& report,
                   Body_counts& counts) {
  check_rule(options);
  if (moves_at_once(targets, options, counts)) return;
  if (options.edges == Edge_rule::at_target)
    move_each_or_stay(targets, options, report, counts);
  else
    move_each(targets, options, report.contacts, counts);
}

/// Moves one vertex, if the region allows it.
template <int D>
bool Body<D>::moves_in_region(std::uint32_t vertex, const Point<D>& target, Body_counts& counts) {
  if (!region_ || is_outside_[vertex] || outside_near_[vertex] != 0 || !region_->holds(target)) return false;
  positions_[vertex] = target;
  vertex_behind_[vertex] = true;
  if (!faces_.empty())
    for (std::uint32_t i = face_corner_begin_[vertex]; i < face_corner_begin_[vertex + 1]; ++i)
      rests_[face_corners_[i].face].clear();
  ++counts.in_region;
  return true;
}

/// Looks for a region that holds the body where it is and where it goes; what it does not hold is registered. True if it holds
/// all.
template <int D>
bool Body<D>::renew_region(std::span<const Point<D>> targets, Body_counts& counts) {
  std::uint32_t& patience = region_ && outside_ == 0 ? target_patience_ : patience_;
  if (patience > 0) {
    --patience;
    return false;
  }
  note_all_behind();
  catch_up_vertex(anchor_vertex_, counts);
  Region_request<D> request;
  request.positions = positions_;
  request.targets = targets;
  request.most_cells = std::clamp(cells_per_vertex * positions_.size(), least_cells, most_cells);
  request.steps_ahead = steps_ahead_;
  Region_effort effort;
  const auto found = find_clear_region(*snapshot_, particles_[anchor_vertex_], request, effort);
  counts.region_cells += effort.cells;
  steps_ahead_ = effort.is_exhausted ? 0.5 * steps_ahead_
                                     : std::min(2 * steps_ahead_ + 1, Region_request<D>{}.steps_ahead);
  // What leaves the old region is registered while that is still there.
  const bool holds_all = found && found->holds_all(positions_);
  if (outside_ != 0 || !holds_all)
    for (std::uint32_t v = 0; v < positions_.size(); ++v) {
      set_outside(v, !found || !found->holds(positions_[v]));
      if (is_outside_[v]) catch_up_vertex(v, counts);
    }
  region_ = found;
  ++(found ? counts.regions : counts.no_region);
  if (found && outside_ == 0) {
    next_patience_ = least_patience;
    if (region_->holds_all(targets)) return true;
    target_patience_ = patience_with_targets;
    return false;
  }
  patience_ = next_patience_;
  next_patience_ = std::min(2 * next_patience_, most_patience);
  anchor_vertex_ = anchor_vertex_ + 1 == positions_.size() ? 0 : anchor_vertex_ + 1;
  return false;
}

template <int D>
void Body<D>::note_all_behind() {
  if (!are_all_behind_) return;
  are_all_behind_ = false;
  std::fill(vertex_behind_.begin(), vertex_behind_.end(), true);
  for (Face_rests& rests : rests_) rests.clear();
}

template <int D>
void Body<D>::catch_up_vertex(std::uint32_t vertex, Body_counts& counts) {
  if (!vertex_behind_[vertex]) return;
  vertex_behind_[vertex] = false;
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i)
    edge_behind_[corners_[i].edge] = true;
  Particle<D>& particle = particles_[vertex];
  const Point<D>& position = positions_[vertex];
  // On a facet, a vertex that is where it was keeps its cell: on which side of walls in that plane it slides depends on it.
  if (particle.position == position) return;
  ++counts.catch_ups;
  // A point strictly inside a cell is in no other one, whichever way it came. Else, between two points of the region is no wall.
  Walk_counts& walks = counts.edges.walk;
  Cell cell = particle.cell;
  if (!detail::certainly_inside(*snapshot_, cell, position, walks))
    cell = detail::certain_end(*snapshot_, region_->anchor(), position, walks);
  if (cell != Cell::none) {
    particle = {position, cell, D, 0};
    return;
  }
  particle = region_->anchor();
  move(*snapshot_, particle, position, walks);
}

template <int D>
void Body<D>::catch_up_edge(std::uint32_t edge, Body_counts& counts) {
  const auto [u, v] = edges_[edge];
  catch_up_vertex(u, counts);
  catch_up_vertex(v, counts);
  if (!edge_behind_[edge]) return;
  edge_behind_[edge] = false;
  chains_[edge] = find_any_chain(*snapshot_, particles_[u], particles_[v], counts.edges.walk).chain;
}

template <int D>
void Body<D>::catch_up(Body_counts& counts) {
  check_epoch();
  note_all_behind();
  for (std::uint32_t v = 0; v < positions_.size(); ++v) catch_up_vertex(v, counts);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) catch_up_edge(e, counts);
}

template <int D>
void Body<D>::leave_region(Body_counts& counts) {
  catch_up(counts);
  region_.reset();
  is_apart_ = false;  // walls may be put up next
}

template <int D>
void Body<D>::place(std::uint32_t vertex, const Point<D>& position) {
  positions_[vertex] = position;
  if (region_) set_outside(vertex, !region_->holds(position));
}

/// Notes that a vertex lies in the region or not.
template <int D>
void Body<D>::set_outside(std::uint32_t vertex, bool is_outside) {
  if (is_outside == static_cast<bool>(is_outside_[vertex])) return;
  is_outside_[vertex] = is_outside;
  const std::uint32_t change = is_outside ? 1 : ~std::uint32_t{0};
  outside_ += change;
  for (std::uint32_t i = corner_begin_[vertex]; i < corner_begin_[vertex + 1]; ++i)
    outside_near_[corners_[i].other] += change;
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template void Body<D>::step(std::span<const Point<D>>, const Body_options&, Step_report<D>&,              \
                              Body_counts&);                                                                \
  template bool Body<D>::moves_at_once(std::span<const Point<D>>, const Body_options&, Body_counts&);       \
  template void Body<D>::take_all(std::span<const Point<D>>, Body_counts&);                                 \
  template bool Body<D>::moves_in_new_region(std::span<const Point<D>>, const Body_options&, Body_counts&); \
  template bool Body<D>::moves_in_region(std::uint32_t, const Point<D>&, Body_counts&);                     \
  template bool Body<D>::renew_region(std::span<const Point<D>>, Body_counts&);                             \
  template void Body<D>::note_all_behind();                                                                 \
  template void Body<D>::catch_up_vertex(std::uint32_t, Body_counts&);                                      \
  template void Body<D>::catch_up_edge(std::uint32_t, Body_counts&);                                        \
  template void Body<D>::catch_up(Body_counts&);                                                            \
  template void Body<D>::leave_region(Body_counts&);                                                        \
  template void Body<D>::place(std::uint32_t, const Point<D>&);                                             \
  template void Body<D>::set_outside(std::uint32_t, bool);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
