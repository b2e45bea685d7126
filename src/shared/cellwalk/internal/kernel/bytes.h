// SPDX-License-Identifier: LGPL-3.0-or-later
// Values as bytes, for copies of this program on machines of the same kind.
#ifndef CELLWALK_INTERNAL_KERNEL_BYTES_H
#define CELLWALK_INTERNAL_KERNEL_BYTES_H

#include <cellwalk/kernel/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cellwalk {

/// Appends values as they lie in memory; lists and texts begin with their length.
class Byte_writer {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void list(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  template <class T>
  void list(const std::vector<T>& values) {
    list(std::span<const T>(values));
  }
  void text(std::string_view text) { list(std::span(text.data(), text.size())); }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a Byte_writer wrote, in the same order. Refers to the bytes, which must outlive it.
class Byte_reader {
 public:
  explicit Byte_reader(std::string_view bytes) : bytes_(bytes) {}

  /// \throw Error(other) if the bytes end
  template <class T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, next(sizeof value), sizeof value);
    return value;
  }
  /// \throw Error(other) if the bytes end
  template <class T>
  std::vector<T> list() {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto size = value<std::uint64_t>();
    if (size > bytes_.size() / sizeof(T)) end();
    std::vector<T> values(size);
    if (size > 0) std::memcpy(values.data(), next(size * sizeof(T)), size * sizeof(T));
    return values;
  }
  /// \throw Error(other) if the bytes end
  std::string_view text() {
    const auto size = value<std::uint64_t>();
    return {next(size), size};
  }

 private:
  [[noreturn]] static void end() { throw Error(Error_code::other, "bytes of another process are cut short"); }
  const char* next(std::size_t size) {
    if (size > bytes_.size()) end();
    const char* const begin = bytes_.data();
    bytes_.remove_prefix(size);
    return begin;
  }

  std::string_view bytes_;
};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_BYTES_H
