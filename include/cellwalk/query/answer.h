// SPDX-License-Identifier: LGPL-3.0-or-later
// The answer to the query of a motion, of a point or of an edge.
#ifndef CELLWALK_QUERY_ANSWER_H
#define CELLWALK_QUERY_ANSWER_H

#include <cellwalk/walk/contact.h>

#include <cstdint>
#include <optional>

namespace cellwalk {

enum class Motion_status : std::uint8_t {
  free,     ///< the motion arrives
  contact,  ///< a wall blocks it
  outside,  ///< it starts outside free space, or across a wall
  invalid,  ///< a coordinate is missing or not finite
  lost      ///< inexact kernels only: the walk found no exit from a cell
};

/// Their names in tables and reports.
inline constexpr const char* motion_status_names[] = {"free", "contact", "outside", "invalid", "lost"};

template <int D>
struct Answer {
  Motion_status status = Motion_status::invalid;
  std::uint32_t cells = 0;  ///< number of cells visited by the moving point
  Cell cell = Cell::none;   ///< in which the motion ends, or its contact is; none if outside or invalid
  std::optional<Contact<D>> contact;  ///< if status is contact
};

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_ANSWER_H
