// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of types, shapes and indices of NumPy arrays, with errors that name the argument.
#include "arrays.h"

#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <cmath>

namespace cellwalk::python {
namespace {

/// Such as "float32 (10, 3)", or the type of another object.
std::string description(const py::handle& argument) {
  if (!py::isinstance<py::array>(argument))
    return std::string(py::str(py::type::of(argument).attr("__name__")));
  const auto array = py::reinterpret_borrow<py::array>(argument);
  return fmt::format("{} {}{}", std::string(py::str(array.dtype())),
                     std::string(py::str(array.attr("shape"))),
                     array.flags() & py::array::c_style ? "" : ", not C-contiguous");
}

/// The integers of an array of any integer type, and its shape.
/// \throw TypeError for another type, or another number of dimensions
std::pair<std::vector<std::int64_t>, std::vector<std::size_t>> integers_of(const py::handle& argument,
                                                                           const char* name, int dimensions) {
  const py::array array = py::array::ensure(argument);
  if (!array || array.ndim() != dimensions || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u'))
    throw py::type_error(fmt::format("{} must be an integer array of {}, and is {}", name,
                                     dimensions == 1 ? "one dimension" : "two dimensions",
                                     description(argument)));
  const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  return {std::vector<std::int64_t>(numbers.data(), numbers.data() + numbers.size()),
          std::vector<std::size_t>(array.shape(), array.shape() + dimensions)};
}

/// \throw ValueError that begins with place() if there is no such point
template <class Place>
std::uint32_t index_of(std::int64_t number, std::size_t bound, const Place& place) {
  if (number < 0 || static_cast<std::uint64_t>(number) >= bound)
    throw py::value_error(
        fmt::format("{} is {}: there are {} points, numbered from 0", place(), number, bound));
  return static_cast<std::uint32_t>(number);
}

}  // namespace

std::pair<const double*, std::size_t> rows_of(const py::handle& argument, const char* name, int columns) {
  constexpr int needed = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
  if (py::isinstance<py::array>(argument)) {
    const auto array = py::reinterpret_borrow<py::array>(argument);
    const bool is_float64 = array.dtype().equal(py::dtype::of<double>());
    if (is_float64 && array.ndim() == 2 && array.shape(1) == columns && (array.flags() & needed) == needed)
      return {static_cast<const double*>(array.data()), static_cast<std::size_t>(array.shape(0))};
  }
  throw py::type_error(fmt::format(
      "{0} must be a C-contiguous float64 array of shape (N, {1}), and is {2}; numpy.ascontiguousarray({0}, "
      "dtype=numpy.float64) makes one of numbers",
      name, columns, description(argument)));
}

Radii::Radii(const py::handle& argument, std::size_t rows, const char* name_of_rows) {
  const auto check = [](double radius, const std::string& name) {
    if (!(radius >= 0 && std::isfinite(radius)))
      throw py::value_error(fmt::format("{} must be a finite number of at least 0, and is {}", name, radius));
  };
  if (py::isinstance<py::float_>(argument) || py::isinstance<py::int_>(argument)) {
    of_all_ = py::cast<double>(argument);
    check(of_all_, "radius");
    return;
  }
  constexpr int needed = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
  const auto is_usable = [](const py::array& array) {
    return array.dtype().equal(py::dtype::of<double>()) && array.ndim() == 1 &&
           (array.flags() & needed) == needed;
  };
  if (!py::isinstance<py::array>(argument) || !is_usable(py::reinterpret_borrow<py::array>(argument)))
    throw py::type_error(
        fmt::format("radius must be a number or a C-contiguous float64 array of shape (N,), and is {}",
                    description(argument)));
  const auto array = py::reinterpret_borrow<py::array>(argument);
  each_ = {static_cast<const double*>(array.data()), static_cast<std::size_t>(array.shape(0))};
  need_equal(each_.size(), "radius", rows, name_of_rows);
  for (std::size_t i = 0; i < rows; ++i) check(each_[i], fmt::format("radius[{}]", i));
}

Index_table indices_of(const py::handle& argument, const char* name, std::size_t bound) {
  const auto [numbers, shape] = integers_of(argument, name, 2);
  Index_table table;
  table.rows = shape[0];
  table.columns = shape[1];
  table.indices.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    table.indices.push_back(index_of(numbers[i], bound, [&] {
      return fmt::format("{}[{}, {}]", name, i / table.columns, i % table.columns);
    }));
  return table;
}

std::vector<std::uint32_t> numbers_of(const py::handle& argument, const char* name, std::size_t bound) {
  const std::vector<std::int64_t> numbers = integers_of(argument, name, 1).first;
  std::vector<std::uint32_t> indices;
  indices.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    indices.push_back(index_of(numbers[i], bound, [&] { return fmt::format("{}[{}]", name, i); }));
  return indices;
}

void need_equal(std::size_t rows, const char* name, std::size_t expected, const char* expected_name) {
  if (rows != expected)
    throw py::value_error(fmt::format("{} has {} rows, and {} has {}: as many are needed", name, rows,
                                      expected_name, expected));
}

py::array view_of(const double* data, std::size_t rows, std::size_t columns, std::size_t stride,
                  const py::handle& owner) {
  py::array view(py::dtype::of<double>(), {rows, columns}, {stride, sizeof(double)}, data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

void refuse_word(const std::string& word, const char* option, const std::string& words) {
  throw Error(Error_code::usage, fmt::format("{} takes {}, not {}", option, words, word));
}

}  // namespace cellwalk::python
