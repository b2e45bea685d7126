// SPDX-License-Identifier: LGPL-3.0-or-later
// NumPy arrays as the library sees them: read where they lie, or refused; results are views or new arrays
// that the caller owns.
#ifndef CELLWALK_PYTHON_ARRAYS_H
#define CELLWALK_PYTHON_ARRAYS_H

#include <cellwalk/kernel/point.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::python {

namespace py = pybind11;

/// The rows of a C-contiguous, aligned float64 array of shape (N, columns); its first element and N.
/// \throw TypeError that names the type of the argument, and how to convert it
std::pair<const double*, std::size_t> rows_of(const py::handle& argument, const char* name, int columns);

/// The points of an array, without a copy.
/// \pre the argument outlives the span
template <int D>
std::span<const Point<D>> points_of(const py::handle& argument, const char* name) {
  static_assert(sizeof(Point<D>) == D * sizeof(double));
  const auto [data, rows] = rows_of(argument, name, D);
  return {reinterpret_cast<const Point<D>*>(data), rows};
}

/// Indices of an integer array of two dimensions, copied: any integer type, each index below `bound`.
/// \throw TypeError if it is something else, ValueError naming the first index out of range
struct Index_table {
  std::vector<std::uint32_t> indices;
  std::size_t rows = 0, columns = 0;
  std::span<const std::uint32_t> row(std::size_t i) const { return {indices.data() + i * columns, columns}; }
};
Index_table indices_of(const py::handle& argument, const char* name, std::size_t bound);

/// Indices of an integer array of one dimension, copied, likewise.
std::vector<std::uint32_t> numbers_of(const py::handle& argument, const char* name, std::size_t bound);

/// The radius of all rows, or that of each.
class Radii {
 public:
  /// \param argument a number, or an array of as many as there are rows, which outlives the radii
  /// \param name_of_rows for messages
  /// \throw TypeError for something else; ValueError for another number of them, or one that is not a finite
  ///        number of at least 0
  Radii(const py::handle& argument, std::size_t rows, const char* name_of_rows);
  double operator[](std::size_t row) const { return each_.empty() ? of_all_ : each_[row]; }
  /// One for all rows, or one for each.
  std::span<const double> values() const { return each_.empty() ? std::span(&of_all_, 1) : each_; }
  bool are_all_0() const { return each_.empty() && of_all_ == 0; }

 private:
  double of_all_ = 0;
  std::span<const double> each_;
};

/// \throw ValueError unless both arrays have as many rows
void need_equal(std::size_t rows, const char* name, std::size_t expected, const char* expected_name);

/// A read-only view of memory that `owner` keeps alive: shape (rows, columns), rows `stride` bytes apart.
py::array view_of(const double* data, std::size_t rows, std::size_t columns, std::size_t stride,
                  const py::handle& owner);

/// An array that owns the values of a vector.
template <class T>
py::array_t<T> to_array(std::vector<T>&& values) {
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return py::array_t<T>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

[[noreturn]] void refuse_word(const std::string& word, const char* option, const std::string& words);

/// The meaning of a word.
/// \throw UsageError that names the possible words
template <class T>
T choose(const std::string& word, const char* option,
         std::initializer_list<std::pair<const char*, T>> meanings) {
  std::string words;
  for (const auto& [name, meaning] : meanings) {
    if (word == name) return meaning;
    words += (words.empty() ? "" : ", ") + std::string(name);
  }
  refuse_word(word, option, words);
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_ARRAYS_H
