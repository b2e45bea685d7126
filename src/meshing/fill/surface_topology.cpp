// SPDX-License-Identifier: GPL-3.0-or-later
// Points merged, unused ones dropped, and facets of each edge tested and oriented.
#include "surface_topology.h"

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>

namespace cellwalk::detail {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(Error_code::input, name + " " + what);
}

std::string counted(std::size_t n, const std::string& thing) {
  return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

/// The use of an edge by a facet.
struct Edge_use {
  std::uint32_t low, high;  ///< its points
  std::uint32_t facet;
  std::uint32_t corner;  ///< the edge runs from this corner of the facet to the next
  bool forward;          ///< from low to high

  bool same_edge(const Edge_use& other) const { return low == other.low && high == other.high; }
};

std::vector<Edge_use> sorted_edge_uses(const Surface_soup& soup) {
  std::vector<Edge_use> uses;
  for (std::uint32_t f = 0; f < soup.facets.size(); ++f) {
    const auto& loop = soup.facets[f];
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      uses.push_back({std::min(a, b), std::max(a, b), f, i, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Edge_use& a, const Edge_use& b) {
    return std::tie(a.low, a.high, a.facet, a.corner) < std::tie(b.low, b.high, b.facet, b.corner);
  });
  return uses;
}

/// Refuses edges that are not shared by exactly two facets.
void check_edges(const Traced_surface& surface, const std::vector<Edge_use>& uses, const std::string& name) {
  std::size_t open = 0, crowded = 0;
  std::optional<Edge_use> first_open, first_crowded;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    for (j = i; j < uses.size() && uses[j].same_edge(uses[i]);) ++j;
    if (j - i == 1 && open++ == 0) first_open = uses[i];
    if (j - i > 2 && crowded++ == 0) first_crowded = uses[i];
  }
  const auto between = [&](const Edge_use& edge) {
    return "between vertices " + std::to_string(surface.input_point[edge.low]) + " and " +
           std::to_string(surface.input_point[edge.high]);
  };
  if (open > 0)
    refuse(name, "is open: " + counted(open, "boundary edge") + ", the first " + between(*first_open) +
                     "; close its holes so that it bounds a volume");
  if (crowded > 0)
    refuse(name, "is not manifold: more than two facets meet at " + counted(crowded, "edge") +
                     ", the first " + between(*first_crowded) + "; separate the sheets that meet there");
}

/// Refuses repeated facets, which bound nothing.
void check_repeated_facets(const Traced_surface& surface, const std::string& name) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> facets;
  for (std::uint32_t f = 0; f < surface.soup.facets.size(); ++f) {
    auto points = surface.soup.facets[f];
    std::sort(points.begin(), points.end());
    const auto [it, is_new] = facets.insert({std::move(points), f});
    if (!is_new)
      refuse(name, "has a facet twice: facets " + std::to_string(surface.input_facet[it->second]) + " and " +
                       std::to_string(surface.input_facet[f]) +
                       " have the same vertices; remove one or both");
  }
}

void check_degenerate_facets(const Traced_surface& surface, const std::string& name) {
  std::size_t degenerate = 0;
  std::uint32_t first = 0;
  for (std::uint32_t f = 0; f < surface.soup.facets.size(); ++f) {
    const auto& loop = surface.soup.facets[f];
    const auto& points = surface.soup.points;
    bool flat = true;
    for (std::size_t i = 2; i < loop.size() && flat; ++i)
      flat = is_on_one_line(points[loop[0]], points[loop[1]], points[loop[i]]);
    if (flat && degenerate++ == 0) first = f;
  }
  if (degenerate > 0)
    refuse(name, "has " + counted(degenerate, "degenerate facet") + ", the first facet " +
                     std::to_string(surface.input_facet[first]) +
                     ": its vertices lie on one line; collapse its shortest edge or flip its longest");
}

/// Reverses facets so that every edge runs in opposite directions in its two facets: of each component the
/// smaller part.
void orient(Traced_surface& surface, const std::vector<Edge_use>& uses, const std::string& name,
            Surface_report& report) {
  const std::size_t facets = surface.soup.facets.size();
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> neighbours(
      facets);  // the facet, and whether they agree
  for (std::size_t i = 0; i < uses.size(); i += 2) {
    const bool agree = uses[i].forward != uses[i + 1].forward;
    neighbours[uses[i].facet].push_back({uses[i + 1].facet, agree});
    neighbours[uses[i + 1].facet].push_back({uses[i].facet, agree});
  }
  constexpr std::uint8_t unseen = 0, kept = 1, turned = 2;
  std::vector<std::uint8_t> state(facets, unseen);
  for (std::uint32_t seed = 0; seed < facets; ++seed) {
    if (state[seed] != unseen) continue;
    ++report.components;
    std::vector<std::uint32_t> component{seed};
    state[seed] = kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t f = component[i];
      count += state[f] == turned;
      for (const auto& [g, agree] : neighbours[f]) {
        const std::uint8_t wanted = agree == (state[f] == kept) ? kept : turned;
        if (state[g] == unseen) {
          state[g] = wanted;
          component.push_back(g);
        } else if (state[g] != wanted) {
          refuse(name, "is not orientable: facets " + std::to_string(surface.input_facet[f]) + " and " +
                           std::to_string(surface.input_facet[g]) +
                           " close a one-sided band; it bounds no volume, so remove or rebuild that part");
        }
      }
    }
    const std::uint8_t minority = 2 * count > component.size() ? kept : turned;
    for (std::uint32_t f : component)
      if (state[f] == minority) {
        std::reverse(surface.soup.facets[f].begin(), surface.soup.facets[f].end());
        ++report.turned_facets;
      }
  }
}

