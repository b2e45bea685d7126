// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: numbers in binary files, read with a check of the end, and written.
#ifndef CELLWALK_IO_FILES_BINARY_H
#define CELLWALK_IO_FILES_BINARY_H

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "text.h"

namespace cellwalk::io {

class Binary_reader {
 public:
  Binary_reader(std::string file, std::string_view bytes, bool big_endian)
      : file_(std::move(file)),
        rest_(bytes),
        swap_(big_endian == (std::endian::native == std::endian::little)) {}

  /// The next number.
  /// \throw Error(input) naming `what` at the end of the bytes
  template <class T>
  T take(const char* what) {
    if (rest_.size() < sizeof(T))
      fail(std::string("the file ends where ") + what + " should be: it is cut short");
    char bytes[sizeof(T)];
    std::copy_n(rest_.data(), sizeof(T), bytes);
    if (swap_) std::reverse(bytes, bytes + sizeof(T));
    rest_.remove_prefix(sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  /// The next bytes, as they are.
  /// \pre this number of bytes is left
  std::string_view take_bytes(std::size_t count) {
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }

  std::size_t left() const { return rest_.size(); }
  void skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }
  [[noreturn]] void fail(const std::string& what) const { io::fail(file_, what); }

 private:
  std::string file_;
  std::string_view rest_;
  bool swap_;
};

/// The bytes of values in memory, for writing.
template <class T>
std::string_view bytes_of(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}
template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return bytes_of(values.data(), values.size());
}

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_FILES_BINARY_H
