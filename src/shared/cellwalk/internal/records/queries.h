// SPDX-License-Identifier: LGPL-3.0-or-later
// Queries of a table, one for each row.
#ifndef CELLWALK_INTERNAL_RECORDS_QUERIES_H
#define CELLWALK_INTERNAL_RECORDS_QUERIES_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <string>

namespace cellwalk {

/// The points of one row of a table. An invalid row has a reason; other rows are not affected.
template <int D, std::size_t N>
struct Query_row {
  std::array<Point<D>, N> points{};
  std::size_t line = 0;  ///< in the file, from 1
  std::string error;     ///< empty, or the reason why the row is invalid
};

/// A motion of a particle: from points[0] to points[1].
template <int D>
using Move_query = Query_row<D, 2>;

/// A motion of an edge: one end from points[0] to points[1], the other at points[2].
template <int D>
using Sweep_query = Query_row<D, 3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_QUERIES_H
