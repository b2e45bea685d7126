// SPDX-License-Identifier: LGPL-3.0-or-later
// Points in the same place, or nearly so, as one. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_JOINING_H
#define CELLWALK_ENVIRONMENT_REFINE_JOINING_H

#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/records/cell_soup.h>

#include <span>

#include "lone_facets.h"

namespace cellwalk::detail {

/// The same cells, in which all vertices in one place have the lowest index of a point there.
template <int D>
Cell_soup<D> united(const Cell_soup<D>& soup);

/// Replaces corners of facets by those of other ones within the tolerance that have the lowest index, in all
/// cells. False if there are none.
/// \throw Error(not_certified) if two corners of a cell would become one
template <int D>
bool join_corners(Cell_soup<D>& cells, std::span<const Lone_facet<D>> facets, double tolerance,
                  Refinement& done);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_JOINING_H
