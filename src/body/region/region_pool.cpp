// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice of regions for the stars of vertices, and the limits of the searches for them.
#include "region_pool.h"

#include <cellwalk/internal/environment/cell_cluster.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// If there are no more clusters, all are made before the first step.
constexpr std::uint32_t clusters_at_once = 1024;
/// The largest numbers of clusters and walls of a search.
constexpr std::size_t most_clusters = 64, most_walls = 256;
/// The largest number of walls of all searches in a step, so that no step is much longer than others: one
/// more search may begin.
constexpr std::size_t least_walls_a_step = 128, walls_a_vertex = 4;
/// Moves without a search after one in vain; twice as many after each of those in a row.
constexpr std::uint8_t least_wait = 4, most_wait = 128;
/// The largest number of regions, or one for this number of vertices if those are more.
constexpr std::size_t least_places = 64, vertices_a_place = 4;
/// The number of regions that are tried before a new one is searched.
constexpr std::size_t most_tried = 64;
/// The margin about a star, in its sizes.
constexpr double least_margin = 0.05, most_margin = 16;

}  // namespace

template <int D>
Region_pool<D>::Region_pool(std::size_t vertices, const Body_certificates& certificates, double radius)
    : by_clusters_(certificates.clusters), radius_(radius) {
  if (!certificates.star_regions || vertices < certificates.least_vertices_of_parts) return;
  known_.resize(vertices);
  for (Known& known : known_) known = Known{none, none, none, none};
  wait_.resize(vertices);
  waits_.resize(vertices, least_wait);
}

template <int D>
void Region_pool<D>::prepare(const Snapshot<D>& snapshot, std::span<const Particle<D>> particles) const {
  if (known_.empty()) return;
  const Cell_clusters<D>& clusters = snapshot.clusters();
  if (const std::uint32_t count = clusters.size(snapshot); count <= clusters_at_once) {
    for (std::uint32_t number = 0; number < count; ++number) clusters.cluster(snapshot, number);
    return;
  }
  for (const Particle<D>& particle : particles) {
    const auto& here = clusters.cluster(snapshot, clusters.cluster_of(snapshot, particle.cell));
    for (const Facet_boxes<D>& boxes : here.passages)
      for (std::size_t lane = 0; lane < 4; ++lane)
        if (boxes.low[0][lane] <= boxes.high[0][lane]) clusters.cluster(snapshot, boxes.facets[lane]);
  }
}

template <int D>
void Region_pool<D>::begin_step(bool is_used) {
  is_used_ = is_used && !known_.empty();
  walls_left_ = least_walls_a_step + walls_a_vertex * known_.size();
}

template <int D>
bool Region_pool<D>::know_star(std::uint32_t vertex, int region, const Body_topology& topology) const {
  for (const Corner& corner : topology.corners_of(vertex))
    if (!knows(corner.other, region)) return false;
  return true;
}

template <int D>
void Region_pool<D>::add(std::uint32_t vertex, int region) {
  Known& known = known_[vertex];
  if (known[3] != none) --users(known[3]);
  known = Known{region, known[0], known[1], known[2]};
  ++users(region);
}

template <int D>
bool Region_pool<D>::try_move_in_known(std::uint32_t vertex, const Point<D>& target,
                                       const Body_topology& topology) {
  const Known known = known_[vertex];
  for (int k = 0; k < places_known && known[k] != none; ++k)
    if (know_star(vertex, known[k], topology) && at(known[k]).holds(target)) {
      stay_in(vertex, known[k], target);
      return true;
    }
  return false;
}

template <int D>
bool Region_pool<D>::try_move_in_other(std::uint32_t vertex, const Point<D>& target,
                                       std::span<const Point<D>> positions, const Body_topology& topology) {
  const Known known = known_[vertex];
  if (wait_[vertex] > 0) return false;
  // Others that hold the neighbours may hold the vertex as well, or its neighbours without their knowing it.
  const auto has = [&](int region) {
    if (!at(region).holds(target) || !take_in(vertex, region, positions, topology)) return false;
    stay_in(vertex, region, target);
    return true;
  };
  for (int k = 0; k < places_known && known[k] != none; ++k)
    if (has(known[k])) return true;
  for (const Corner& corner : topology.corners_of(vertex)) {
    const Known of_other = known_[corner.other];
    for (int k = 0; k < places_known && of_other[k] != none; ++k)
      if (!knows(vertex, of_other[k]) && has(of_other[k])) return true;
  }
  if (regions_.size() > most_tried) return false;
  for (std::size_t region = 0; region < regions_.size(); ++region)
    if (has(static_cast<int>(region))) return true;
  return false;
}

/// The vertex moves, within a region unless that is `none`: it comes first of those that hold it then.
template <int D>
void Region_pool<D>::stay_in(std::uint32_t vertex, int region, const Point<D>& position) {
  Known& known = known_[vertex];
  Known kept{region, none, none, none};
  int count = region == none ? 0 : 1;
  for (int k = 0; k < places_known && known[k] != none; ++k) {
    if (known[k] == region) continue;
    if (at(known[k]).holds(position))
      kept[count++] = known[k];
    else
      --users(known[k]);
  }
  known = kept;
}

