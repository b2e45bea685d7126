// SPDX-License-Identifier: LGPL-3.0-or-later
// Parts of an environment: the facets and cells that lie somewhere, or have a name.
#ifndef CELLWALK_ENVIRONMENT_SELECTION_H
#define CELLWALK_ENVIRONMENT_SELECTION_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/records/environment_part.h>

#include <map>
#include <string>
#include <vector>

namespace cellwalk {

/// Facets between two cells, each seen from one of them, and cells; each once.
template <int D>
struct Selection {
  std::vector<Half_facet> facets;
  std::vector<Cell> cells;
};

/// The facets and cells that belong to a part of an environment, in the order of the cells. Facets of the
/// boundary belong to none.
/// \pre part.group is empty
/// Cost: linear.
template <int D>
Selection<D> select(const Snapshot<D>& snapshot, const Environment_part<D>& part);

/// The mean of the vertices of a facet or cell, rounded: the place that select() goes by.
/// \pre it exists
template <int D>
Point<D> centroid(const Snapshot<D>& snapshot, Half_facet facet);
template <int D>
Point<D> centroid(const Snapshot<D>& snapshot, Cell cell);

extern template Selection<2> select(const Snapshot<2>&, const Environment_part<2>&);
extern template Selection<3> select(const Snapshot<3>&, const Environment_part<3>&);
extern template Point<2> centroid(const Snapshot<2>&, Half_facet);
extern template Point<3> centroid(const Snapshot<3>&, Half_facet);
extern template Point<2> centroid(const Snapshot<2>&, Cell);
extern template Point<3> centroid(const Snapshot<3>&, Cell);

/// Named groups. Facets are seen from the cell of lower number; those of the boundary are among them.
template <int D>
using Groups = std::map<std::string, Selection<D>>;

/// The same groups by the numbers of Environment::soup(), as files have them.
template <int D>
Soup_groups soup_groups(const Snapshot<D>& snapshot, const Groups<D>& groups);

extern template Soup_groups soup_groups(const Snapshot<2>&, const Groups<2>&);
extern template Soup_groups soup_groups(const Snapshot<3>&, const Groups<3>&);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SELECTION_H
