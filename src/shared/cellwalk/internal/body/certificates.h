// SPDX-License-Identifier: LGPL-3.0-or-later
// The certificates that may prove moves of a body free before they are tested exactly, for tests of each
// alone. Theory: docs/bodies.md, clearance and certified moves.
#ifndef CELLWALK_INTERNAL_BODY_CERTIFICATES_H
#define CELLWALK_INTERNAL_BODY_CERTIFICATES_H

#include <cellwalk/body/body.h>

#include <cstddef>

namespace cellwalk::detail {

/// Each is sound by itself; without one, only the cost is different. Those of an edge are chosen with the
/// sweep, see Sweep_options::certificates; without Body_options::clearance there are no regions at all.
struct Body_certificates {
  bool body_region = true;      ///< one region for the whole body
  bool star_regions = true;     ///< a pool of regions, each about a star
  bool clusters = true;         ///< walls near a region are found by clusters of cells, not cell by cell
  bool chains_in_place = true;  ///< chains of edges are confirmed where they stand
  /// Bodies of this number of vertices or more have regions about stars, and clusters.
  std::size_t least_vertices_of_parts = 33;
  /// Of these, those with fewer edges a vertex, as rods, have no regions at all: in place, their edges cost
  /// less than the searches.
  std::size_t least_edges_a_vertex = 2;
};

/// Chooses the certificates of one body, which keeps them when it is copied or registered again. It gives the
/// regions of the body up.
/// \throw Error(usage) if the environment was edited since the body was registered
template <int D>
void use_certificates(Body<D>& body, const Body_certificates& chosen, Body_counts& counts);
extern template void use_certificates(Body<2>&, const Body_certificates&, Body_counts&);
extern template void use_certificates(Body<3>&, const Body_certificates&, Body_counts&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_BODY_CERTIFICATES_H
