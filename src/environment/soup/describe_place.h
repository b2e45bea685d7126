// SPDX-License-Identifier: LGPL-3.0-or-later
// Points in messages. Internal.
#ifndef CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H
#define CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H

#include <array>
#include <charconv>
#include <cstddef>
#include <span>
#include <string>

namespace cellwalk::detail {

/// Where a point is: 17 digits would hide the message; 9 suffice to find it, in small worlds and in large
/// ones.
inline std::string describe_place(std::span<const double> p) {
  constexpr int digits = 9;
  std::string text = "(";
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::array<char, 32> coordinate;  // sign, digits, point and exponent
    const auto end = std::to_chars(coordinate.data(), coordinate.data() + coordinate.size(), p[i] + 0.0,
                                   std::chars_format::general, digits);  // -0 as 0
    text.append(i ? ", " : "").append(coordinate.data(), end.ptr);
  }
  return text + ")";
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_SOUP_DESCRIBE_PLACE_H
