// SPDX-License-Identifier: LGPL-3.0-or-later
// Words taken across lines, and converted to numbers with errors that name the line.
#include "word_reader.h"

#include <cellwalk/internal/io/numbers.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace cellwalk::io {

bool Word_reader::has_word() {
  if (peeked_) return true;
  while (in_.at_line_end())
    if (!in_.next_line()) return false;
  return true;
}

std::string_view Word_reader::peek(std::string_view what) {
  if (!peeked_) {
    while (in_.at_line_end()) in_.need_line(what);
    peeked_ = in_.word();
  }
  return *peeked_;
}

std::string_view Word_reader::word(std::string_view what) {
  const std::string_view w = peek(what);
  peeked_.reset();
  return w;
}

std::int64_t Word_reader::integer(std::string_view what) {
  std::string_view w = word(what);
  const std::string_view whole = w;
  if (w.size() > 1 && w.front() == '+' && w[1] != '-') w.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (error == std::errc::result_out_of_range) return std::numeric_limits<std::int64_t>::max();
  if (error != std::errc{} || end != w.data() + w.size())
    in_.fail(fmt::format("{}: '{}' is not an integer", what, shown(whole)));
  return value;
}

double Word_reader::coordinate(std::string_view what) {
  const std::string_view w = word(what);
  std::optional<double> value = parse_decimal(w);
  if (const std::size_t exponent = w.find_first_of("dD"); !value && exponent != std::string_view::npos) {
    std::string in_c(w);
    in_c[exponent] = 'e';
    value = parse_decimal(in_c);
  }
  if (!value) in_.fail(fmt::format("{}: '{}' is not a number that a double can hold", what, shown(w)));
  if (!std::isfinite(*value)) in_.fail(fmt::format("{}: '{}' is not finite", what, shown(w)));
  return *value;
}

std::string_view Word_reader::rest_of_line(std::string_view what) {
  while (in_.at_line_end()) in_.need_line(what);
  return in_.rest();
}

}  // namespace cellwalk::io
