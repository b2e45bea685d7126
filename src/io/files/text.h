// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a whole text file in memory, read line by line, with errors that name file and line.
#ifndef CELLWALK_IO_FILES_TEXT_H
#define CELLWALK_IO_FILES_TEXT_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// White space: within lines, and with their ends.
inline constexpr std::string_view blanks = " \t\v\f", blanks_and_ends = " \t\v\f\r\n";

/// The bytes of a file; a file compressed with gzip is inflated, whatever its name.
/// \throw Error(input) if it cannot be read, or its gzip stream is damaged
std::string load(const std::filesystem::path& path);

/// The bytes of a file, unchanged.
/// \throw Error(input) if it cannot be read
std::string load_packed(const std::filesystem::path& path);
/// The content of a gzip stream.
/// \param file stands for the file in errors
/// \throw Error(input) if it is damaged
std::string unpack(const std::string& file, const std::string& packed);

/// True if the bytes begin like a gzip stream.
bool is_gzip(std::string_view bytes);

/// A word for error messages; a long one is shortened.
std::string shown(std::string_view word);

/// \throw Error(input) "file: what", always, in one line
[[noreturn]] void fail(const std::string& file, const std::string& what);
/// \throw Error(input) "file:line: what", always, in one line
[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& what);

/// The lines of a text, one after the other, and the words of the current line. Blank lines and the text
/// after a comment character are skipped. Line ends may be \n or \r\n. Refers to the text, which must outlive
/// it.
class Line_reader {
 public:
  Line_reader(std::string file, std::string_view text, std::optional<char> comment = '#');

  /// Moves to the next line that has words. False at the end of the text.
  bool next_line();
  /// The same as next_line(), but the end of the text is an error: "ends where `expected` should be".
  void need_line(std::string_view expected);
  /// Makes the next call of next_line() return the current line again.
  void unread() { position_ = line_begin_, --line_number_; }

  /// Leaves only a part of the text to be read; lines keep their numbers.
  /// \pre it begins at a line that is not read yet, and ends with one
  /// Cost: a look at all bytes before it.
  void narrow(std::size_t begin, std::size_t end);

  /// Makes the next call of word() begin within the word that it returned last.
  /// \pre `tail` is the end of that word
  void unread(std::string_view tail) {
    rest_ = {tail.data(), static_cast<std::size_t>(rest_.data() + rest_.size() - tail.data())};
  }

  /// The text after the current line.
  std::string_view remaining() const { return text_.substr(position_); }

  /// The next word of the current line; words are separated by blanks and tabs. Empty at the end of the line.
  std::string_view word();
  bool at_line_end();
  std::string_view rest() const { return rest_; }  ///< the rest of the current line
  void leave_line() { rest_ = {}; }                ///< skips it

  /// The next word as a finite number.
  /// \throw Error(input) naming `what`
  double number(std::string_view what);
  /// The next word as an integer >= 0.
  /// \throw Error(input) naming `what`
  std::uint64_t count(std::string_view what);
  /// The next word as an index below `size`, after subtraction of `base`.
  /// \throw Error(input) naming `what`
  std::uint32_t index(std::string_view what, std::size_t size, std::uint32_t base = 0);
  /// Refuses a line that has further words.
  /// \throw Error(input)
  void expect_line_end(std::string_view after);

  /// A bound of the number of remaining lines of at least `bytes` bytes, for reserving memory.
  std::size_t plausible(std::uint64_t announced, std::size_t bytes) const;

  const std::string& file() const { return file_; }
  std::size_t line() const { return line_number_; }  ///< number of the current line, from 1
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string file_;
  std::string_view text_;
  std::string_view rest_;
  std::size_t position_ = 0, line_begin_ = 0, line_number_ = 0;
  std::optional<char> comment_;  ///< none: the lines have no comments
};

/// True if two words are equal up to the case of ASCII letters.
bool same_word(std::string_view a, std::string_view b);

/// Letters of ASCII in lower case.
std::string lower(std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_FILES_TEXT_H
