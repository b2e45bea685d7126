// SPDX-License-Identifier: LGPL-3.0-or-later
// Text unpacked if it is gzip, its lines and words, and the errors that quote them.
#include "text.h"

#include <cellwalk/internal/io/numbers.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <new>

namespace cellwalk::io {
namespace {

/// A message in one line, for any bytes of a file that it quotes.
std::string one_line(std::string message) {
  constexpr char first_printed = ' ', delete_character = 0x7f;
  for (char& c : message)
    if ((c >= 0 && c < first_printed) || c == delete_character) c = '?';
  return message;
}

}  // namespace

std::string shown(std::string_view word) {
  constexpr std::size_t most = 40;  // bytes
  return one_line(word.size() <= most ? std::string(word) : std::string(word.substr(0, most)) + "...");
}

std::string unpack(const std::string& file, const std::string& packed) {
  z_stream stream{};
  constexpr int gzip_only = 15 + 16;  // the largest window, gzip framing
  if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc();
  std::string out;
  std::size_t taken = 0;
  int status = Z_OK;
  std::string chunk(std::size_t{1} << 20, '\0');
  while (status == Z_OK || (status == Z_STREAM_END && taken < packed.size())) {
    if (status == Z_STREAM_END && inflateReset(&stream) != Z_OK) break;  // a further member
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + taken));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size() - taken, chunk.size()));
    const uInt offered = stream.avail_in;
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    status = inflate(&stream, Z_NO_FLUSH);
    taken += offered - stream.avail_in;
    out.append(chunk.data(), chunk.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (status != Z_STREAM_END)
    fail(file, "the gzip stream is damaged or cut short: copy or compress the file again");
  return out;
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string load_packed(const std::filesystem::path& path) {
  // The system takes a name to end at its first NUL.
  if (path.native().find('\0') != std::string::npos) fail(path.string(), "a name with a NUL character");
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail(path.string(), "is a directory: name a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path.string(), "cannot be opened: check that it exists and may be read");
  std::string bytes;
  if (const auto size = std::filesystem::file_size(path, error); !error) {
    bytes.resize(size);
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
  } else {  // a pipe or device
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  if (in.bad()) fail(path.string(), "reading failed");
  return bytes;
}

std::string load(const std::filesystem::path& path) {
  std::string bytes = load_packed(path);
  return is_gzip(bytes) ? unpack(path.string(), bytes) : bytes;
}

void fail(const std::string& file, const std::string& what) {
  throw Error(Error_code::input, one_line(fmt::format("{}: {}", file, what)));
}

void fail(const std::string& file, std::size_t line, const std::string& what) {
  throw Error(Error_code::input, one_line(fmt::format("{}:{}: {}", file, line, what)));
}

Line_reader::Line_reader(std::string file, std::string_view text, std::optional<char> comment)
    : file_(std::move(file)), text_(text), comment_(comment) {
  if (text_.starts_with("\xef\xbb\xbf")) position_ = 3;  // a byte order mark
}

bool Line_reader::next_line() {
  while (position_ < text_.size()) {
    line_begin_ = position_;
    ++line_number_;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    position_ = std::min(end + 1, text_.size());
    rest_ = text_.substr(line_begin_, end - line_begin_);
    if (rest_.ends_with('\r')) rest_.remove_suffix(1);
    if (comment_) rest_ = rest_.substr(0, rest_.find(*comment_));
    if (!at_line_end()) return true;
  }
  if (line_number_ == 0 || (line_begin_ < text_.size() && text_.ends_with('\n'))) ++line_number_;
  line_begin_ = text_.size();
  rest_ = {};
  return false;
}

void Line_reader::narrow(std::size_t begin, std::size_t end) {
  const std::string_view passed = text_.substr(position_, begin - position_);
  line_number_ += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
  position_ = begin;
  text_ = text_.substr(0, end);
}

void Line_reader::need_line(std::string_view expected) {
  if (!next_line()) fail(fmt::format("the file ends where {} should be: it is cut short", expected));
}

std::string_view Line_reader::word() {
  if (at_line_end()) return {};
  const std::size_t end = std::min(rest_.find_first_of(blanks), rest_.size());
  const std::string_view w = rest_.substr(0, end);
  rest_.remove_prefix(end);
  return w;
}

bool Line_reader::at_line_end() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
  return rest_.empty();
}

double Line_reader::number(std::string_view what) {
  const std::string_view w = word();
  if (w.empty()) fail(fmt::format("{} is missing", what));
  const auto value = parse_decimal(w);
  if (!value) fail(fmt::format("{}: '{}' is not a number that a double can hold", what, shown(w)));
  if (!std::isfinite(*value)) fail(fmt::format("{}: '{}' is not finite", what, shown(w)));
  return *value;
}

std::uint64_t Line_reader::count(std::string_view what) {
  const std::string_view w = word();
  if (w.empty()) fail(fmt::format("{} is missing", what));
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (error != std::errc{} || end != w.data() + w.size())
    fail(fmt::format("{}: '{}' is not an integer >= 0", what, shown(w)));
  return value;
}

std::uint32_t Line_reader::index(std::string_view what, std::size_t size, std::uint32_t base) {
  const std::uint64_t value = count(what);
  if (value < base || value - base >= size)
    fail(fmt::format("{} {} is out of range: there are {}, counted from {}", what, value, size, base));
  return static_cast<std::uint32_t>(value - base);
}

void Line_reader::expect_line_end(std::string_view after) {
  if (!at_line_end()) fail(fmt::format("'{}' follows {}, where the line should end", shown(word()), after));
}

std::size_t Line_reader::plausible(std::uint64_t announced, std::size_t bytes) const {
  return static_cast<std::size_t>(std::min<std::uint64_t>(announced, (text_.size() - position_) / bytes + 1));
}

void Line_reader::fail(const std::string& what) const { io::fail(file_, line(), what); }

bool same_word(std::string_view a, std::string_view b) { return lower(a) == lower(b); }

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace cellwalk::io
