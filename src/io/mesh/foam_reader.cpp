// SPDX-License-Identifier: LGPL-3.0-or-later
// Comments and white space skipped, the header, and numbers in both encodings.
#include "foam_reader.h"

#include <cellwalk/internal/io/numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

constexpr std::string_view punctuation = "(){};";

bool is_punctuation(char c) { return punctuation.find(c) != std::string_view::npos; }

template <class Number>
Number number_at(const char* bytes, bool is_swapped) {
  std::array<char, sizeof(Number)> copy;
  std::copy_n(bytes, copy.size(), copy.begin());
  if (is_swapped) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

}  // namespace

Foam_reader::Foam_reader(std::string file, std::string_view bytes) : file_(std::move(file)), bytes_(bytes) {
  read_header();
}

void Foam_reader::read_header() {
  skip_blanks();
  if (rest().empty()) fail("is empty");
  if (token("'FoamFile'") != "FoamFile")
    fail("not a file of OpenFOAM: it does not begin with a header 'FoamFile'");
  expect('{', "the header");
  std::optional<std::string> architecture;
  bool is_binary = false;
  while (!takes('}')) {
    const std::string key(token("the end of the header"));
    if (key == "format") {
      const std::string_view format = token("a format");
      is_binary = format == "binary";
      if (!is_binary && format != "ascii")
        fail(fmt::format("the format '{}' is not known: ascii and binary are", shown(format)));
    } else if (key == "class") {
      type_ = token("a class");
    } else if (key == "arch") {
      architecture = token("the widths of numbers");
    }
    skip_entry();
  }
  is_binary_ = is_binary;
  if (is_binary && architecture) read_architecture(*architecture);
}

/// Such as LSB;label=32;scalar=64.
void Foam_reader::read_architecture(std::string_view text) {
  const auto width = [&](std::string_view key, std::size_t& bytes) {
    const std::size_t at = text.find(key);
    if (at == std::string_view::npos) return;
    const std::string_view value = text.substr(at + key.size(), 2);
    if (value != "32" && value != "64")
      fail(fmt::format("the header says 'arch {}': only numbers of 32 and 64 bits are read", shown(text)));
    bytes = value == "32" ? 4 : 8;
  };
  width("label=", label_bytes_);
  width("scalar=", scalar_bytes_);
  knows_widths_ = true;
  const bool is_big_endian = text.starts_with("MSB");
  is_swapped_ = is_big_endian == (std::endian::native == std::endian::little);
}

void Foam_reader::skip_blanks() {
  while (true) {
    at_ = std::min(bytes_.find_first_not_of(blanks_and_ends, at_), bytes_.size());
    const bool is_long = rest().starts_with("/*");
    if (!is_long && !rest().starts_with("//")) return;
    token_ = at_;
    const std::size_t end = is_long ? bytes_.find("*/", at_ + 2) : bytes_.find('\n', at_);
    if (is_long && end == std::string_view::npos) fail("a comment without an end: the file is cut short");
    at_ = is_long ? end + 2 : std::min(end, bytes_.size());
  }
}

std::string_view Foam_reader::token(std::string_view what) {
  skip_blanks();
  token_ = at_;
  const std::string_view left = rest();
  if (left.empty()) fail(fmt::format("the file ends where {} should be: it is cut short", what));
  if (left.front() == '"') {
    const std::size_t end = left.find('"', 1);
    if (end == std::string_view::npos) fail("a text in quotes without an end");
    at_ += end + 1;
    return left.substr(1, end - 1);
  }
  std::size_t size = 1;
  if (!is_punctuation(left.front()))
    while (size < left.size() && left[size] != '"' && !is_punctuation(left[size]) &&
           blanks_and_ends.find(left[size]) == std::string_view::npos)
      ++size;
  at_ += size;
  return left.substr(0, size);
}

bool Foam_reader::takes(char c) {
  skip_blanks();
  if (!rest().starts_with(c)) return false;
  token_ = at_++;
  return true;
}

void Foam_reader::expect(char c, std::string_view what) {
  if (takes(c)) return;
  const std::string_view found = token(fmt::format("'{}' of {}", c, what));
  fail(fmt::format("'{}' where '{}' of {} should be", shown(found), c, what));
}

std::int64_t Foam_reader::integer(std::string_view what) {
  const std::string_view word = token(what);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size())
    fail(fmt::format("{}: '{}' is not an integer", what, shown(word)));
  return value;
}

