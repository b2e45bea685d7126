// SPDX-License-Identifier: LGPL-3.0-or-later
// The arrays of a snapshot: they have memory of their own, or lie in memory that somebody else holds, such as
// a file that is mapped.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_FLAT_ARRAY_H
#define CELLWALK_INTERNAL_ENVIRONMENT_FLAT_ARRAY_H

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// An array of values that can be copied byte by byte. Reading costs the same wherever its memory is. Memory
/// of others is written in place; growth beyond it moves the array into memory of its own. A copy has its
/// own.
template <class T>
class Flat_array {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Flat_array() = default;
  /// Lies in memory that lasts as long as the owner is held.
  Flat_array(std::span<T> memory, std::shared_ptr<const void> owner)
      : owner_(std::move(owner)), data_(memory.data()), size_(memory.size()) {}
  Flat_array(const Flat_array& other) : own_(other.begin(), other.end()) { follow(); }
  Flat_array(Flat_array&& other) noexcept { swap(other); }
  Flat_array& operator=(Flat_array other) noexcept {
    swap(other);
    return *this;
  }
  Flat_array& operator=(std::vector<T> values) noexcept {
    own_ = std::move(values);
    owner_.reset();
    follow();
    return *this;
  }
  ~Flat_array() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  const T* begin() const { return data_; }
  T* end() { return data_ + size_; }
  const T* end() const { return data_ + size_; }
  /// The bytes of its own memory; memory of others is not counted.
  std::size_t own_bytes() const { return own_.capacity() * sizeof(T); }

  void resize(std::size_t size) {
    own(size);
    own_.resize(size);
    follow();
  }
  void push_back(const T& value) {
    const T kept = value;  // which may lie in this array
    own(size_ + 1);
    own_.push_back(kept);
    follow();
  }

 private:
  void swap(Flat_array& other) noexcept {
    own_.swap(other.own_);
    owner_.swap(other.owner_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  void follow() {
    data_ = own_.data();
    size_ = own_.size();
  }
  /// Moves the array out of the memory of others, with room for `size` values.
  void own(std::size_t size) {
    if (!owner_) return;
    std::vector<T> values;
    values.reserve(std::max(size, size_));
    values.assign(begin(), end());
    *this = std::move(values);
  }

  std::vector<T> own_;
  std::shared_ptr<const void> owner_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_FLAT_ARRAY_H
