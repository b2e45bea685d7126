// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment that a trace holds itself. It is built and certified like any other, so that walks cannot
// exploit that its cells are cubes.
#ifndef CELLWALK_INTERNAL_SIMULATION_TRACE_ENVIRONMENT_H
#define CELLWALK_INTERNAL_SIMULATION_TRACE_ENVIRONMENT_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/internal/records/body_trace.h>

namespace cellwalk {

/// A grid with its solid cells, frozen.
/// \param map shears, rotates or scales the grid
/// \throw Error(usage) as hex_grid(), if the grid is too large for 32-bit indices or the map would round its
///        points
/// Cost: about 5 us a cell.
Environment<3> trace_environment(const Traced_grid& grid, const Lattice_map<3>& map = {});

/// A trace whose positions and targets, but not its radii, are transformed by a map and rounded. Answers may
/// differ if a motion passes a wall within the rounding, about 2^-50 of the size of the grid. The identity
/// changes nothing.
Body_trace mapped(Body_trace trace, const Lattice_map<3>& map);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TRACE_ENVIRONMENT_H