double Foam_reader::real(std::string_view what) {
  const std::string_view word = token(what);
  const std::optional<double> value = parse_decimal(word);
  if (!value) fail(fmt::format("{}: '{}' is not a number that a double can hold", what, shown(word)));
  if (!std::isfinite(*value)) fail(fmt::format("{}: '{}' is not finite", what, shown(word)));
  return *value;
}

std::size_t Foam_reader::count(std::string_view what) {
  const std::int64_t count = integer(fmt::format("the number of {}", what));
  if (count < 0) fail(fmt::format("announces {} {}: it is broken", count, what));
  return static_cast<std::size_t>(count);
}

void Foam_reader::expect_room(std::size_t count, std::string_view what, std::size_t bytes_each) const {
  if (count > rest().size() / bytes_each)
    fail(
        fmt::format("announces {} {}, more than the {} bytes that follow can hold: it is cut short or broken",
                    count, what, rest().size()));
}

/// True if a block of such a size is closed where it ends.
bool Foam_reader::ends_after(std::size_t count, std::size_t bytes_each) {
  skip_blanks();
  if (rest().empty() || count > (rest().size() - 1) / bytes_each) return false;
  std::string_view after = rest().substr(1 + count * bytes_each);
  after.remove_prefix(std::min(after.find_first_not_of(blanks_and_ends), after.size()));
  if (!after.starts_with(')')) return false;
  return after.size() == 1 || after[1] == ';' || after[1] == ')' ||
         blanks_and_ends.find(after[1]) != std::string_view::npos;
}

std::string_view Foam_reader::labels(std::size_t count, std::string_view what) {
  constexpr std::size_t narrow = 4, wide = 8;
  if (!knows_widths_) label_bytes_ = !ends_after(count, narrow) && ends_after(count, wide) ? wide : narrow;
  return block(count, what, label_bytes_);
}

std::string_view Foam_reader::vectors(std::size_t count, std::string_view what) {
  constexpr std::size_t narrow = 4, wide = 8;
  if (!knows_widths_)
    scalar_bytes_ = !ends_after(count, 3 * wide) && ends_after(count, 3 * narrow) ? narrow : wide;
  return block(count, what, 3 * scalar_bytes_);
}

std::string_view Foam_reader::block(std::size_t count, std::string_view what, std::size_t bytes_each) {
  if (count == 0) {
    if (takes('(')) expect(')', what);
    return {};
  }
  expect('(', what);
  expect_room(count, what, bytes_each);
  const std::string_view taken = bytes_.substr(at_, count * bytes_each);
  at_ += taken.size();
  expect(')', what);
  return taken;
}

std::int64_t Foam_reader::label_at(const char* bytes) const {
  return label_bytes_ == 4 ? number_at<std::int32_t>(bytes, is_swapped_)
                           : number_at<std::int64_t>(bytes, is_swapped_);
}

double Foam_reader::scalar_at(const char* bytes) const {
  return scalar_bytes_ == 4 ? static_cast<double>(number_at<float>(bytes, is_swapped_))
                            : number_at<double>(bytes, is_swapped_);
}

void Foam_reader::skip_raw(std::string_view type) {
  constexpr std::string_view what = "values of a list";
  if (type == "List<bool>")
    block(count(what), what, 1);
  else if (type == "List<label>")
    labels(count(what), what);
  else if (type == "List<scalar>")
    block(count(what), what, scalar_bytes_);
  else if (type == "List<vector>")
    vectors(count(what), what);
}

void Foam_reader::skip_entry() {
  const bool is_dictionary = takes('{');
  std::size_t depth = is_dictionary ? 1 : 0;
  while (depth > 0 || !is_dictionary) {
    const std::string_view word = token("the end of an entry");
    const char c = bytes_[token_];  // a parenthesis in quotes is none
    if (c == '(' || c == '{') {
      ++depth;
    } else if (c == ')' || c == '}') {
      if (depth-- == 0) fail(fmt::format("'{}' where an entry should end", c));
    } else if (c == ';' && depth == 0) {
      return;
    } else if (is_binary_) {
      skip_raw(word);
    }
  }
}

void Foam_reader::fail(const std::string& what) const {
  if (is_binary_) io::fail(file_, fmt::format("byte {}: {}", token_, what));
  const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(token_), '\n');
  io::fail(file_, static_cast<std::size_t>(lines) + 1, what);
}

}  // namespace cellwalk::io
