// SPDX-License-Identifier: LGPL-3.0-or-later
// The corners of facets packed into lanes, in the order in which they are tested.
#include <cellwalk/internal/edge/certain_line.h>

#include <algorithm>
#include <array>
#include <limits>

namespace cellwalk::detail {
namespace {

constexpr std::size_t lanes = 4;
constexpr unsigned all_lanes = 15;

/// Corners in the other order, so that the ridges are again those of the first lanes.
template <int D>
Float4 turned_back(Float4 ends, unsigned ignored) {
  constexpr unsigned but_one_ridge = 14, but_two_ridges = 12;
  if (D == 2 || ignored == but_one_ridge) return __builtin_shufflevector(ends, ends, 1, 0, 2, 3);
  if (ignored == but_two_ridges) return __builtin_shufflevector(ends, ends, 2, 1, 0, 3);
  return __builtin_shufflevector(ends, ends, 3, 2, 1, 0);
}

}  // namespace

template <int D>
void append_corners(const Plane_frame<D>& frame, const Cell_view<D>& cell, std::size_t facet,
                    std::vector<Facet_corners<D>>& corners) {
  const auto loop = cell.loop(facet);
  // Of more than four corners, each but the first repeats the last one before it.
  const std::size_t step = loop.size() <= lanes ? lanes : lanes - 1;
  for (std::size_t first = 0; first < loop.size(); first += step) {
    std::array<const Point<D>*, lanes> points;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      points[lane] = &cell.point(loop[first + lane < loop.size() ? first + lane : 0]);
    Facet_corners<D>& some = corners.emplace_back();
    some.continues = first + step < loop.size();
    some.ignored = all_lanes << std::min(step, loop.size() - first) & all_lanes;
    Int4 is_inside{-1, -1, -1, -1};
    for (std::size_t k = 0; k < D; ++k) {
      const auto mapped = [&](std::size_t lane) {
        return static_cast<float>(((*points[lane])[k] - frame.centre[k]) * frame.scale);
      };
      some.lanes[k] = Float4{mapped(0), mapped(1), mapped(2), mapped(3)};
      is_inside &= std::bit_cast<Float4>(std::bit_cast<Int4>(some.lanes[k]) & 0x7fffffff) <= 1;
    }
    // Outside of the frame the bound does not hold; nothing compares with NaN.
    if (lane_mask(is_inside) != all_lanes) [[unlikely]]
      for (Float4& ends : some.lanes) ends += std::numeric_limits<float>::quiet_NaN();
  }
}

template <int D>
void append_from_behind(std::span<const Facet_corners<D>> facets, std::vector<Facet_corners<D>>& corners) {
  for (std::size_t i = facets.size(); i-- > 0;) {
    Facet_corners<D>& some = corners.emplace_back(facets[i]);
    for (Float4& ends : some.lanes) ends = turned_back<D>(ends, some.ignored);
    some.continues = i > 0 && facets[i - 1].continues;
  }
}

template void append_corners<2>(const Plane_frame<2>&, const Cell_view<2>&, std::size_t,
                                std::vector<Facet_corners<2>>&);
template void append_corners<3>(const Plane_frame<3>&, const Cell_view<3>&, std::size_t,
                                std::vector<Facet_corners<3>>&);
template void append_from_behind<2>(std::span<const Facet_corners<2>>, std::vector<Facet_corners<2>>&);
template void append_from_behind<3>(std::span<const Facet_corners<3>>, std::vector<Facet_corners<3>>&);

}  // namespace cellwalk::detail
