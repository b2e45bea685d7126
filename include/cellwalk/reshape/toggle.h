// SPDX-License-Identifier: LGPL-3.0-or-later
// What comes of facets that are opened and closed among bodies and particles, and of cells that are filled
// and excavated.
#ifndef CELLWALK_RESHAPE_TOGGLE_H
#define CELLWALK_RESHAPE_TOGGLE_H

#include <cellwalk/reshape/residents.h>

#include <string>
#include <vector>

namespace cellwalk {

/// What came of a change of a facet or a cell.
struct Change_result {
  bool is_made = false;           ///< also if nothing had to be changed
  std::string reason;             ///< why not, empty if made: one sentence without a full stop
  std::vector<Resident> held_by;  ///< every vertex, edge and face that forbids it, sorted
};

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_TOGGLE_H
