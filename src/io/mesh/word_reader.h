// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a text as words, wherever its lines end.
#ifndef CELLWALK_IO_MESH_WORD_READER_H
#define CELLWALK_IO_MESH_WORD_READER_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/text.h"

namespace cellwalk::io {

class Word_reader {
 public:
  Word_reader(const std::string& name, std::string_view text, std::optional<char> comment)
      : in_(name, text, comment) {}

  /// True if there is a further word.
  bool has_word();
  /// The next word.
  /// \throw Error(input) naming `what` at the end of the text; the same of the functions below
  std::string_view word(std::string_view what);
  std::string_view peek(std::string_view what);  ///< the same word as word(), which stays the next one
  std::int64_t integer(std::string_view what);   ///< out of range: the largest
  /// A finite coordinate. The exponent may be written with D, as Fortran does.
  double coordinate(std::string_view what);

  /// The rest of the current line, or the next line if it is at its end.
  std::string_view rest_of_line(std::string_view what);
  bool at_line_end() { return in_.at_line_end(); }
  void leave_line() { in_.leave_line(); }

  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }

 private:
  Line_reader in_;
  std::optional<std::string_view> peeked_;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_WORD_READER_H
