// SPDX-License-Identifier: LGPL-3.0-or-later
// A repro: one motion of a particle with everything needed to walk it again, for a report of a wrong answer.
#ifndef CELLWALK_INTERNAL_RECORDS_REPRO_H
#define CELLWALK_INTERNAL_RECORDS_REPRO_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace cellwalk {

template <int D>
struct Repro {
  Cell_soup<D> soup;
  Point<D> from, to;
  /// Of the soup, in which the motion starts; none: any that contains the start
  std::optional<std::uint32_t> cell;
  std::string kernel = "exact", strategy = "exit_rule";  ///< as for `cellwalk query`
  std::string note;                                      ///< a remark, for the reader
  double radius = 0;                                     ///< of the particle, finite, at least 0
};

using Any_repro = std::variant<Repro<2>, Repro<3>>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_REPRO_H
