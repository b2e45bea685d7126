// SPDX-License-Identifier: LGPL-3.0-or-later
#include "vtk_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <system_error>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

/// The largest number of values a byte can encode: as text, a value needs a digit and a blank; compressed, a
/// byte gives at most 1032 bytes of data (the bound of deflate), of which a point needs at least twelve, and
/// a cell about as many.
constexpr std::string_view blanks = " \t\v\f\r\n";
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

/// Checks attributes such as NumberOfPoints="8" of the tags that have some.
void check_xml(const std::string& name, std::string_view bytes) {
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

/// The text after its first words.
std::string_view after_words(std::string_view text, int words) {
  for (; words > 0; --words) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    text.remove_prefix(std::min(text.find_first_of(blanks), text.size()));
  }
  return text;
}

/// The numbers of a list of cells, as VTK takes them: words, or four bytes with the highest first.
class Cell_list {
 public:
  Cell_list(std::string_view rest, bool is_binary) : rest_(rest), is_binary_(is_binary) {
    if (is_binary) rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
  }

  /// The next one; none at the end, or at a word that is no number.
  std::optional<std::int64_t> next() {
    if (is_binary_) {
      if (rest_.size() < 4) return {};
      std::uint32_t value = 0;
      for (const char c : rest_.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
      rest_.remove_prefix(4);
      return static_cast<std::int32_t>(value);
    }
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
    const std::size_t end = std::min(rest_.find_first_of(blanks), rest_.size());
    std::int64_t value = 0;
    const auto [read, error] = std::from_chars(rest_.data(), rest_.data() + end, value);
    if (error != std::errc() || read != rest_.data() + end) return {};
    rest_.remove_prefix(end);
    return value;
  }

 private:
  std::string_view rest_;
  bool is_binary_;
};

/// Checks that cells, each a number of corners and these, take the numbers that are announced for all: VTK
/// writes beyond its memory where they do not. Not for the lists with offsets of versions from 5 on.
void check_list(const std::string& name, std::string_view keyword, std::uint64_t cells, std::uint64_t numbers,
                Cell_list list) {
  std::uint64_t taken = 0;
  for (std::uint64_t i = 0; i < cells; ++i) {
    const auto corners = list.next();
    if (!corners) return;  // VTK says so
    taken = *corners < 0 || static_cast<std::uint64_t>(*corners) >= numbers
                ? numbers + 1
                : taken + 1 + static_cast<std::uint64_t>(*corners);
    if (taken > numbers) break;
    for (std::int64_t k = 0; k < *corners; ++k)
      if (!list.next()) return;
  }
  if (taken != numbers)
    fail(name, fmt::format("its {} {} do not take the {} numbers that are announced for them: it is broken",
                           cells, lower(shown(keyword)), numbers));
}

/// Checks the numbers after keywords, as in POINTS 8 double, CELLS 2 10. VTK takes them from words, wherever
/// lines end.
void check_legacy(const std::string& name, std::string_view bytes) {
  constexpr std::array<std::string_view, 9> keywords{"POINTS",          "CELLS",      "CELL_TYPES",
                                                     "POLYGONS",        "LINES",      "VERTICES",
                                                     "TRIANGLE_STRIPS", "POINT_DATA", "CELL_DATA"};
  constexpr std::array<std::string_view, 5> lists{"CELLS", "POLYGONS", "LINES", "VERTICES",
                                                  "TRIANGLE_STRIPS"};
  const double most = static_cast<double>(bytes.size()) * per_byte_plain;
  std::size_t at = bytes.find('\n');
  at = bytes.find('\n', std::min(at, bytes.size() - 1) + 1);  // after the title, which may be any text
  const std::size_t form = std::min(bytes.find_first_not_of(blanks, at), bytes.size());
  const bool is_binary = same_word(bytes.substr(form, 6), "BINARY");
  for (; at != std::string_view::npos; at = bytes.find_first_of(blanks, at + 1)) {
    const std::string_view first = bytes.substr(at + 1, 1);
    if (first.empty() || std::string_view("PCLVTpclvt").find(first) == std::string_view::npos) continue;
    const std::size_t end = std::min(bytes.find_first_of(blanks, at + 1), bytes.size());
    const std::string_view keyword = bytes.substr(at + 1, end - at - 1);
    if (std::none_of(keywords.begin(), keywords.end(),
                     [&](std::string_view known) { return same_word(keyword, known); }))
      continue;
    const std::size_t number = std::min(bytes.find_first_not_of(blanks, end), bytes.size());
    Line_reader line("", bytes.substr(number, 128), std::nullopt);
    if (!line.next_line()) continue;
    for (std::string_view word = line.word(); !word.empty(); word = line.word())
      check_count(name, keyword, leading_number(word), most, bytes.size());
    if (std::ranges::none_of(lists, [&](std::string_view list) { return same_word(keyword, list); }))
      continue;
    // Lines may end between the two numbers of a list.
    const std::string_view cells = bytes.substr(number), numbers = after_words(cells, 1);
    const std::uint64_t announced =
        leading_number(numbers.substr(std::min(numbers.find_first_not_of(blanks), numbers.size())));
    check_count(name, keyword, announced, most, bytes.size());
    const std::string_view list = after_words(numbers, 1);
    const std::string_view next = list.substr(std::min(list.find_first_not_of(blanks), list.size()), 7);
    if (!same_word(next, "OFFSETS"))
      check_list(name, keyword, leading_number(cells), announced, {list, is_binary});
  }
}

}  // namespace

void check_vtk_counts(const std::string& name, std::string_view bytes, Format format) {
  if (format == Format::vtk_xml)
    check_xml(name, bytes);
  else
    check_legacy(name, bytes);
}

}  // namespace cellwalk::io
