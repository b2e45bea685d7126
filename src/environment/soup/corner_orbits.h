// SPDX-License-Identifier: LGPL-3.0-or-later
// The orbits of corners (a corner is a cell at one of its vertices) that are joined through facets: the
// vertices of the map. A point of the soup with several orbits is pinched, and becomes several vertices.
#ifndef CELLWALK_ENVIRONMENT_SOUP_CORNER_ORBITS_H
#define CELLWALK_ENVIRONMENT_SOUP_CORNER_ORBITS_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// The darts of a soup, numbered in order: in 3D one for each entry of a facet loop, in 2D one for each
/// facet.
template <int D>
struct Soup_darts {
  const Cell_soup<D>& soup;

  std::size_t count() const { return D == 2 ? soup.facet_count() : soup.vertices.size(); }
  std::uint32_t first(std::size_t facet) const {
    return D == 2 ? static_cast<std::uint32_t>(facet) : soup.facet_begin[facet];
  }
  std::uint32_t begin_of_cell(std::size_t c) const { return first(soup.cell_begin[c]); }
  std::uint32_t end_of_cell(std::size_t c) const { return first(soup.cell_begin[c + 1]); }
  /// The point from which a dart starts.
  std::uint32_t origin(std::size_t dart) const { return soup.vertices[D == 2 ? 2 * dart : dart]; }
};

/// For each dart the lowest dart of its vertex orbit: equal exactly for darts that start from the same
/// vertex.
/// \pre gluing = glue(soup); 2D: the edges of each cell follow each other
/// Cost: nearly linear; parallel; the result does not depend on the number of threads.
template <int D>
std::vector<std::uint32_t> vertex_orbits(const Cell_soup<D>& soup, const Gluing& gluing);

extern template std::vector<std::uint32_t> vertex_orbits(const Cell_soup<2>&, const Gluing&);
extern template std::vector<std::uint32_t> vertex_orbits(const Cell_soup<3>&, const Gluing&);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SOUP_CORNER_ORBITS_H
