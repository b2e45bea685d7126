// SPDX-License-Identifier: LGPL-3.0-or-later
// Points in messages. Internal.
#ifndef CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H
#define CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H

#include <cstddef>
#include <span>
#include <string>

namespace cellwalk::detail {

/// Where a point is: 17 digits would hide the message, 6 decimal places suffice to find it.
inline std::string describe_place(std::span<const double> p) {
  std::string text = "(";
  for (std::size_t i = 0; i < p.size(); ++i) text += (i ? ", " : "") + std::to_string(p[i]);
  return text + ")";
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H
