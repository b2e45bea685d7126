// SPDX-License-Identifier: LGPL-3.0-or-later
// One motion of a particle with all that is needed to walk it again, so that it can be sent to somebody else.
#ifndef CELLWALK_RECORDS_MOTION_RECORD_H
#define CELLWALK_RECORDS_MOTION_RECORD_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace cellwalk {

template <int D>
struct Motion_record {
  Cell_soup<D> soup;
  Point<D> from, to;
  std::optional<std::uint32_t>
      cell;  ///< of the soup, in which the motion starts; none: any that holds the start
  std::string kernel = "exact", strategy = "exit_rule";  ///< words of `cellwalk query`
  std::string note;                                      ///< what was remarkable, for people
};

using Any_motion_record = std::variant<Motion_record<2>, Motion_record<3>>;

}  // namespace cellwalk

#endif  // CELLWALK_RECORDS_MOTION_RECORD_H
