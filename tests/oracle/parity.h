// SPDX-License-Identifier: LGPL-3.0-or-later
// Inside or outside a closed triangulated surface, by counting crossings exactly. Knows nothing of cells.
#ifndef CELLWALK_TESTS_ORACLE_PARITY_H
#define CELLWALK_TESTS_ORACLE_PARITY_H

#include <cellwalk/records/surface_soup.h>

namespace cellwalk::oracle {

/// True if a segment from p to a point outside the surface's box crosses the surface an odd number of times.
/// Segments that touch an edge or a vertex are replaced by others.
/// \pre the facets are triangles and close up; p does not lie on the surface
/// \throw std::runtime_error if p seems to lie on the surface
bool is_inside(const Surface_soup& surface, const Point<3>& p);

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_PARITY_H
