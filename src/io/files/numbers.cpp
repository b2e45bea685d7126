// SPDX-License-Identifier: LGPL-3.0-or-later
// Fractions and hexadecimal numbers without rounding, and the shortest digits of a double.
#include <cellwalk/internal/io/numbers.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "text.h"

namespace cellwalk::io {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// The longest integer of a fraction in digits: twice as many as the smallest double needs.
constexpr std::size_t most_digits = 2200;

bool is_digits(std::string_view s) {
  return !s.empty() && s.find_first_not_of("0123456789") == std::string_view::npos;
}

/// n / d for positive integers, if that is exactly a double.
std::optional<double> exact_quotient(Integer n, Integer d) {
  const Integer common = gcd(n, d);
  n /= common;
  d /= common;
  const auto power = static_cast<long>(msb(d));
  if (Integer(1) << power != d) return std::nullopt;  // the denominator is not a power of two
  const auto low = static_cast<long>(lsb(n)), high = static_cast<long>(msb(n));
  using limits = std::numeric_limits<double>;
  constexpr long lowest_bit = limits::min_exponent - limits::digits;  // weight 2^-1074
  if (high - low >= limits::digits || low - power < lowest_bit || high - power >= limits::max_exponent)
    return std::nullopt;
  n >>= low;
  return std::ldexp(static_cast<double>(n.convert_to<std::uint64_t>()), static_cast<int>(low - power));
}

Parsed_number parse_fraction(std::string_view text, std::size_t slash) {
  std::string_view n = text.substr(0, slash), d = text.substr(slash + 1);
  const bool negative = n.starts_with('-');
  if (negative || n.starts_with('+')) n.remove_prefix(1);
  if (!is_digits(n) || !is_digits(d))
    return {0, fmt::format("'{}' is not a fraction of integers", shown(text))};
  if (n.size() > most_digits || d.size() > most_digits) return {0, "a fraction with too many digits"};
  // A leading zero would make the number octal.
  auto trimmed = [](std::string_view s) {
    const std::size_t first = s.find_first_not_of('0');
    return first == std::string_view::npos ? std::string("0") : std::string(s.substr(first));
  };
  const Integer top(trimmed(n)), bottom(trimmed(d));
  if (bottom == 0) return {0, fmt::format("the denominator of '{}' is zero", shown(text))};
  if (top == 0) return {negative ? -0.0 : 0.0, {}};
  const auto value = exact_quotient(top, bottom);
  if (!value) return {0, fmt::format("the fraction '{}' is not exactly a double", shown(text))};
  return {negative ? -*value : *value, {}};
}

/// libstdc++ reads hexadecimal floating point without its prefix.
std::optional<double> parse_hexadecimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  text.remove_prefix(2);
  if (text.empty() || text.front() == '-') return std::nullopt;
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::hex);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return negative ? -value : value;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view text) noexcept {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc{}) return value;
  if (error != std::errc::result_out_of_range) return std::nullopt;
  // from_chars does not distinguish overflow from underflow. A number too small is rounded to zero.
  const std::size_t exponent = text.find_first_of("eE");
  const bool tiny = exponent == std::string_view::npos ? text.find_first_not_of("-0.") > 300
                                                       : text.substr(exponent + 1).starts_with('-');
  if (!tiny) return std::nullopt;
  return text.starts_with('-') ? -0.0 : 0.0;
}

Parsed_number parse_number(std::string_view text) {
  if (text.empty()) return {0, "an empty field where a number is expected"};
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos)
    return parse_fraction(text, slash);
  const std::size_t digits = text.find_first_not_of("+-");
  const std::string_view bare = digits == std::string_view::npos ? text : text.substr(digits);
  const bool hex = digits <= 1 && (bare.starts_with("0x") || bare.starts_with("0X"));
  const auto value = hex ? parse_hexadecimal(text) : parse_decimal(text);
  if (!value) return {0, fmt::format("'{}' is not a number that a double can hold", shown(text))};
  if (!std::isfinite(*value)) return {0, fmt::format("'{}' is not finite", shown(text))};
  return {*value, {}};
}

std::string radius_problem(double number) {
  if (number >= 0 && std::isfinite(number)) return {};
  return fmt::format("radius: takes a finite number of at least 0, not {}", number);
}

std::string shortest(double value) { return fmt::format("{}", value); }

std::string hexadecimal(double value) { return fmt::format("{:a}", value); }

}  // namespace cellwalk::io
