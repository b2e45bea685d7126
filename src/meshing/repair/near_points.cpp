// SPDX-License-Identifier: GPL-3.0-or-later
// A grid of points whose cells are as wide as the distance searched.
#include "near_points.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "edges.h"
#include "tidy.h"

namespace cellwalk::detail {
namespace {

struct Grid_hash {
  std::size_t operator()(const std::array<std::int64_t, 3>& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t x : cell) {
      h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 31;
    }
    return h;
  }
};

/// Calls visit(a, b) for each pair of points, a < b, nearer than the distance.
template <class Visit>
void for_near_pairs(const std::vector<Point<3>>& points, const std::vector<std::uint32_t>& some,
                    double distance, const Visit& visit) {
  std::unordered_map<std::array<std::int64_t, 3>, std::vector<std::uint32_t>, Grid_hash> grid;
  const auto cell_of = [&](const Point<3>& p) {
    std::array<std::int64_t, 3> cell;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double largest = 0x1p62;
      cell[k] = static_cast<std::int64_t>(std::clamp(std::floor(p[k] / distance), -largest, largest));
    }
    return cell;
  };
  for (const std::uint32_t v : some) {  // ascending
    const auto cell = cell_of(points[v]);
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto at = grid.find({cell[0] + i, cell[1] + j, cell[2] + k});
          if (at == grid.end()) continue;
          for (const std::uint32_t w : at->second)
            if (length(points[v] - points[w]) < distance) visit(w, v);
        }
    grid[cell].push_back(v);
  }
}

/// Joins the points of each set, and lists those that moved.
Found join(Facets& surface, Joined_sets& sets) {
  Found moved;
  std::vector<std::uint32_t> target(surface.points.size());
  for (std::uint32_t v = 0; v < target.size(); ++v) {
    target[v] = sets.find(v);
    if (target[v] != v)
      moved.add(surface.points[target[v]],
                length(surface.points[v] - surface.points[target[v]]) / surface.size);
  }
  if (moved.count != 0) join_points(surface, target);
  return moved;
}

std::vector<std::uint32_t> used_points(const Facets& surface) {
  std::vector<std::uint32_t> used;
  for (const Facet& f : surface.facets) used.insert(used.end(), f.corners.begin(), f.corners.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

}  // namespace

Found join_seams(Facets& surface, double distance) {
  if (!(distance > 0)) return {};
  const auto uses = edge_uses(surface.facets);
  std::vector<std::uint32_t> border;
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() % 2 == 1) border.insert(border.end(), {edge[0].low, edge[0].high});
  });
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  Joined_sets sets(surface.points.size());
  for_near_pairs(surface.points, border, distance, [&](std::uint32_t a, std::uint32_t b) {
    const auto at = std::partition_point(uses.begin(), uses.end(), [&](const Edge_use& use) {
      return std::pair(use.low, use.high) < std::pair(a, b);
    });
    const bool is_edge = at != uses.end() && at->low == a && at->high == b;
    if (!is_edge) sets.join(a, b);
  });
  return join(surface, sets);
}

Found weld(Facets& surface, double distance, bool also_given) {
  if (!(distance > 0)) return {};
  Joined_sets sets(surface.points.size());
  for_near_pairs(surface.points, used_points(surface), distance, [&](std::uint32_t a, std::uint32_t b) {
    // Through a made point, two of the file shall not become one.
    if (!also_given && (b < surface.given_points ||
                        (sets.find(a) < surface.given_points && sets.find(b) < surface.given_points)))
      return;
    sets.join(a, b);
  });
  return join(surface, sets);
}

}  // namespace cellwalk::detail
