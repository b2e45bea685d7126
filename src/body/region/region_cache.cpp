// SPDX-License-Identifier: LGPL-3.0-or-later
// The rules by which the region of a body is searched, kept and given up.
#include "region_cache.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// Steps without a search after one that lost a target: a wall is in its way, and may be for a while.
constexpr std::uint32_t backoff_with_targets = 6;
/// After one that lost positions; twice as many after each of those in a row.
constexpr std::uint32_t least_backoff = 1, most_backoff = 64, most_backoff_of_little = 512;
/// The largest number of cells of a search, which must not cost more than the tests it saves.
constexpr std::size_t cells_per_vertex = 128, least_cells = 64, most_cells = 4096;

/// The largest numbers of clusters and of walls in the search for walls about a body whose parts have
/// regions.
constexpr std::size_t most_body_clusters = 64;
constexpr std::size_t walls_per_vertex = 2, least_body_walls = 128, most_body_walls = 1024;

}  // namespace

template <int D>
void Region_cache<D>::change_outside(std::uint32_t vertex, bool is_outside, const Body_topology& topology) {
  is_outside_[vertex] = is_outside;
  const std::uint32_t change = is_outside ? 1 : ~std::uint32_t{0};
  outside_ += change;
  for (const Corner& corner : topology.corners_of(vertex)) outside_neighbours_[corner.other] += change;
}

template <int D>
bool Region_cache<D>::must_wait() {
  if (!certificates_.body_region) return true;
  std::uint32_t& backoff = holds_body() ? target_backoff_ : search_backoff_;
  if (backoff == 0) return false;
  --backoff;
  return true;
}

template <int D>
std::optional<Clear_region<D>> Region_cache<D>::search(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                       std::span<const Point<D>> positions,
                                                       std::span<const Point<D>> targets,
                                                       Body_counts& counts) {
  Region_request<D> request;
  request.positions = positions;
  request.targets = targets;
  request.most_cells = std::clamp(cells_per_vertex * positions.size(), least_cells, most_cells);
  request.steps_ahead = steps_ahead_;
  request.radius = radius_;
  request.by_clusters = certificates_.clusters && has_parts();
  if (request.by_clusters) {
    request.most_cells = most_body_clusters;
    request.most_walls = std::clamp(walls_per_vertex * positions.size(), least_body_walls, most_body_walls);
    request.most_planes = Clear_region<D>::most_planes;
  }
  Region_effort effort;
  auto found = find_clear_region(snapshot, anchor, request, effort);
  counts.region_cells += effort.cells;
  counts.region_walls += effort.walls;
  steps_ahead_ = effort.is_exhausted ? 0.5 * steps_ahead_
                                     : std::min(2 * steps_ahead_ + 1, Region_request<D>{}.steps_ahead);
  return found;
}

template <int D>
bool Region_cache<D>::take(const std::optional<Clear_region<D>>& found, std::span<const Point<D>> targets,
                           Body_counts& counts) {
  region_ = found;
  ++(found ? counts.regions : counts.no_region);
  if (holds_body()) {
    next_backoff_ = least_backoff;
    if (region_->holds_all(targets)) return true;
    target_backoff_ = backoff_with_targets;
    return false;
  }
  // One that holds little of a large body serves little, as of a rod: it is looked for the less.
  const bool is_of_use = !has_parts() || 2 * outside_ < is_outside_.size();
  search_backoff_ = next_backoff_;
  next_backoff_ = is_of_use ? std::min(2 * next_backoff_, most_backoff)
                            : std::min(8 * next_backoff_, most_backoff_of_little);
  anchor_vertex_ = anchor_vertex_ + 1 == is_outside_.size() ? 0 : anchor_vertex_ + 1;
  return false;
}

template <int D>
void Region_cache<D>::spread_marks() {
  are_all_stale_ = false;
  std::fill(is_vertex_stale_.begin(), is_vertex_stale_.end(), true);
}

template <int D>
void Region_cache<D>::pass_mark_on(std::uint32_t vertex, const Body_topology& topology) {
  is_vertex_stale_[vertex] = false;
  for (const Corner& corner : topology.corners_of(vertex)) is_edge_stale_[corner.edge] = true;
}

template class Region_cache<2>;
template class Region_cache<3>;

}  // namespace cellwalk::detail
