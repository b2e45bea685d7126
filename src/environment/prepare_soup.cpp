// SPDX-License-Identifier: LGPL-3.0-or-later
// Points merged by coordinates, cells turned by their volume, and walls marked on both sides.
#include "prepare_soup.h"

#include <cellwalk/kernel/error.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "environment/soup/describe_place.h"
#include "environment/soup/parallel.h"

namespace cellwalk {
namespace {

/// Points that some cell uses, in order. \throw Error(input) if one of them is not finite
template <int D>
std::vector<std::uint32_t> used_points(const Cell_soup<D>& soup) {
  std::vector<std::uint8_t> is_used(soup.points.size(), 0);
  for (const std::uint32_t v : soup.vertices) is_used[v] = 1;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    if (!is_finite(soup.points[v]))
      throw Error(Error_code::input,
                  "point " + std::to_string(v) + " is not finite: correct its coordinates");
    used.push_back(v);
  }
  return used;
}

/// Pairs (point, lowest point at the same position) for points of equal coordinates, sorted.
template <int D>
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_duplicates(const std::vector<Point<D>>& points,
                                                                     std::vector<std::uint32_t> used) {
  tbb::parallel_sort(used.begin(), used.end(), [&](std::uint32_t u, std::uint32_t v) {
    return points[u] != points[v] ? points[u] < points[v] : u < v;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> duplicates;
  for (std::size_t i = 1, first = 0; i < used.size(); ++i) {
    if (points[used[i]] != points[used[first]])
      first = i;
    else
      duplicates.emplace_back(used[i], used[first]);
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

double signed_volume(const Cell_soup<2>& soup, std::size_t c) {
  double sum = 0;
  const Point<2>& o = soup.points[soup.facet(soup.cell_begin[c])[0]];
  for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    const Vector<2> a = soup.points[soup.facet(f)[0]] - o, b = soup.points[soup.facet(f)[1]] - o;
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

double signed_volume(const Cell_soup<3>& soup, std::size_t c) {
  double sum = 0;
  const Point<3>& o = soup.points[soup.facet(soup.cell_begin[c])[0]];
  for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    const auto loop = soup.facet(f);
    const Vector<3> a = soup.points[loop[0]] - o;
    for (std::size_t i = 2; i < loop.size(); ++i)
      sum += dot(a, cross(soup.points[loop[i - 1]] - o, soup.points[loop[i]] - o));
  }
  return sum;
}

/// Reverses every loop, and in 2D the order of the edges too.
template <int D>
void flip(Cell_soup<D>& soup) {
  for_each_parallel(soup.facet_count(), [&](std::size_t f) {
    std::reverse(soup.vertices.begin() + soup.facet_begin[f],
                 soup.vertices.begin() + soup.facet_begin[f + 1]);
  });
  if constexpr (D == 2)
    for_each_parallel(soup.cell_count(), [&](std::size_t c) {
      const std::uint32_t begin = soup.cell_begin[c], end = soup.cell_begin[c + 1];
      std::reverse(soup.impassable.begin() + begin, soup.impassable.begin() + end);
      for (std::uint32_t f = begin, g = end; f + 1 < g; ++f) {
        --g;
        std::swap_ranges(soup.vertices.begin() + 2 * f, soup.vertices.begin() + 2 * f + 2,
                         soup.vertices.begin() + 2 * g);
      }
    });
}

}  // namespace

template <int D>
void clean_points(Cell_soup<D>& soup, Duplicate_vertices duplicates, Build_report& report) {
  const std::vector<std::uint32_t> used = used_points(soup);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> equal;
  if (duplicates != Duplicate_vertices::keep) equal = find_duplicates<D>(soup.points, used);
  if (!equal.empty() && duplicates == Duplicate_vertices::refuse)
    throw Error(Error_code::not_certified, "points " + std::to_string(equal[0].second) + " and " +
                                               std::to_string(equal[0].first) + " lie in the same place " +
                                               detail::describe_place(soup.points[equal[0].first]) +
                                               ": merge them, or keep duplicate vertices");
  report.unused_points = soup.points.size() - used.size();
  report.merged_points = equal.size();
  if (report.unused_points == 0 && equal.empty()) return;

  std::vector<std::uint32_t> new_index(soup.points.size(), no_facet);
  for (const auto& [point, lowest] : equal) new_index[point] = lowest;
  std::uint32_t next = 0;
  for (const std::uint32_t v : used) {
    if (new_index[v] != no_facet) {
      new_index[v] = new_index[new_index[v]];
      continue;
    }
    soup.points[next] = soup.points[v];
    new_index[v] = next++;
  }
  soup.points.resize(next);
  for (std::uint32_t& v : soup.vertices) v = new_index[v];
}

template <int D>
bool flip_if_inverted(Cell_soup<D>& soup) {
  std::atomic<bool> all_negative = true;
  for_each_parallel(soup.cell_count(), [&](std::size_t c) {
    const bool has_facets = soup.cell_begin[c] != soup.cell_begin[c + 1];
    if (all_negative && !(has_facets && signed_volume(soup, c) < 0)) all_negative = false;
  });
  if (all_negative) flip(soup);
  return all_negative;
}

template <int D>
void mark_walls(Cell_soup<D>& soup, const Gluing& gluing) {
  std::vector<std::uint8_t> is_solid(soup.facet_count());
  for_each_parallel(soup.cell_count(), [&](std::size_t c) {
    std::fill(is_solid.begin() + soup.cell_begin[c], is_solid.begin() + soup.cell_begin[c + 1],
              soup.solid[c] != 0);
  });
  for_each_parallel(soup.facet_count(), [&](std::size_t f) {
    const std::uint32_t g = gluing.opposite[f];
    if (g == no_facet) {
      soup.impassable[f] = 1;
    } else if (f < g) {
      const bool wall = soup.impassable[f] || soup.impassable[g] || is_solid[f] != is_solid[g];
      soup.impassable[f] = soup.impassable[g] = wall;
    }
  });
}

template void clean_points(Cell_soup<2>&, Duplicate_vertices, Build_report&);
template void clean_points(Cell_soup<3>&, Duplicate_vertices, Build_report&);
template bool flip_if_inverted(Cell_soup<2>&);
template bool flip_if_inverted(Cell_soup<3>&);
template void mark_walls(Cell_soup<2>&, const Gluing&);
template void mark_walls(Cell_soup<3>&, const Gluing&);

}  // namespace cellwalk
