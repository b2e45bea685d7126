// SPDX-License-Identifier: LGPL-3.0-or-later
// A walk's answer against the oracle's truth.
#ifndef CELLWALK_TESTS_WALK_WALK_JUDGE_H
#define CELLWALK_TESTS_WALK_WALK_JUDGE_H

#include <cellwalk/walk/walk.h>

#include <cstdint>
#include <string>
#include <vector>

#include "oracle/oracle.h"

namespace cellwalk::oracle {

enum class Verdict {
  right,
  lost,            ///< the walk did not end or found no exit
  missed_wall,     ///< arrived though every legal way is blocked, or blocked later than any
  false_contact,   ///< blocked though some legal way is not, or earlier than some
  wrong_cell,      ///< ends in a cell that does not hold the end, or on an illegal side
  illegal_way,     ///< the cells visited do not follow each other legally
  wrong_time,      ///< contact more than 4 ulp from the exact time, or not at the time the last cell blocks
  wrong_kind,      ///< contact kind does not fit the point
  wrong_wall,      ///< the wall named does not hold the point, can be passed, or is not reachable there
  wrong_normal,    ///< not of unit length, not at right angles to the wall, or not against the motion
  wrong_dimension  ///< of the cell that the target lies on
};
const char* name(Verdict verdict);

/// True if t is within 4 units in the last place of the exact fraction.
bool is_within_4_ulp(double t, const Fraction<Wide>& exact);

/// A motion and what is known about it.
template <int D>
struct Case {
  Point<D> from, to;
  std::uint32_t start = 0;  ///< cell, as in the soup
  Trace trace;
  Truth truth;
};

/// On which sides of walls a walk is to go: those on which it gets furthest, or any, as rounded kernels do.
enum class Sides_due { furthest, any };

/// Judges a walk over the snapshot that was compiled from the oracle's soup. `visited` may be empty (not
/// recorded).
template <int D>
Verdict judge_walk(const Oracle<D>& oracle, const Snapshot<D>& snapshot, const Case<D>& motion,
                   const Walk_result<D>& result, const std::vector<Cell>& visited,
                   Sides_due sides = Sides_due::furthest);

/// One line with all that is needed to replay a motion; coordinates as hexadecimal floating point.
template <int D>
std::string describe(const Case<D>& motion);

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_WALK_WALK_JUDGE_H
