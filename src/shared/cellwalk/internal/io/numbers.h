// SPDX-License-Identifier: LGPL-3.0-or-later
// Reading and writing of numbers in tables, options and meshes, independent of the locale.
#ifndef CELLWALK_INTERNAL_IO_NUMBERS_H
#define CELLWALK_INTERNAL_IO_NUMBERS_H

#include <optional>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// A decimal number rounded to the nearest double, with an optional leading '+'. None if `text` is not
/// exactly one number, or too large for a double. `nan` and `inf` are accepted; callers that need finite
/// numbers check.
std::optional<double> parse_decimal(std::string_view text) noexcept;

/// The result of parse_number(): a finite value, or the reason why there is none.
struct Parsed_number {
  double value = 0;
  std::string reason;  ///< empty if the value is valid
  explicit operator bool() const { return reason.empty(); }
};

/// A number of a table or an option: decimal (rounded to the nearest double), hexadecimal floating point
/// (`0x1.8p+1`), or a fraction `n/d` of integers of any length whose value is exactly a double.
Parsed_number parse_number(std::string_view text);

/// The reason why a number is no radius of a motion or an edge; empty if it is one: finite and at least 0.
std::string radius_problem(double number);

/// The shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// Hexadecimal floating point (`0x1.8p+1`): exact to read and to compare.
std::string hexadecimal(double value);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_NUMBERS_H
