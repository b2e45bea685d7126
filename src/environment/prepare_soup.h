// SPDX-License-Identifier: LGPL-3.0-or-later
// The preparation of a soup before its cells are checked: unused and duplicate points, inverted meshes,
// marks.
#ifndef CELLWALK_ENVIRONMENT_PREPARE_SOUP_H
#define CELLWALK_ENVIRONMENT_PREPARE_SOUP_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>

namespace cellwalk {

/// Drops points that no cell uses, and merges or refuses those of equal coordinates; counts both in the
/// report.
/// \pre check_soup(soup)
/// \throw Error(input) if a point in use is not finite
/// \throw Error(not_certified) for duplicates that are refused, naming the points by their input indices
template <int D>
void clean_points(Cell_soup<D>& soup, Duplicate_vertices duplicates, Build_report& report);

/// Inverts all cells if each of them has a negative (rounded) volume, and returns whether it did so. This
/// only guesses the convention of the file: certification decides about orientation, exactly.
template <int D>
bool flip_if_inverted(Cell_soup<D>& soup);

/// Marks as impassable both sides of each facet that is a wall: marked on either side, on the boundary, or
/// between a solid and a free cell.
template <int D>
void mark_walls(Cell_soup<D>& soup, const Gluing& gluing);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_PREPARE_SOUP_H
