// SPDX-License-Identifier: LGPL-3.0-or-later
// The test that the map of an environment describes the same cells as its snapshot.
#ifndef CELLWALK_ENVIRONMENT_MAP_MAP_MATCHES_SNAPSHOT_H
#define CELLWALK_ENVIRONMENT_MAP_MAP_MATCHES_SNAPSHOT_H

#include <cellwalk/environment/map.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/build_map.h>

namespace cellwalk {

/// Compares map and snapshot cell by cell: points, facets with their loops, neighbours, marks, indices.
/// \pre check_map(storage)
/// \throw Error(other) naming the first cell in which they differ
template <int D>
void check_map_matches_snapshot(const Map_storage<D>& storage, const Snapshot<D>& snapshot);

/// True if the half-facet of a dart has the same points in the same order as one of the snapshot.
template <int D>
bool has_loop_of(const Map_storage<D>& storage, const Snapshot<D>& snapshot, Const_dart<D> d, Half_facet f);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_MAP_MAP_MATCHES_SNAPSHOT_H
