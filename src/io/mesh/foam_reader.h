// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the text of a file of OpenFOAM as words and numbers, and the binary values between them.
#ifndef CELLWALK_IO_MESH_FOAM_READER_H
#define CELLWALK_IO_MESH_FOAM_READER_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cellwalk::io {

class Foam_reader {
 public:
  /// Reads the header. Refers to the bytes, which must outlive it.
  /// \param file its name in errors
  /// \throw Error(input) if there is none, or it announces what is not read; as all functions below with the
  ///        line, or in a binary file the byte
  Foam_reader(std::string file, std::string_view bytes);

  const std::string& file() const { return file_; }
  const std::string& type() const { return type_; }  ///< the class that the header names
  bool is_binary() const { return is_binary_; }

  /// The next word, text in quotes (without them) or one of (){};
  /// \throw Error(input) naming `what` at the end of the file; the same of the functions below
  std::string_view token(std::string_view what);
  /// True if the next token is this character, which is taken then.
  bool takes(char c);
  /// Takes this character.
  void expect(char c, std::string_view what);
  std::int64_t integer(std::string_view what);
  double real(std::string_view what);  ///< finite

  /// The number of entries of a list, which is text in binary files, too.
  std::size_t count(std::string_view what);
  /// Refuses a number of entries that take more bytes than follow.
  void expect_room(std::size_t count, std::string_view what, std::size_t bytes_each) const;

  /// The bytes of a binary list of labels, or of vectors, between its parentheses; none if it is empty.
  /// Where the header does not say how wide numbers are, as in older versions, the end of the list does.
  std::string_view labels(std::size_t count, std::string_view what);
  std::string_view vectors(std::size_t count, std::string_view what);
  std::size_t label_bytes() const { return label_bytes_; }    ///< 4 or 8, of the list read last
  std::size_t scalar_bytes() const { return scalar_bytes_; }  ///< 4 or 8
  std::int64_t label_at(const char* bytes) const;
  double scalar_at(const char* bytes) const;

  /// Takes the rest of an entry: tokens up to a semicolon, or all between braces.
  void skip_entry();

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void read_header();
  void read_architecture(std::string_view text);
  void skip_blanks();
  void skip_raw(std::string_view type);
  bool ends_after(std::size_t count, std::size_t bytes_each);
  std::string_view block(std::size_t count, std::string_view what, std::size_t bytes_each);
  std::string_view rest() const { return bytes_.substr(at_); }

  std::string file_;
  std::string_view bytes_;
  std::size_t at_ = 0, token_ = 0;  ///< the next byte; where the last token begins
  std::string type_;
  bool is_binary_ = false, is_swapped_ = false, knows_widths_ = false;
  std::size_t label_bytes_ = 4, scalar_bytes_ = 8;  ///< where the header does not say it
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FOAM_READER_H