/// Refuses vertices at which several fans of facets meet.
void check_vertices(const Traced_surface& surface, const std::vector<Edge_use>& uses,
                    const std::string& name) {
  const auto& facets = surface.soup.facets;
  std::vector<std::uint32_t> first_corner(facets.size() + 1, 0);
  for (std::size_t f = 0; f < facets.size(); ++f)
    first_corner[f + 1] = first_corner[f] + static_cast<std::uint32_t>(facets[f].size());
  std::vector<std::uint32_t> root(first_corner.back());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&root](std::uint32_t c) {
    while (root[c] != c) c = root[c] = root[root[c]];
    return c;
  };
  // The facets of an edge are neighbours around both of its points.
  const auto corner_at = [&](const Edge_use& use, std::uint32_t point) {
    const auto& loop = facets[use.facet];
    const bool here = (use.forward ? use.low : use.high) == point;
    return first_corner[use.facet] +
           (here ? use.corner : (use.corner + 1) % static_cast<std::uint32_t>(loop.size()));
  };
  for (std::size_t i = 0; i < uses.size(); i += 2)
    for (std::uint32_t point : {uses[i].low, uses[i].high})
      root[find(corner_at(uses[i], point))] = find(corner_at(uses[i + 1], point));
  std::vector<std::uint32_t> fans(surface.soup.points.size(), 0);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::uint32_t i = 0; i < facets[f].size(); ++i)
      if (find(first_corner[f] + i) == first_corner[f] + i) ++fans[facets[f][i]];
  std::size_t pinched = 0;
  std::uint32_t first = 0;
  for (std::uint32_t v = 0; v < fans.size(); ++v)
    if (fans[v] > 1 && pinched++ == 0) first = v;
  if (pinched > 0)
    refuse(name, "is not manifold: separate sheets meet at " +
                     (pinched == 1 ? "1 vertex" : std::to_string(pinched) + " vertices") +
                     ", the first vertex " + std::to_string(surface.input_point[first]) +
                     "; pull the sheets apart there");
}

/// The new number of each point; points of equal coordinates get the same one. Numbers are in the order of
/// the first point at each position.
std::vector<std::uint32_t> merged_numbers(const std::vector<Point<3>>& points) {
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && points[order[i - 1]] == points[order[i]] ? first[order[i - 1]] : order[i];
  return first;
}

}  // namespace

bool is_on_one_line(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  Predicate_counts counts;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (Exact::orientation(counts, Point<2>{a[i], a[j]}, Point<2>{b[i], b[j]}, Point<2>{c[i], c[j]}) != 0)
      return false;
  }
  return true;
}

Traced_surface clean(const Surface_soup& soup, const std::string& name, Surface_report& report) {
  report.points_read = soup.points.size();
  report.facets_read = soup.facets.size();
  if (soup.facets.empty()) refuse(name, "is empty: it has no facets; give a closed surface");
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (!is_finite(soup.points[v]))
      refuse(name, "has a vertex that is not finite: vertex " + std::to_string(v));
  const auto first = merged_numbers(soup.points);
  for (std::size_t v = 0; v < first.size(); ++v) report.merged_points += first[v] != v;

  Traced_surface surface;
  for (std::uint32_t f = 0; f < soup.facets.size(); ++f) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t v : soup.facets[f]) {
      if (v >= soup.points.size())
        refuse(name, "is malformed: facet " + std::to_string(f) + " names vertex " + std::to_string(v) +
                         " of " + std::to_string(soup.points.size()));
      if (loop.empty() || loop.back() != first[v]) loop.push_back(first[v]);
    }
    if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    if (loop.size() < 3) {
      ++report.collapsed_facets;
      continue;
    }
    auto sorted = loop;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      refuse(name, "is malformed: facet " + std::to_string(f) + " passes vertex " + std::to_string(*twice) +
                       " twice; cut it into simple polygons");
    surface.soup.facets.push_back(std::move(loop));
    surface.input_facet.push_back(f);
  }
  if (surface.soup.facets.empty()) refuse(name, "is empty: every facet collapses to a point or an edge");
  std::vector<std::uint32_t> number(soup.points.size(), none);
  for (const auto& loop : surface.soup.facets)
    for (std::uint32_t v : loop) number[v] = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v)
    if (number[v] != none) {
      number[v] = static_cast<std::uint32_t>(surface.soup.points.size());
      surface.soup.points.push_back(soup.points[v]);
      surface.input_point.push_back(v);
    }
  for (auto& loop : surface.soup.facets)
    for (std::uint32_t& v : loop) v = number[v];
  report.unused_points = report.points_read - report.merged_points - surface.soup.points.size();
  return surface;
}

void make_oriented_manifold(Traced_surface& surface, const std::string& name, Surface_report& report) {
  const auto uses = sorted_edge_uses(surface.soup);
  check_edges(surface, uses, name);
  check_repeated_facets(surface, name);
  check_degenerate_facets(surface, name);
  check_vertices(surface, uses, name);
  orient(surface, uses, name, report);
}

}  // namespace cellwalk::detail
