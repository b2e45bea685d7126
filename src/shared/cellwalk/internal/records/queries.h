// SPDX-License-Identifier: LGPL-3.0-or-later
// Queries of a table, one for each row.
#ifndef CELLWALK_INTERNAL_RECORDS_QUERIES_H
#define CELLWALK_INTERNAL_RECORDS_QUERIES_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <string>

namespace cellwalk {

/// One row of a table: a motion of a point from points[0] to points[1], or of an edge whose end moves from
/// points[0] to points[1] while points[2] stands still. An invalid row has a reason; other rows are not
/// affected.
template <int D, std::size_t N>
struct Query_row {
  std::array<Point<D>, N> points{};
  double radius = 0;     ///< finite, at least 0
  double weight = 1;     ///< in sums over rows; finite
  std::size_t line = 0;  ///< in the file, from 1
  std::string error;     ///< empty, or the reason why the row is invalid
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_QUERIES_H
