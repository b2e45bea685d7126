// SPDX-License-Identifier: LGPL-3.0-or-later
// The signs of the cells at a moving vertex, their planes and boundary zones, committed or restored.
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/environment/vertex_mover.h>
#include <cellwalk/internal/kernel/swept_simplex.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <utility>

#include "environment/snapshot/compiler.h"

namespace cellwalk::detail {
namespace {

/// If fewer cells than one for this number of blocks are withdrawn, they are sorted; else all blocks are
/// looked at.
constexpr std::size_t blocks_a_cell = 64;

/// Calls use() with the points of a simplex, one of them moved to x, in an order in which their orientation
/// is positive if it keeps its sense.
template <int D, class Use>
auto with_moved(const Cell_view<D>& cell, std::uint32_t point, const Point<D>& x, const Use& use) {
  const auto loop = cell.loop(0);
  // Facet 0 and the vertex off it.
  std::size_t apex = D * (D + 1) / 2;
  for (const std::uint16_t v : loop) apex -= v;
  const auto at = [&](std::size_t v) -> const Point<D>& {
    return cell.point_index(v) == point ? x : cell.point(v);
  };
  if constexpr (D == 2)
    return use(at(loop[0]), at(loop[1]), at(apex));
  else
    return use(at(loop[1]), at(loop[0]), at(loop[2]), at(apex));
}

/// Fetches the planes that will be written if the point moves, so that they arrive while the rest is decided.
template <int D>
void prefetch_planes(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  for (const Cell c : cells) __builtin_prefetch(snapshot.blocks(c), 1);
}

}  // namespace

template <int D>
Vertex_mover<D>::~Vertex_mover() {
  try {
    restore();
  } catch (...) {  // memory: certificates stay withdrawn
  }
}

template <int D>
Star_check Vertex_mover<D>::begin(std::uint32_t point, const Point<D>& target) {
  environment_.check_move(point, target);
  point_ = point;
  from_ = snapshot().point(point);
  target_ = target;
  environment_.stars().find_cells(snapshot(), point, star_);
  prefetch_planes<D>(snapshot(), star_);
  is_on_boundary_ = environment_.is_on_boundary(point, star_);
  for (const Cell c : star_)
    if (snapshot().view(c).vertex_count() != D + 1)
      throw Error(Error_code::usage, "point " + std::to_string(point) +
                                         " cannot be moved among bodies: cell " +
                                         std::to_string(snapshot().index(c)) +
                                         " is not a simplex; build the environment with "
                                         "Build_options::simplicial");
  Star_check check;
  if (from_ == target_) return check;
  check = check_cells();
  if (check.defect == Star_defect::none && is_on_boundary_ && runs_into_boundary())
    check.defect = Star_defect::boundary;
  return check;
}

/// All volumes are affine in the position of the point: if they are positive at the end, they are so always.
template <int D>
Star_check Vertex_mover<D>::check_cells() const {
  Star_check check;
  Predicate_counts counts;
  const auto sign = [&](const auto&... x) { return Exact::orientation(counts, x...); };
  const auto volume = [](const auto&... x) { return determinant<double>(x...).value; };
  for (const Cell c : star_) {
    const Cell_view<D> view = snapshot().view(c);
    if (with_moved<D>(view, point_, target_, sign) > 0) continue;
    const double before = with_moved<D>(view, point_, from_, volume),
                 after = with_moved<D>(view, point_, target_, volume);
    const double share = std::clamp(before / (before - after), 0.0, 1.0);
    if (check.defect != Star_defect::none && !(share < check.share)) continue;
    check = {Star_defect::cell, c, share >= 0 ? share : 0};
  }
  return check;
}

/// True if boundary facets at the point meet others on their way or at its end.
template <int D>
bool Vertex_mover<D>::runs_into_boundary() {
  Snapshot<D>& snapshot = *environment_.snapshot_;
  Predicate_counts counts;
  std::vector<Point<D>> polygon;
  Boundary_index<D>& boundary = environment_.boundary();
  if (boundary.is_way_free(snapshot.points(), point_, target_)) return false;
  for (const Half_facet w : Boundary_index<D>::facets(snapshot, star_)) {
    typename Swept_simplex<D>::Corners still;
    std::size_t corners = 0;
    const std::vector<std::uint32_t> loop = snapshot.loop(w);
    if (std::find(loop.begin(), loop.end(), point_) == loop.end()) continue;
    for (const std::uint32_t v : loop)
      if (v != point_) still[corners++] = snapshot.point(v);
    const Swept_simplex<D> swept(from_, target_, still, counts);
    for (const Half_facet f : boundary.meeting(snapshot.points(), swept.box())) {
      polygon.clear();
      bool is_at_point = false;
      for (const std::uint32_t v : snapshot.loop(f)) {
        is_at_point |= v == point_;
        polygon.push_back(snapshot.point(v));
      }
      if (!is_at_point && swept.reaches(polygon, counts)) return true;
    }
  }
  snapshot.move_point(point_, target_);
  bool is_refused = false;
  try {
    environment_.check_moved_boundary(point_, star_);
  } catch (const Error&) {
    is_refused = true;
  }
  snapshot.move_point(point_, from_);
  return is_refused;
}

template <int D>
void Vertex_mover<D>::place() {
  Snapshot<D>& snapshot = *environment_.snapshot_;
  is_withdrawn_.resize(snapshot.half_facet_slots() / 4);
  Snapshot_compiler<D> compiler(snapshot);
  for (const Cell c : star_) {
    if (is_withdrawn_[to_index(c)]) {
      compiler.forget(c);
      continue;
    }
    withdrawn_.push_back(c);
    is_withdrawn_[to_index(c)] = true;
    compiler.withdraw(c);
  }
  snapshot.move_point(point_, target_);
}

template <int D>
void Vertex_mover<D>::take_back() {
  environment_.snapshot_->move_point(point_, from_);
}

template <int D>
void Vertex_mover<D>::commit() {
  Snapshot_compiler<D>(*environment_.snapshot_).raise_epochs();
  environment_.follow_move(point_, is_on_boundary_);
}

template <int D>
void Vertex_mover<D>::restore() {
  if (withdrawn_.empty()) return;
  if (withdrawn_.size() < is_withdrawn_.size() / blocks_a_cell) {
    std::sort(withdrawn_.begin(), withdrawn_.end());
  } else {
    withdrawn_.clear();
    for (std::size_t i = 0; i < is_withdrawn_.size(); ++i)
      if (is_withdrawn_[i]) withdrawn_.push_back(Cell{static_cast<std::uint32_t>(i)});
  }
  Snapshot_compiler<D>(*environment_.snapshot_).certify_again(withdrawn_);
  for (const Cell c : withdrawn_) is_withdrawn_[to_index(c)] = false;
  withdrawn_.clear();
}

template class Vertex_mover<2>;
template class Vertex_mover<3>;

}  // namespace cellwalk::detail
