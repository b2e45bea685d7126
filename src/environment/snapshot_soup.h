// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells of a snapshot as a soup again.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_SOUP_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_SOUP_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/records/cell_soup.h>

#include <vector>

namespace cellwalk {

/// The cells of a snapshot in the order of their indices.
/// \param names if not null, receives the half-facet of each facet of the soup
template <int D>
Cell_soup<D> soup_of(const Snapshot<D>& snapshot, std::vector<Half_facet>* names);

/// The gluing of the facets of such a soup, by the links of the snapshot, which walks follow.
template <int D>
Gluing gluing_of(const Snapshot<D>& snapshot, const std::vector<Half_facet>& names);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_SOUP_H
