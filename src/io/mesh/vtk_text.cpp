// SPDX-License-Identifier: LGPL-3.0-or-later
// The bound of the number of values that bytes of XML can encode.
#include "vtk_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

/// The largest number of values a byte can encode: as text, a value needs a digit and a blank; compressed, a
/// byte gives at most 1032 bytes of data (the bound of deflate), of which a point needs at least twelve, and
/// a cell about as many.
constexpr double per_byte_plain = 0.5, per_byte_compressed = 1032.0 / 12;

/// The digits at the beginning of a text as a number; the largest number if there are too many.
std::uint64_t leading_number(std::string_view text) {
  std::uint64_t value = 0;
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  for (const char c : text) {
    if (c < '0' || c > '9') break;
    const auto digit = static_cast<std::uint64_t>(c - '0');
    value = value > (most - digit) / 10 ? most : 10 * value + digit;
  }
  return value;
}

void check_count(const std::string& name, std::string_view what, std::uint64_t count, double most,
                 std::size_t bytes) {
  if (static_cast<double>(count) > most)
    fail(name, fmt::format("announces {} {}, more than its {} bytes can hold: it is cut short or broken",
                           count, lower(shown(what)), bytes));
}

}  // namespace

void check_vtk_counts(const std::string& name, std::string_view bytes) {
  constexpr std::string_view attribute = "NumberOf";
  const bool is_compressed = bytes.substr(0, 4096).find("compressor") != std::string_view::npos;
  const double most =
      static_cast<double>(bytes.size()) * (is_compressed ? per_byte_compressed : per_byte_plain);
  for (const std::string_view tag : {"<Piece", "<DataArray"})
    for (std::size_t at = bytes.find(tag); at != std::string_view::npos; at = bytes.find(tag, at)) {
      std::string_view rest = bytes.substr(at, bytes.find('>', at) - at);
      at += rest.size();  // a tag that is not closed is looked through once
      for (std::size_t found = 0; (found = rest.find(attribute)) != std::string_view::npos;) {
        rest.remove_prefix(found + attribute.size());
        const std::size_t word = std::min(rest.find_first_of("= \t\r\n"), rest.size());
        const std::size_t quote = std::min(rest.find_first_of("'\""), rest.size());
        const std::string_view value = rest.substr(quote, rest.find_first_of("'\"", quote + 1) - quote);
        if (value.find('&') != std::string_view::npos)
          fail(name, fmt::format("'{}': a count is to be written in digits", shown(value)));
        const std::size_t digits = rest.find_first_of("0123456789");
        if (digits != std::string_view::npos)
          check_count(name, rest.substr(0, word), leading_number(rest.substr(digits)), most, bytes.size());
      }
    }
}

}  // namespace cellwalk::io