/// True if a region holds a vertex and its neighbours: then it is listed for them.
template <int D>
bool Region_pool<D>::take_in(std::uint32_t vertex, int region, std::span<const Point<D>> positions,
                             const Body_topology& topology) {
  const auto takes = [&](std::uint32_t v) {
    if (knows(v, region)) return true;
    if (!at(region).holds(positions[v])) return false;
    add(v, region);
    return true;
  };
  if (!takes(vertex)) return false;
  return std::ranges::all_of(topology.corners_of(vertex),
                             [&](const Corner& corner) { return takes(corner.other); });
}

template <int D>
bool Region_pool<D>::should_search(std::uint32_t vertex) {
  if (walls_left_ == 0) return false;
  if (wait_[vertex] == 0) return true;
  --wait_[vertex];
  return false;
}

template <int D>
bool Region_pool<D>::search(const Snapshot<D>& snapshot, const Particle<D>& particle, std::uint32_t vertex,
                            const Point<D>& target, std::span<const Point<D>> positions,
                            const Body_topology& topology, Body_counts& counts) {
  thread_local std::vector<Point<D>> star;
  star.assign({particle.position, target});
  for (const Corner& corner : topology.corners_of(vertex)) star.push_back(positions[corner.other]);
  const Box<D> box = box_of<D>(star);
  double size = 0;
  for (std::size_t k = 0; k < D; ++k) size = std::max(size, box.high[k] - box.low[k]);

  Region_request<D> request;
  request.positions = star;
  request.most_cells = most_clusters;
  request.by_clusters = by_clusters_;
  request.most_walls = most_walls;
  request.margin = margin_ * size;
  request.keeps_all = true;
  request.radius = radius_;
  request.most_planes = Clear_region<D>::most_planes;
  Region_effort effort;
  auto found = find_clear_region(snapshot, particle, request, effort);
  counts.region_cells += effort.cells;
  counts.region_walls += effort.walls;
  walls_left_ -= std::min<std::size_t>(walls_left_, effort.walls + 1);
  if (effort.is_exhausted)
    margin_ = std::max(least_margin, 0.7 * margin_);
  else if (found && 2 * effort.walls < most_walls)
    margin_ = std::min(most_margin, 1.4 * margin_);
  ++(found ? counts.regions : counts.no_region);
  const int place = found ? free_place() : none;
  if (place == none) {
    wait_[vertex] = waits_[vertex];
    waits_[vertex] = static_cast<std::uint8_t>(std::min<int>(2 * waits_[vertex], most_wait));
    return false;
  }
  waits_[vertex] = least_wait;
  regions_[static_cast<std::size_t>(place)] = *found;
  return take_in(vertex, place, positions, topology);
}

template <int D>
int Region_pool<D>::free_place() {
  if (regions_.size() < std::max(least_places, known_.size() / vertices_a_place)) {
    const Point<D> origin{};
    regions_.emplace_back(Particle<D>{}, origin, origin);
    users_.push_back(0);
    return static_cast<int>(regions_.size() - 1);
  }
  for (std::size_t tried = 0; tried < regions_.size(); ++tried) {
    hand_ = static_cast<std::size_t>(hand_) + 1 == regions_.size() ? 0 : hand_ + 1;
    if (users(hand_) == 0) return hand_;
  }
  return none;
}

template <int D>
void Region_pool<D>::place(std::uint32_t vertex, const Point<D>& position) {
  if (holds(vertex)) stay_in(vertex, none, position);
}

template <int D>
void Region_pool<D>::forget(std::uint32_t vertex) {
  Known& known = known_[vertex];
  for (int k = 0; k < places_known && known[k] != none; ++k) --users(known[k]);
  known = Known{none, none, none, none};
}

template <int D>
void Region_pool<D>::forget_all() {
  for (Known& known : known_) known = Known{none, none, none, none};
  std::fill(users_.begin(), users_.end(), 0);
}

template <int D>
void Region_pool<D>::clear() {
  forget_all();
  regions_.clear();
  users_.clear();
}

template <int D>
bool Region_pool<D>::is_consistent(std::size_t vertices) const {
  const int regions = static_cast<int>(regions_.size());
  const std::size_t places = std::max(least_places, known_.size() / vertices_a_place);
  if (regions_.size() > places || users_.size() != regions_.size() || hand_ < 0 ||
      static_cast<std::size_t>(hand_) >= places)
    return false;
  if ((known_.size() != vertices && !known_.empty()) || wait_.size() != known_.size() ||
      waits_.size() != known_.size())
    return false;
  return std::ranges::all_of(known_, [&](const Known& known) {
    for (int k = 0; k < places_known; ++k)
      if (known[k] < none || known[k] >= regions) return false;
    return true;
  });
}

template class Region_pool<2>;
template class Region_pool<3>;

}  // namespace cellwalk::detail
