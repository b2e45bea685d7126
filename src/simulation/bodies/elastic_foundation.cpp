// SPDX-License-Identifier: LGPL-3.0-or-later
// Yields spread among neighbouring points of walls, and their recovery in each step.
#include <cellwalk/internal/records/scene_shape.h>
#include <cellwalk/internal/simulation/elastic_foundation.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "contact_yield.h"
#include "neighbour_lists.h"

namespace cellwalk {
namespace {

/// A yield that is a smaller share of the environment's diagonal is recovered at once.
constexpr double least_share = 0x1p-24;

/// The largest coordinate; infinite if one is no number.
template <std::size_t D>
double most_part(const std::array<double, D>& v) {
  double most = 0;
  for (const double x : v)
    most = std::isnan(x) ? std::numeric_limits<double>::infinity() : std::max(most, std::abs(x));
  return most;
}

}  // namespace

template <int D>
bool Elastic_foundation<D>::is_consistent() const {
  const std::size_t points = starts_.size();
  return points == snapshot_->points().size() && yields_.size() == points && may_yield_.size() == points &&
         detail::are_lists(first_, neighbours_, points, points) && detail::are_below(active_, points);
}

template <int D>
Elastic_foundation<D>::Elastic_foundation(const Snapshot<D>& snapshot, const Soft_walls& soft,
                                          std::span<const Scene_shape<D>> fixed)
    : snapshot_(&snapshot),
      soft_(soft),
      starts_(snapshot.points().begin(), snapshot.points().end()),
      yields_(starts_.size()),
      may_yield_(starts_.size(), 0) {
  Point<D> lower = starts_.at(0), upper = lower;
  for (const Point<D>& x : starts_)
    for (std::size_t k = 0; k < D; ++k) {
      lower[k] = std::min(lower[k], x[k]);
      upper[k] = std::max(upper[k], x[k]);
    }
  least_yield_ = least_share * length(upper - lower);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    if (snapshot.is_solid(cell)) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      if (!snapshot.is_impassable(facet)) continue;
      const std::vector<std::uint32_t> loop = snapshot.loop(facet);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t u = loop[k], v = loop[(k + 1) % loop.size()];
        may_yield_[u] = detail::distance<D>(fixed, starts_[u]) > 0;
        pairs.push_back({u, v});
        pairs.push_back({v, u});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_.resize(starts_.size() + 1);
  for (const auto& [u, v] : pairs) {
    ++first_[u + 1];
    neighbours_.push_back(v);
  }
  for (std::size_t i = 0; i < starts_.size(); ++i) first_[i + 1] += first_[i];
}

/// Each vertex keeps half of its increment, and its neighbours get the other half.
template <int D>
void Elastic_foundation<D>::spread(Increments& increments) const {
  std::map<std::uint32_t, Vector<D>> sums;
  for (const auto& [point, by] : increments) sums[point] = sums[point] + by;
  for (std::uint32_t k = 0; k < soft_.spread; ++k) {
    std::map<std::uint32_t, Vector<D>> wider;
    for (const auto& [point, by] : sums) {
      const std::uint32_t begin = first_[point], end = first_[point + 1];
      wider[point] = wider[point] + 0.5 * by;
      for (std::uint32_t i = begin; i < end; ++i)
        wider[neighbours_[i]] = wider[neighbours_[i]] + (0.5 / (end - begin)) * by;
    }
    sums = std::move(wider);
  }
  increments.assign(sums.begin(), sums.end());
}

template <int D>
void Elastic_foundation<D>::press(const World<D>& world) {
  std::vector<std::uint32_t> active;
  for (const std::uint32_t point : active_) {
    if (yields_[point] == Vector<D>{}) continue;  // where it was is where it is
    yields_[point] = (1 - soft_.recovery) * yields_[point];
    if (length(yields_[point]) < least_yield_) yields_[point] = {};
    active.push_back(point);
  }
  Increments increments;
  const double share = soft_.compliance / (1 + soft_.compliance);
  for (const Run_contact<D>& met : world.contacts())
    detail::add_yields(*snapshot_, world, met, share, increments);
  spread(increments);
  for (const auto& [point, by] : increments) {
    if (!may_yield_[point]) continue;
    yields_[point] = yields_[point] + by;
    active.push_back(point);
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  active_ = std::move(active);
  if (std::isfinite(force())) return;
  const auto most =
      std::ranges::max_element(active_, {}, [&](std::uint32_t point) { return most_part(yields_[point]); });
  throw Error(Error_code::input,
              "soft walls: the force on point " + std::to_string(*most) + " after step " +
                  std::to_string(world.steps_done()) +
                  " is not finite: take a smaller time step, slower motion, or a greater compliance");
}

template <int D>
std::vector<Vertex_move<D>> Elastic_foundation<D>::targets() const {
  std::vector<Vertex_move<D>> result;
  result.reserve(active_.size());
  for (const std::uint32_t point : active_) result.push_back({point, starts_[point] + yields_[point]});
  return result;
}

template <int D>
void Elastic_foundation<D>::follow(std::span<const Vertex_move<D>> moves, const Move_report<D>& report) {
  std::map<std::uint32_t, Point<D>> asked;
  if (report.short_of_target.empty()) return;
  for (const Vertex_move<D>& move : moves) asked[move.point] = move.target;
  for (const Vertex_result<D>& result : report.short_of_target)
    if (may_yield_[result.point] && std::ranges::binary_search(active_, result.point))
      yields_[result.point] = yields_[result.point] + (result.position - asked.at(result.point));
}

template <int D>
double Elastic_foundation<D>::largest_yield() const {
  double result = 0;
  for (const std::uint32_t point : active_) result = std::max(result, length(yields_[point]));
  return result;
}

template <int D>
double Elastic_foundation<D>::force() const {
  double sum = 0;
  for (const std::uint32_t point : active_) sum += length(yields_[point]);
  return sum / soft_.compliance;
}

template class Elastic_foundation<2>;
template class Elastic_foundation<3>;

}  // namespace cellwalk
