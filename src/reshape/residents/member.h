// SPDX-License-Identifier: LGPL-3.0-or-later
// The numbers of a part of a resident.
#ifndef CELLWALK_RESHAPE_RESIDENTS_MEMBER_H
#define CELLWALK_RESHAPE_RESIDENTS_MEMBER_H

#include <compare>
#include <cstdint>

namespace cellwalk::detail {

/// A vertex, an edge or a face of a group.
struct Member {
  std::uint32_t group, number;
  auto operator<=>(const Member&) const = default;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_RESIDENTS_MEMBER_H
