// SPDX-License-Identifier: LGPL-3.0-or-later
// The same geometry listed in another order.
#ifndef CELLWALK_TESTS_EDGE_RELISTED_H
#define CELLWALK_TESTS_EDGE_RELISTED_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace cellwalk::test {

inline std::vector<std::uint32_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order;
}

template <int D>
struct Relisted {
  Cell_soup<D> soup;
  std::vector<std::uint32_t> new_cell, new_point;  ///< of each old one
};

/// Points, cells and facets in another order; loops start elsewhere (2D: those of cells).
/// \param keeps_points points stay in their order
template <int D>
Relisted<D> relisted(const Cell_soup<D>& soup, std::uint64_t seed, bool keeps_points = false) {
  Random random(seed);
  Relisted<D> result;
  auto points = shuffled(soup.points.size(), random);
  const auto cells = shuffled(soup.cell_count(), random);
  if (keeps_points) std::iota(points.begin(), points.end(), 0);
  std::vector<std::uint32_t>& new_point = result.new_point;
  new_point.resize(points.size());
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    result.soup.points.push_back(soup.points[points[k]]);
    new_point[points[k]] = k;
  }
  result.new_cell.resize(cells.size());
  for (std::uint32_t k = 0; k < cells.size(); ++k) {
    const std::uint32_t c = cells[k];
    result.new_cell[c] = k;
    std::vector<std::uint32_t> facets = shuffled(soup.cell_begin[c + 1] - soup.cell_begin[c], random);
    if (D == 2) {  // where they have an order
      const std::uint32_t start = facets[0];
      std::iota(facets.begin(), facets.end(), 0);
      std::rotate(facets.begin(), facets.begin() + start, facets.end());
    }
    for (const std::uint32_t i : facets) {
      const auto loop = soup.facet(soup.cell_begin[c] + i);
      const std::size_t first = D == 2 ? 0 : random.below(loop.size());
      std::vector<std::uint32_t> turned;
      for (std::size_t j = 0; j < loop.size(); ++j)
        turned.push_back(new_point[loop[(first + j) % loop.size()]]);
      result.soup.add_facet(turned, soup.impassable[soup.cell_begin[c] + i] != 0);
    }
    result.soup.end_cell(soup.solid[c] != 0);
  }
  return result;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_RELISTED_H
