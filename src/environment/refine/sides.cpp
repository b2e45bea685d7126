// SPDX-License-Identifier: LGPL-3.0-or-later
// Points by the ends of their side, in order along it.
#include "sides.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>

namespace cellwalk::detail {

template <int D>
std::uint64_t Sides<D>::key(std::uint32_t u, std::uint32_t v) {
  return std::uint64_t{std::min(u, v)} << 32 | std::max(u, v);
}

template <int D>
bool Sides<D>::is_inside(std::uint32_t u, std::uint32_t v, std::uint32_t x) const {
  const Point<D>&a = points_[u], &b = points_[v], &p = points_[x];
  if (tolerance_ == 0) return p != a && p != b && on_segment<D>(a, b, p);
  const Vector<D> along = b - a, to = p - a;
  const double square = dot(along, along), share = dot(along, to) / square;
  return share > 0 && share < 1 && length(to - share * along) <= tolerance_ && length(to) > tolerance_ &&
         length(p - b) > tolerance_;
}

template <int D>
bool Sides<D>::is_before(std::uint32_t u, std::uint32_t v, std::uint32_t x, std::uint32_t y) const {
  if (tolerance_ == 0) return (points_[u] < points_[v]) == (points_[x] < points_[y]);
  return dot(points_[v] - points_[u], points_[y] - points_[x]) > 0;
}

template <int D>
bool Sides<D>::add(std::uint32_t u, std::uint32_t v, std::uint32_t x) {
  std::vector<std::uint32_t>& own = inside_[key(u, v)];
  if (std::find(own.begin(), own.end(), x) != own.end()) return false;
  const std::uint32_t low = std::min(u, v), high = std::max(u, v);
  if (is_end_.size() <= high) is_end_.resize(points_.size(), 0);
  is_end_[low] = is_end_[high] = 1;
  own.insert(
      std::find_if(own.begin(), own.end(), [&](std::uint32_t y) { return is_before(low, high, x, y); }), x);
  return true;
}

template <int D>
std::span<const std::uint32_t> Sides<D>::inside(std::uint32_t u, std::uint32_t v) const {
  const auto [low, high] = std::minmax(u, v);
  if (is_end_.size() <= high || !is_end_[low] || !is_end_[high]) return {};
  const auto at = inside_.find(key(u, v));
  return at == inside_.end() ? std::span<const std::uint32_t>{} : at->second;
}

template <int D>
Facet_loop Sides<D>::subdivided(std::span<const std::uint32_t> loop) const {
  Facet_loop longer;
  for (std::size_t i = 0; i < side_count<D>(loop); ++i) {
    const std::uint32_t u = loop[i], v = loop[(i + 1) % loop.size()];
    longer.push_back(u);
    const auto between = inside(u, v);
    if (u < v)
      longer.insert(longer.end(), between.begin(), between.end());
    else
      longer.insert(longer.end(), between.rbegin(), between.rend());
  }
  if constexpr (D == 2) longer.push_back(loop[1]);
  return longer;
}

template class Sides<2>;
template class Sides<3>;

}  // namespace cellwalk::detail
