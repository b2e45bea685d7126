// SPDX-License-Identifier: GPL-3.0-or-later
// Points and sides found by their boxes.
#include "sides.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "edges.h"

namespace cellwalk::detail {
namespace {

/// Each pass halves the sides with points on them, at least where the points are spread evenly.
constexpr int most_passes = 40;

struct Split {
  std::uint32_t point;
  double off_middle, distance;
};
using Splits = std::map<Side, Split>;

class Search {
 public:
  Search(const Facets& surface, double within, const std::vector<std::uint32_t>& component)
      : points_(surface.points), within_(within), component_(component) {}

  Splits run(const std::vector<Side>& sides, const std::vector<std::uint32_t>& points) const {
    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Box> of_sides, of_points;
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
      const auto [a, b] = sides[i];
      const CGAL::Bbox_3 box = to_cgal(points_[a]).bbox() + to_cgal(points_[b]).bbox();
      of_sides.emplace_back(CGAL::Bbox_3(box.xmin() - within_, box.ymin() - within_, box.zmin() - within_,
                                         box.xmax() + within_, box.ymax() + within_, box.zmax() + within_),
                            i);
    }
    for (const std::uint32_t v : points) of_points.emplace_back(to_cgal(points_[v]).bbox(), v);
    Splits splits;
    CGAL::box_intersection_d(
        of_sides.begin(), of_sides.end(), of_points.begin(), of_points.end(),
        [&](const Box& side, const Box& point) { look(sides[side.info()], point.info(), splits); });
    return splits;
  }

 private:
  void look(const Side& side, std::uint32_t v, Splits& splits) const {
    const auto [a, b] = side;
    if (v == a || v == b || (!component_.empty() && component_[v] != component_[a])) return;
    const Vector<3> along = points_[b] - points_[a], to = points_[v] - points_[a];
    const double whole = length(along), part = dot(along, to) / whole;
    if (!(part > within_ && part < whole - within_)) return;
    const double distance = length(cross(along, to)) / whole;
    if (distance > within_) return;
    const Split split{v, std::abs(part - whole / 2), distance};
    const auto [at, is_new] = splits.insert({side, split});
    Split& best = at->second;
    if (!is_new && std::pair(split.off_middle, v) < std::pair(best.off_middle, best.point)) best = split;
  }

  const std::vector<Point<3>>& points_;
  double within_;
  const std::vector<std::uint32_t>& component_;
};

/// Appends a facet, split at its sides. The sides between its parts are not: they are for the next pass.
void append(const Facet& facet, const Splits& splits, std::vector<Facet>& result) {
  const Triangle& t = facet.corners;
  std::array<const Split*, 3> split{};
  for (int k = 0; k < 3; ++k) {
    const auto at = splits.find(std::minmax({t[k], t[(k + 1) % 3]}));
    if (at == splits.end()) continue;
    if (at->second.point == t[(k + 2) % 3]) return;
    split[k] = &at->second;
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) result.push_back({{a, b, c}, facet.part, facet.number});
  };
  // Corners between two such sides are cut off; what remains is a fan from the first of the points.
  std::vector<std::uint32_t> rest;
  std::size_t first = 0;
  for (int k = 0; k < 3; ++k) {
    const Split *before = split[(k + 2) % 3], *after = split[k];
    if (before != nullptr && after != nullptr)
      add(before->point, t[k], after->point);
    else
      rest.push_back(t[k]);
    if (after == nullptr) continue;
    if (first == 0) first = rest.size() + 1;
    rest.push_back(after->point);
  }
  std::rotate(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(first, 1) - 1),
              rest.end());
  for (std::size_t i = 2; i < rest.size(); ++i) add(rest[0], rest[i - 1], rest[i]);
}

}  // namespace

Found split_sides(Facets& surface, const std::vector<Side>& sides, const std::vector<std::uint32_t>& points,
                  double within, const std::vector<std::uint32_t>& component) {
  const Splits splits = Search(surface, within, component).run(sides, points);
  Found found;
  for (const auto& [side, split] : splits) found.add(surface.points[split.point], split.distance);
  if (splits.empty()) return found;
  std::vector<Facet> result;
  for (const Facet& facet : surface.facets) append(facet, splits, result);
  surface.facets = std::move(result);
  return found;
}

Found split_uneven_sides(Facets& surface, double seam, double within) {
  Found found;
  Joined_sets sets(surface.points.size());
  for (const Facet& f : surface.facets)
    sets.join(f.corners[0], f.corners[1]), sets.join(f.corners[0], f.corners[2]);
  const std::vector<std::uint32_t> component = sets.numbers();
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<Side> border, uneven;
    std::vector<std::uint32_t> ends;
    const auto uses = edge_uses(surface.facets);
    for_each_edge(uses, [&](std::span<const Edge_use> edge) {
      const bool is_even = edge.size() == 2 && edge[0].forward != edge[1].forward;
      if (is_even) return;
      (edge.size() == 1 ? border : uneven).push_back({edge[0].low, edge[0].high});
      ends.insert(ends.end(), {edge[0].low, edge[0].high});
    });
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    Found now = split_sides(surface, border, ends, std::max(seam, within), component);
    if (now.count == 0) now = split_sides(surface, uneven, ends, within, component);
    if (now.count == 0) break;
    found.add(now);
  }
  found.measured /= surface.size;
  return found;
}

}  // namespace cellwalk::detail
