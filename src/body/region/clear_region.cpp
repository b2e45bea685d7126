// SPDX-License-Identifier: LGPL-3.0-or-later
// The region of a whole body, by a search from the cells of its vertices.
#include "clear_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "region_search.h"

namespace cellwalk::detail {
namespace {

/// The length of a vector whose square may underflow.
template <int D>
double scaled_length(const Vector<D>& n) {
  double largest = 0;
  for (const double x : n) largest = std::max(largest, std::abs(x));
  if (largest == 0) return 0;
  Vector<D> scaled;
  for (std::size_t k = 0; k < D; ++k) scaled[k] = n[k] / largest;
  return largest * length(scaled);
}

}  // namespace

template <int D>
void Clear_region<D>::move_inwards(double r) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point<D> low, high, sizes;
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    low[k] = next_above(box_.low(axis) + r);
    high[k] = next_below(box_.high(axis) - r);
    sizes[k] = std::max(std::abs(box_.low(axis)), std::abs(box_.high(axis)));
  }
  const std::vector<Wall_plane<D>> planes = std::exchange(planes_, {});
  pairs_.clear();
  box_ = {low, high};
  for (const Wall_plane<D>& plane : planes) {
    const Vector<D>& n = plane.normal;
    const double rounding = 2 * product_error * (magnitude<D>(n, sizes) + least_magnitude);
    const double way = r * scaled_length<D>(n) * (1 + 0x1p-48) + least_magnitude;
    // Both differences are rounded, too.
    const double inside = plane.inside - (rounding + way) * (1 + 0x1p-48);
    const double offset = inside - product_error * std::abs(inside);
    cut(Wall_plane<D>(Cut_plane<D>{n, 0, std::isfinite(offset) ? offset : -infinity}));
  }
}

template <int D>
std::optional<Clear_region<D>> find_clear_region(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                                 const Region_request<D>& request, Region_effort& effort) {
  thread_local Cell_list found;
  Region_request<D> larger = request;
  larger.margin += 2 * request.radius;
  Region_search<D> search(snapshot, anchor, larger, effort, found);
  if (!(request.by_clusters ? search.find_by_clusters() : search.find())) return {};
  if (request.radius == 0) return search.region();
  Clear_region<D> region = search.region();
  region.move_inwards(request.radius);
  if (!region.holds(anchor.position)) return {};
  if (request.keeps_all && !region.holds_all(request.positions)) return {};
  return region;
}

template void Clear_region<2>::move_inwards(double);
template void Clear_region<3>::move_inwards(double);

template std::optional<Clear_region<2>> find_clear_region<2>(const Snapshot<2>&, const Particle<2>&,
                                                             const Region_request<2>&, Region_effort&);
template std::optional<Clear_region<3>> find_clear_region<3>(const Snapshot<3>&, const Particle<3>&,
                                                             const Region_request<3>&, Region_effort&);

}  // namespace cellwalk::detail
