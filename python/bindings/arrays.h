// SPDX-License-Identifier: LGPL-3.0-or-later
// Arrays as the library sees them: float64 in C order is read where it lies, other numbers are copied or
// refused; results are views or new arrays that the caller owns.
#ifndef CELLWALK_PYTHON_ARRAYS_H
#define CELLWALK_PYTHON_ARRAYS_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/point.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::python {

namespace py = pybind11;

/// A row, vertex, point or cell that does not exist: RowError of Python.
struct Row_error : Error {
  explicit Row_error(const std::string& message) : Error(Error_code::input, message) {}
};

[[noreturn]] void refuse_type(const std::string& name, const std::string& needed, const py::handle& argument);
[[noreturn]] void refuse_shape(const std::string& name, const std::string& shape, const std::string& needed);

/// Such as "(4, 3)".
std::string shape_text(const py::handle& array);

/// Anything of which numpy.asarray() makes an array.
/// \throw what NumPy raises
py::array as_array(const py::handle& argument);

/// Real numbers in rows.
class Number_rows {
 public:
  /// \param columns 0 for an array of one dimension
  /// \throw TypeError for what float64 cannot hold, InputError that names both shapes
  Number_rows(const py::handle& argument, const char* name, int columns);
  const double* data() const { return kept_.data(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr int flags =
      int{py::array::c_style} | int{py::array::forcecast} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
  py::array_t<double, flags> kept_;
  std::size_t size_;
};

/// The points of an array, a range for as long as this lives. Destroyed with the interpreter.
template <int D>
class Points {
 public:
  Points(const py::handle& argument, const char* name) : rows_(argument, name, D) {}
  const Point<D>* data() const { return reinterpret_cast<const Point<D>*>(rows_.data()); }
  std::size_t size() const { return rows_.size(); }
  const Point<D>& operator[](std::size_t row) const { return data()[row]; }
  const Point<D>* begin() const { return data(); }
  const Point<D>* end() const { return data() + size(); }

 private:
  static_assert(sizeof(Point<D>) == D * sizeof(double));
  Number_rows rows_;
};

template <int D>
Points<D> points_of(const py::handle& argument, const char* name) {
  return {argument, name};
}

/// One point.
/// \throw as Number_rows
template <int D>
Point<D> point_of(const py::handle& argument, const char* name) {
  const Number_rows numbers(argument, name, 0);
  if (numbers.size() != D) refuse_shape(name, shape_text(as_array(argument)), D == 2 ? "(2,)" : "(3,)");
  Point<D> point;
  std::copy_n(numbers.data(), D, point.begin());
  return point;
}

/// Rows of indices, copied.
struct Index_table {
  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> begin{0};  ///< of each row, and the end of the last
  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> row(std::size_t i) const {
    return {indices.data() + begin[i], indices.data() + begin[i + 1]};
  }
};

/// The width of a table: rows of exactly, or of at least so many indices. Rows of different lengths end with
/// -1, where they may.
struct Row_width {
  std::size_t least, most;
  bool may_end_early = false;
};
constexpr Row_width polygons{3, 0, true};

/// Indices of points in an array of two dimensions and any integer type.
/// \throw TypeError if it is something else, InputError that names both shapes, RowError naming the first
///        index of none of the `bound` points
Index_table indices_of(const py::handle& argument, const std::string& name, const Row_width& width,
                       std::size_t bound);

/// Some of `bound` rows: by integers from 0, as -1 stands for none elsewhere, or by a boolean mask.
/// \param of for messages, such as "particles"
/// \throw TypeError if it is something else, RowError naming the first that does not exist
std::vector<std::uint32_t> numbers_of(const py::handle& argument, const char* name, std::size_t bound,
                                      const char* of);
/// The same, each of them once.
/// \throw InputError for one that is given twice
std::vector<std::uint32_t> distinct_numbers_of(const py::handle& argument, const char* name,
                                               std::size_t bound, const char* of);

/// The path that an argument names.
/// \throw TypeError unless it is a str, bytes or os.PathLike
std::string path_of(const py::handle& argument);

/// The radius of all rows, or that of each.
class Radii {
 public:
  /// \param argument a number, or as many as there are rows
  /// \param name_of_rows for messages
  /// \throw TypeError for something else; InputError for another number of them, or one that is not a finite
  ///        number of at least 0
  Radii(const py::handle& argument, std::size_t rows, const char* name_of_rows);
  double operator[](std::size_t row) const { return each_ ? each_->data()[row] : of_all_; }
  bool is_one_for_all() const { return !each_; }
  /// One for all rows, or one for each.
  std::span<const double> values() const {
    return each_ ? std::span(each_->data(), each_->size()) : std::span(&of_all_, 1);
  }
  bool are_all_0() const { return !each_ && of_all_ == 0; }

 private:
  double of_all_ = 0;
  std::optional<Number_rows> each_;
};

[[noreturn]] void refuse_rows(const char* name, std::size_t rows, std::size_t columns, std::size_t expected,
                              const char* of);

/// \param of what has `expected` rows, for the message
/// \throw InputError that names both shapes, unless there are as many points
template <int D>
void need_rows(const Points<D>& points, const char* name, std::size_t expected, const char* of) {
  if (points.size() != expected) refuse_rows(name, points.size(), D, expected, of);
}

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
