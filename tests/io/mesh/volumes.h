// SPDX-License-Identifier: LGPL-3.0-or-later
// What a reader of volumes must get right whatever the format: closed cells, and their volumes.
#ifndef CELLWALK_TESTS_IO_MESH_VOLUMES_H
#define CELLWALK_TESTS_IO_MESH_VOLUMES_H

#include <cellwalk/records/cell_soup.h>

#include <set>
#include <utility>
#include <vector>

namespace cellwalk::io {

/// Six times the volume of a cell, positive if its facets are counterclockwise seen from outside.
inline double six_volumes(const Cell_soup<3>& soup, std::size_t c) {
  double sum = 0;
  for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    const auto loop = soup.facet(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += dot(soup.points[loop[0]], cross(soup.points[loop[i]], soup.points[loop[i + 1]]));
  }
  return sum;
}

inline std::vector<double> six_volumes(const Cell_soup<3>& soup) {
  std::vector<double> v;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) v.push_back(six_volumes(soup, c));
  return v;
}

/// True if every edge of every cell is run through once in each direction.
inline bool all_closed(const Cell_soup<3>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      const auto loop = soup.facet(f);
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (!edges.insert({loop[i], loop[(i + 1) % loop.size()]}).second) return false;
    }
    for (const auto& [a, b] : edges)
      if (!edges.contains({b, a})) return false;
  }
  return true;
}

/// How many facets are the same in two cells, seen from opposite sides.
inline std::size_t shared_facets(const Cell_soup<3>& soup) {
  std::multiset<std::set<std::uint32_t>> facets;
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    facets.insert({soup.facet(f).begin(), soup.facet(f).end()});
  std::size_t shared = 0;
  for (auto it = facets.begin(); it != facets.end(); it = facets.upper_bound(*it))
    shared += facets.count(*it) == 2;
  return shared;
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_MESH_VOLUMES_H
