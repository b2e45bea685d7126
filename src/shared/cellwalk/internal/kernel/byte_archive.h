// SPDX-License-Identifier: LGPL-3.0-or-later
// Values as bytes of this machine, written and read by the same enumeration of their parts: for states that
// are saved and taken up again, and for messages among processes.
//
// A class has `template <class Archive> void archive(Archive& a) { a(first_, second_, ...); }`, or there is a
// function visit_parts(a, value) in its namespace or in detail. Archive::is_reading distinguishes the
// directions.
#ifndef CELLWALK_INTERNAL_KERNEL_BYTE_ARCHIVE_H
#define CELLWALK_INTERNAL_KERNEL_BYTE_ARCHIVE_H

#include <cellwalk/internal/kernel/counts.h>
#include <cellwalk/kernel/error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk::detail {

/// True for types that are copied as they lie in memory: numbers, and structs of counts, which have no
/// padding.
template <class T>
struct Is_plain : std::bool_constant<std::is_arithmetic_v<T> || std::is_enum_v<T> || Count_set<T>> {};
template <class T, std::size_t N>
struct Is_plain<std::array<T, N>> : Is_plain<T> {};
template <class T>
constexpr bool is_plain = Is_plain<T>::value&& std::is_trivially_copyable_v<T>;

template <class T>
constexpr bool is_pair = false;
template <class A, class B>
constexpr bool is_pair<std::pair<A, B>> = true;
template <class T>
constexpr bool is_array = false;
template <class T, std::size_t N>
constexpr bool is_array<std::array<T, N>> = true;
template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;
template <class T>
constexpr bool is_variant = false;
template <class... T>
constexpr bool is_variant<std::variant<T...>> = true;
/// Of values that lie one after the other, and grow at the end: vectors of any library, and strings.
template <class T>
concept Sequence = requires(T& list) {
  list.data();
  list.resize(std::size_t{});
};
template <class T>
concept Sorted = requires(T& list) {
  typename T::key_type;
  typename T::value_type;
  list.insert(std::declval<typename T::value_type>());
};

class Byte_writer {
 public:
  static constexpr bool is_reading = false;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// A list, of whose items the function visits the parts.
  template <class T, class Visit>
  void list(std::vector<T>& items, const Visit& visit) {
    put_count(items.size());
    for (T& item : items) visit(item);
  }
  void put_bytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }
  /// The same as a message.
  std::string message() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }

 private:
  template <class T>
  void put_plain(const T* values, std::size_t count) {
    put_bytes(std::as_bytes(std::span(values, count)));
  }
  void put_count(std::size_t count) {
    const auto wide = static_cast<std::uint64_t>(count);
    put_plain(&wide, 1);
  }
  template <class T>
  void put(const T& value) {
    if constexpr (is_plain<T>) {
      put_plain(&value, 1);
    } else if constexpr (is_pair<T>) {
      (*this)(value.first, value.second);
    } else if constexpr (is_array<T>) {
      for (const auto& item : value) put(item);
    } else if constexpr (is_optional<T>) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (is_variant<T>) {
      put_count(value.index());
      std::visit([&](const auto& chosen) { put(chosen); }, value);
    } else if constexpr (Sequence<T>) {
      put_count(value.size());
      if constexpr (is_plain<typename T::value_type>)
        put_plain(value.data(), value.size());
      else
        for (const auto& item : value) put(item);
    } else if constexpr (Sorted<T>) {
      put_count(value.size());
      for (const auto& item : value) put(item);
    } else {
      T& parts = const_cast<T&>(value);  // of which a writer only reads
      if constexpr (requires { parts.archive(*this); })
        parts.archive(*this);
      else
        visit_parts(*this, parts);
    }
  }

  std::vector<std::byte> bytes_;
};

/// Reads the bytes that a Byte_writer wrote. All functions throw Error(input) where the bytes end before, or
/// cannot be those of such a value.
class Byte_reader {
 public:
  static constexpr bool is_reading = true;

  explicit Byte_reader(std::span<const std::byte> bytes) : rest_(bytes) {}
  explicit Byte_reader(std::string_view message) : rest_(std::as_bytes(std::span(message))) {}

  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  template <class T>
  T next() {
    T value{};
    take(value);
    return value;
  }
  /// A list, of whose items the function visits the parts.
  template <class T, class Visit>
  void list(std::vector<T>& items, const Visit& visit) {
    items.resize(take_count(1));
    for (T& item : items) visit(item);
  }
  /// The next bytes, where they lie.
  std::span<const std::byte> take_bytes(std::size_t count) {
    if (count > rest_.size()) refuse();
    const auto bytes = rest_.first(count);
    rest_ = rest_.subspan(count);
    return bytes;
  }
  std::span<const std::byte> take_rest() { return take_bytes(rest_.size()); }
  bool is_at_end() const { return rest_.empty(); }
  void expect_end() const {
    if (!rest_.empty()) refuse();
  }
  [[noreturn]] static void refuse() {
    throw Error(
        Error_code::input,
        "a saved state, or what another process sent, is damaged: it is not what this program writes");
  }

 private:
  template <class T>
  void take_plain(T* values, std::size_t count) {
    const auto bytes = take_bytes(count * sizeof(T));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(values), bytes.data(), bytes.size());
  }
  /// A number of items, of which each takes at least this number of bytes.
  std::size_t take_count(std::size_t least) {
    std::uint64_t wide = 0;
    take_plain(&wide, 1);
    if (wide > rest_.size() / least) refuse();
    return static_cast<std::size_t>(wide);
  }
  template <class Variant, std::size_t I = 0>
  void take_variant(Variant& value, std::size_t index) {
    if constexpr (I < std::variant_size_v<Variant>) {
      if (index != I) return take_variant<Variant, I + 1>(value, index);
      take(value.template emplace<I>());
    } else {
      refuse();
    }
  }
  template <class T>
  void take(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = std::to_integer<unsigned>(take_bytes(1)[0]) != 0;
    } else if constexpr (is_plain<T>) {
      take_plain(&value, 1);
    } else if constexpr (is_pair<T>) {
      (*this)(value.first, value.second);
    } else if constexpr (is_array<T>) {
      for (auto& item : value) take(item);
    } else if constexpr (is_optional<T>) {
      value.reset();
      if (next<bool>()) take(value.emplace());
    } else if constexpr (is_variant<T>) {
      std::uint64_t index = 0;
      take_plain(&index, 1);
      take_variant(value, static_cast<std::size_t>(index));
    } else if constexpr (Sequence<T>) {
      using Item = typename T::value_type;
      const std::size_t count = take_count(is_plain<Item> ? sizeof(Item) : 1);
      value.resize(count);
      if constexpr (is_plain<Item>)
        take_plain(value.data(), count);
      else
        for (auto& item : value) take(item);
    } else if constexpr (Sorted<T>) {
      value.clear();
      for (std::size_t left = take_count(1); left > 0; --left) value.insert(value.end(), next_of(value));
    } else if constexpr (requires { value.archive(*this); }) {
      value.archive(*this);
    } else {
      visit_parts(*this, value);
    }
  }
  template <class Key, class Value>
  std::pair<Key, Value> next_of(const std::map<Key, Value>&) {
    return next<std::pair<Key, Value>>();
  }
  template <class Key>
  Key next_of(const std::set<Key>&) {
    return next<Key>();
  }

  std::span<const std::byte> rest_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_BYTE_ARCHIVE_H
