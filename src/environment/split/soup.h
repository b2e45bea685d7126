// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells of a soup as arguments of check_cell(). Internal to splitting.
#ifndef CELLWALK_ENVIRONMENT_SPLIT_SOUP_H
#define CELLWALK_ENVIRONMENT_SPLIT_SOUP_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::detail {

/// Names a cell: "cell 12".
inline std::string cell_name(std::size_t c) { return "cell " + std::to_string(c); }

/// True if a cell is a tetrahedron (2D: a triangle) without vertices inside its edges.
template <int D>
bool is_simplex(const Cell_soup<D>& soup, std::size_t c) {
  if (soup.cell_begin[c + 1] - soup.cell_begin[c] != D + 1) return false;
  for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
    if (soup.facet(f).size() != D) return false;
  return true;
}

/// The result of check_cell for every cell of a soup. Parallel.
/// \throw Error(input) if a vertex index is out of range or a cell has more vertices than its shape can
///        number
template <int D>
std::vector<Cell_check> check_soup(const Cell_soup<D>& soup);

/// Refuses the lowest cell with a defect that no split can repair.
/// \throw Error(not_certified), or Error(input) if a coordinate is not finite
void refuse_hopeless(const std::vector<Cell_check>& checks);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SPLIT_SOUP_H
