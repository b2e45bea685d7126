// SPDX-License-Identifier: GPL-3.0-or-later
// Connected triangles, and their sums.
#include "parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "edges.h"

namespace cellwalk::detail {
namespace {

const char* kind_of(Part part) { return part == Part::cap ? "cap" : part == Part::mouth ? "mouth" : "sheet"; }

/// Calls visit(edge, facet number) for each side of some facets.
template <class Visit>
void for_each_side(std::span<const Facet> facets, const Visit& visit) {
  for (std::uint32_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = facets[f].corners[k], b = facets[f].corners[(k + 1) % 3];
      visit(std::pair(std::min(a, b), std::max(a, b)), f);
    }
}

Repaired_part measure(const std::vector<Point<3>>& points, std::span<const Facet> facets) {
  Repaired_part part;
  part.facets = facets.size();
  Vector<3> sum{};
  double total = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for_each_side(facets, [&](const auto& edge, std::uint32_t) { ++uses[edge]; });
  for (const Facet& f : facets) {
    const Point<3>&p = points[f.corners[0]], &q = points[f.corners[1]], &r = points[f.corners[2]];
    const Vector<3> twice = cross(q - p, r - p);
    const double area = length(twice) / 2;
    sum = sum + 0.5 * twice;
    total += area;
    part.centre = part.centre + (area / 3) * (p + q + r);
  }
  part.centre = (1 / total) * part.centre;
  part.normal = normalized(sum, {0, 0, 1});
  part.area = total;
  part.width = 2 * std::sqrt(total / std::numbers::pi);
  for (const auto& [edge, count] : uses) {
    part.edges += count == 1;
    if (count == 1)
      part.off_plane = std::max(part.off_plane, std::abs(dot(points[edge.first] - part.centre, part.normal)));
  }
  return part;
}

}  // namespace

std::uint32_t number_connected(std::vector<Facet>& facets, Part part) {
  std::vector<Facet> chosen;
  for (const Facet& f : facets)
    if (f.part == part) chosen.push_back(f);
  Joined_sets sets(chosen.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
  for_each_side(chosen, [&](const auto& edge, std::uint32_t f) {
    sets.join(first.insert({edge, f}).first->second, f);
  });
  const auto number = sets.numbers();
  std::uint32_t i = 0, count = 0;
  for (Facet& f : facets)
    if (f.part == part) count = std::max(count, (f.number = number[i++]) + 1);
  return count;
}

std::pair<std::vector<Repaired_part>, Part_names> name_parts(const std::vector<Point<3>>& points,
                                                             std::span<const Facet> walls,
                                                             const std::vector<Repaired_part>& caps) {
  std::map<std::pair<Part, std::uint32_t>, std::vector<Facet>> members;
  for (const Facet& f : walls)
    if (f.part != Part::surface) members[{f.part, f.number}].push_back(f);
  std::vector<std::pair<std::pair<Part, std::uint32_t>, Repaired_part>> found;
  for (const auto& [key, facets] : members) {
    Repaired_part part = measure(points, facets);
    if (key.first == Part::cap) {  // of the whole cap, not only of what the walls have of it
      const Vector<3> normal = part.normal;
      const std::size_t count = part.facets;
      part = caps[key.second];
      part.facets = count;
      if (dot(part.normal, normal) < 0) part.normal = -1 * part.normal;
    }
    found.push_back({key, std::move(part)});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.first.first != b.first.first ? a.first.first < b.first.first : a.second.area > b.second.area;
  });
  std::vector<Repaired_part> parts;
  Part_names names;
  std::map<Part, int> count;
  for (auto& [key, part] : found) {
    part.name = fmt::format("{}_{}", kind_of(key.first), ++count[key.first]);
    names[key] = part.name;
    parts.push_back(std::move(part));
  }
  return {std::move(parts), std::move(names)};
}

}  // namespace cellwalk::detail
