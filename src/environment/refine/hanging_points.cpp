// SPDX-License-Identifier: LGPL-3.0-or-later
// Sides take the points of facets near them until there are no more.
#include "hanging_points.h"

#include <cellwalk/internal/environment/box_grid.h>

#include <algorithm>
#include <numeric>

namespace cellwalk::detail {
namespace {

/// Facets that pairs join, directly or through others, have the same number.
std::vector<std::uint32_t> patches(std::size_t facets, std::span<const Facet_pair> pairs) {
  std::vector<std::uint32_t> patch(facets);
  std::iota(patch.begin(), patch.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (patch[i] != i) i = patch[i] = patch[patch[i]];
    return i;
  };
  for (const auto& [i, j] : pairs) {
    const auto [low, high] = std::minmax({root(i), root(j)});
    patch[high] = low;
  }
  for (std::uint32_t i = 0; i < facets; ++i) patch[i] = root(i);
  return patch;
}

/// The facets whose sides take points: exactly, those in pairs; otherwise all, as points that are only near a
/// side bend it for all cells there.
std::vector<std::uint32_t> takers(std::size_t facets, std::span<const Facet_pair> pairs, double tolerance) {
  std::vector<std::uint32_t> takers;
  if (tolerance == 0)
    for (const auto& [i, j] : pairs) takers.insert(takers.end(), {i, j});
  else
    for (std::uint32_t i = 0; i < facets; ++i) takers.push_back(i);
  std::sort(takers.begin(), takers.end());
  takers.erase(std::unique(takers.begin(), takers.end()), takers.end());
  return takers;
}

/// Adds the points of a facet that lie inside a side. True if there are any that it did not have.
template <int D>
bool take_points(std::uint32_t u, std::uint32_t v, const Facet_loop& loop, Sides<D>& sides) {
  std::vector<std::uint32_t> offered(loop.begin(), loop.end());
  for (std::size_t i = 0; i < side_count<D>(loop); ++i) {
    const auto inside = sides.inside(loop[i], loop[(i + 1) % loop.size()]);
    offered.insert(offered.end(), inside.begin(), inside.end());
  }
  bool is_new = false;
  for (const std::uint32_t x : offered)
    if (x != u && x != v && sides.is_inside(u, v, x)) is_new |= sides.add(u, v, x);
  return is_new;
}

}  // namespace

template <int D>
void add_hanging_points(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                        std::span<const Facet_pair> pairs, double tolerance, Sides<D>& sides) {
  const std::vector<std::uint32_t> patch = patches(facets.size(), pairs),
                                   taking = takers(facets.size(), pairs, tolerance);
  Box_grid<D> grid;
  const Vector<D> margin = with_all_coordinates<D>(tolerance);
  const auto enlarged = [&](const Box<D>& box) { return Box<D>{box.low - margin, box.high + margin}; };
  for (std::uint32_t k = 0; k < taking.size(); ++k) grid.set(k, enlarged(facets[taking[k]].box));
  std::vector<std::vector<std::uint32_t>> near(taking.size());
  for (std::uint32_t k = 0; k < taking.size(); ++k) {
    const std::uint32_t i = taking[k];
    grid.find(facets[i].box, near[k]);
    for (std::uint32_t& other : near[k]) other = taking[other];
    std::erase_if(near[k], [&](std::uint32_t other) {
      return other == i || (tolerance == 0 && patch[other] != patch[i]);
    });
    std::sort(near[k].begin(), near[k].end());
  }
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (std::uint32_t k = 0; k < taking.size(); ++k) {
      const Facet_loop& loop = facets[taking[k]].loop;
      for (std::size_t side = 0; side < side_count<D>(loop); ++side) {
        const std::uint32_t u = loop[side], v = loop[(side + 1) % loop.size()];
        Box<D> box;
        box.extend(points[u]);
        box.extend(points[v]);
        box = enlarged(box);
        for (const std::uint32_t other : near[k])
          if (box.meets(facets[other].box) && take_points<D>(u, v, facets[other].loop, sides)) is_new = true;
      }
    }
  }
}

template void add_hanging_points<2>(std::span<const Point<2>>, std::span<const Lone_facet<2>>,
                                    std::span<const Facet_pair>, double, Sides<2>&);
template void add_hanging_points<3>(std::span<const Point<3>>, std::span<const Lone_facet<3>>,
                                    std::span<const Facet_pair>, double, Sides<3>&);

}  // namespace cellwalk::detail
