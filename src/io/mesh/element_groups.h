// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: groups of elements as groups of the cells and facets of a soup.
#ifndef CELLWALK_IO_MESH_ELEMENT_GROUPS_H
#define CELLWALK_IO_MESH_ELEMENT_GROUPS_H

#include <string>

#include "element_soup.h"

namespace cellwalk::io {

/// A name as a group may have it: without quotes and control characters, and not empty.
std::string group_name(std::string name);

/// The groups of the elements. A polygon (in 2D, a line) of a group stands for the facets with its corners.
/// The report gets a note for each group of which members are left out: those that are no facets of cells,
/// and elements of lower dimension.
template <int D>
Soup_groups groups_of_cells(const Cell_soup<D>& cells, const Element_soup& elements, Read_report& report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_GROUPS_H
