// SPDX-License-Identifier: LGPL-3.0-or-later
// The second oracle of moving walls: follows the definition of chains through all times at which anything may
// change, in rational numbers, by brute force over all cells near. Of the library it uses which cells there
// are and how they are joined. It finds all that may become of an edge, or of a particle as an edge of no
// length.
#ifndef CELLWALK_TESTS_RESHAPE_DEFINITION_ORACLE_H
#define CELLWALK_TESTS_RESHAPE_DEFINITION_ORACLE_H

#include <cellwalk/edge/chain.h>

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "kernel/rational_meeting.h"

namespace cellwalk::test {

/// The motion of a vertex of an environment of simplices.
template <int D>
struct Wall_motion {
  const Snapshot<D>& snapshot;
  std::uint32_t vertex;
  Point<D> from, to;
};

/// An edge and its chain, or twice the same particle.
template <int D>
struct Registered_edge {
  Point<D> p, q;
  Cell p_cell, q_cell;
  std::vector<Half_facet> chain;
};

/// What may become of it.
struct Fate {
  bool may_be_free = false;
  bool has_choice = false;          ///< at some time it is continued by unequal chains
  std::optional<Fraction> blocked;  ///< the last time until which it may be free, if not until 1
  /// Of chains after the move: the least of the cells linked at p, on each piece, and at q.
  std::set<std::vector<Cell>> ends;
};

template <int D>
Fate fate_of(const Wall_motion<D>& motion, const Registered_edge<D>& before);

/// True if a registration is one of those that it may have after the move.
template <int D>
bool is_end(const Wall_motion<D>& motion, const Fate& fate, const Registered_edge<D>& after);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_DEFINITION_ORACLE_H
