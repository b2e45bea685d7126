// SPDX-License-Identifier: LGPL-3.0-or-later
// Plain counts of a soup, by sets and floods that share nothing with the library, and CGAL's counts of a map.
#ifndef CELLWALK_TESTS_ENVIRONMENT_MAP_CHECKS_H
#define CELLWALK_TESTS_ENVIRONMENT_MAP_CHECKS_H

#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace cellwalk::test {

/// Cells of each dimension, those of dimension < D - 1 counted once for each set of cells joined through
/// facets.
template <int D>
struct Expected_counts {
  std::size_t cells = 0, facets = 0, boundary_facets = 0, vertices = 0, edges = 0, pinched = 0;
};

/// How many classes the cells around a feature fall into, where two cells are joined by a facet that has the
/// feature.
template <int D>
std::size_t parts(const Cell_soup<D>& soup,
                  const std::map<std::set<std::uint32_t>, std::vector<std::size_t>>& sides,
                  const std::set<std::uint32_t>& feature) {
  std::map<std::size_t, std::size_t> leader;
  const auto has = [&](const std::set<std::uint32_t>& all) {
    return std::includes(all.begin(), all.end(), feature.begin(), feature.end());
  };
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      if (has({soup.facet(f).begin(), soup.facet(f).end()})) leader.emplace(c, c);
  for (const auto& [vertices, cells] : sides) {
    if (cells.size() != 2 || !has(vertices)) continue;
    const std::size_t from = leader.at(cells[0]), to = leader.at(cells[1]);
    for (auto& entry : leader)
      if (entry.second == from) entry.second = to;
  }
  std::set<std::size_t> classes;
  for (const auto& entry : leader) classes.insert(entry.second);
  return classes.size();
}

/// \pre no cell is pinched in itself
template <int D>
Expected_counts<D> count_by_sets(const Cell_soup<D>& soup) {
  Expected_counts<D> counts;
  std::map<std::set<std::uint32_t>, std::vector<std::size_t>> sides;
  std::set<std::set<std::uint32_t>> vertices, edges;
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      const auto loop = soup.facet(f);
      sides[{loop.begin(), loop.end()}].push_back(c);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        vertices.insert({loop[i]});
        edges.insert({loop[i], loop[(i + 1) % loop.size()]});
      }
    }
  counts.cells = soup.cell_count();
  counts.facets = sides.size();
  for (const auto& side : sides) counts.boundary_facets += side.second.size() == 1;
  for (const auto& vertex : vertices) {
    const std::size_t n = parts(soup, sides, vertex);
    counts.vertices += n;
    counts.pinched += n > 1;
  }
  for (const auto& edge : edges) counts.edges += D == 2 ? 1 : parts(soup, sides, edge);
  return counts;
}

/// The map is valid by CGAL's check and the library's, and has the cells of the soup.
template <int D>
void expect_map_of(Map_storage<D>& storage, const Cell_soup<D>& soup) {
  const Expected_counts<D> expected = count_by_sets(soup);
  EXPECT_TRUE(storage.map.is_valid());
  std::vector<unsigned int> dimensions;
  for (unsigned int i = 0; i <= D; ++i) dimensions.push_back(i);
  const std::vector<unsigned int> counted = storage.map.count_cells(dimensions);
  EXPECT_EQ(counted[0], expected.vertices);
  EXPECT_EQ(counted[1], expected.edges);
  EXPECT_EQ(counted[D - 1], expected.facets);
  EXPECT_EQ(counted[D], expected.cells);
  const std::size_t darts = D == 2 ? soup.facet_count() : soup.vertices.size();
  EXPECT_EQ(check_map(storage), (Map_counts{expected.cells, expected.facets, expected.boundary_facets,
                                            expected.vertices, darts}));
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_MAP_CHECKS_H
