// SPDX-License-Identifier: LGPL-3.0-or-later
// The checks of types, shapes and indices of arrays, with errors that name the argument.
#include "arrays.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace cellwalk::python {
namespace {

bool is_number(const py::array& array) {
  const char kind = array.dtype().kind();
  return kind == 'i' || kind == 'u' || (kind == 'f' && array.itemsize() <= py::ssize_t{sizeof(double)});
}

bool is_integer(const py::array& array) { return array.dtype().kind() == 'i' || array.dtype().kind() == 'u'; }

/// True for what an empty list becomes.
bool is_empty_list(const py::array& array) { return array.ndim() == 1 && array.size() == 0; }

/// Only arrays of NumPy's own class cannot have a mask.
bool has_masked(const py::array& array) {
  const bool is_own = Py_TYPE(array.ptr()) == py::detail::npy_api::get().PyArray_Type_;
  return !is_own && py::hasattr(array, "mask") &&
         py::bool_(py::module_::import("numpy").attr("any")(array.attr("mask")));
}

/// Such as "float32 of shape (10, 3)", or the type of another object.
std::string description(const py::handle& argument) {
  const py::array array = as_array(argument);
  if (array.ndim() == 0) return std::string(py::str(py::type::of(argument).attr("__name__")));
  return fmt::format("{} of shape {}", std::string(py::str(array.dtype())), shape_text(array));
}

std::vector<std::int64_t> integers_of(const py::array& array) {
  const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  return {numbers.data(), numbers.data() + numbers.size()};
}

bool has_width(const Row_width& width, std::size_t columns) {
  return width.may_end_early ? columns >= width.least : columns >= width.least && columns <= width.most;
}

std::vector<std::uint32_t> numbers_of_mask(const py::array& mask, const char* name, std::size_t bound,
                                           const char* of) {
  if (mask.ndim() != 1 || static_cast<std::size_t>(mask.size()) != bound)
    throw Row_error(
        fmt::format("{} has shape {}: a mask of the {} has shape ({},)", name, shape_text(mask), of, bound));
  const auto is_chosen = py::array_t<bool, py::array::c_style>(mask);
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < bound; ++i)
    if (is_chosen.data()[i]) numbers.push_back(i);
  return numbers;
}

}  // namespace

void refuse_type(const std::string& name, const std::string& needed, const py::handle& argument) {
  throw py::type_error(fmt::format("{} must be {}, and is {}", name, needed, description(argument)));
}

void refuse_shape(const std::string& name, const std::string& shape, const std::string& needed) {
  throw Error(Error_code::input, fmt::format("{} has shape {}: {} is needed", name, shape, needed));
}

std::string shape_text(const py::handle& array) { return py::str(array.attr("shape")); }

py::array as_array(const py::handle& argument) {
  if (py::isinstance<py::array>(argument)) return py::reinterpret_borrow<py::array>(argument);
  return py::module_::import("numpy").attr("asarray")(argument);
}

Number_rows::Number_rows(const py::handle& argument, const char* name, int columns) {
  const py::array array = as_array(argument);
  if (has_masked(array))
    throw Error(Error_code::input, fmt::format("{} has masked values: fill them, or take the rest", name));
  if (!is_number(array)) refuse_type(name, "real numbers, as float64 holds them", argument);
  const bool fits = columns == 0 ? array.ndim() == 1
                                 : (array.ndim() == 2 && array.shape(1) == columns) || is_empty_list(array);
  if (!fits) refuse_shape(name, shape_text(array), columns == 0 ? "(N,)" : fmt::format("(N, {})", columns));
  kept_ = decltype(kept_)::ensure(array);
  if (!kept_) throw py::error_already_set();
  size_ = static_cast<std::size_t>(array.shape(0));
}

Radii::Radii(const py::handle& argument, std::size_t rows, const char* name_of_rows) {
  const auto check = [](double radius, const std::string& name) {
    if (!(radius >= 0 && std::isfinite(radius)))
      throw Error(Error_code::input,
                  fmt::format("{} must be a finite number of at least 0, and is {}", name, radius));
  };
  if (py::isinstance<py::float_>(argument)) {
    of_all_ = argument.cast<double>();
    check(of_all_, "radius");
    return;
  }
  const py::array array = as_array(argument);
  if (array.ndim() == 0) {
    if (!is_number(array)) refuse_type("radius", "a number, or an array of numbers", argument);
    of_all_ = array.attr("item")().cast<double>();
    check(of_all_, "radius");
    return;
  }
  each_.emplace(array, "radius", 0);
  if (each_->size() != rows)
    refuse_shape("radius", shape_text(array), fmt::format("({},), one for each of {},", rows, name_of_rows));
  for (std::size_t i = 0; i < rows; ++i) check(each_->data()[i], fmt::format("radius[{}]", i));
}

Index_table indices_of(const py::handle& argument, const std::string& name, const Row_width& width,
                       std::size_t bound) {
  const py::array array = as_array(argument);
  Index_table table;
  if (is_empty_list(array)) return table;
  if (!is_integer(array)) refuse_type(name, "integers", argument);
  if (array.ndim() != 2 || !has_width(width, static_cast<std::size_t>(array.shape(1))))
    refuse_shape(name, shape_text(array),
                 width.least == width.most ? fmt::format("(N, {})", width.least)
                                           : fmt::format("(N, k) with k from {}", width.least));
  const std::vector<std::int64_t> numbers = integers_of(array);
  const auto rows = static_cast<std::size_t>(array.shape(0)),
             columns = static_cast<std::size_t>(array.shape(1));
  table.indices.reserve(numbers.size());
  for (std::size_t i = 0; i < rows; ++i) {
    std::size_t count = columns;
    while (width.may_end_early && count > width.least && numbers[i * columns + count - 1] == -1) --count;
    for (std::size_t j = 0; j < count; ++j) {
      const std::int64_t number = numbers[i * columns + j];
      if (number < 0 || static_cast<std::uint64_t>(number) >= bound)
        throw Row_error(
            fmt::format("{}[{}, {}] is {}: there are {} points, numbered from 0", name, i, j, number, bound));
      table.indices.push_back(static_cast<std::uint32_t>(number));
    }
    table.begin.push_back(table.indices.size());
  }
  return table;
}

std::vector<std::uint32_t> numbers_of(const py::handle& argument, const char* name, std::size_t bound,
                                      const char* of) {
  const py::array array = as_array(argument);
  if (array.dtype().kind() == 'b') return numbers_of_mask(array, name, bound, of);
  if (is_empty_list(array)) return {};
  if (!is_integer(array))
    refuse_type(name, fmt::format("integers (N,), or a boolean mask ({},)", bound), argument);
  if (array.ndim() != 1) refuse_shape(name, shape_text(array), "(N,)");
  std::vector<std::uint32_t> indices;
  indices.reserve(static_cast<std::size_t>(array.size()));
  for (const std::int64_t number : integers_of(array)) {
    if (number < 0 || static_cast<std::uint64_t>(number) >= bound)
      throw Row_error(fmt::format("{}[{}] is {}: there are {} {}, numbered from 0", name, indices.size(),
                                  number, bound, of));
    indices.push_back(static_cast<std::uint32_t>(number));
  }
  return indices;
}

std::vector<std::uint32_t> distinct_numbers_of(const py::handle& argument, const char* name,
                                               std::size_t bound, const char* of) {
  std::vector<std::uint32_t> numbers = numbers_of(argument, name, bound, of);
  if (std::ranges::adjacent_find(numbers, std::greater_equal()) == numbers.end()) return numbers;
  std::vector<std::uint32_t> order(numbers.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t row) { return numbers[row]; });
  for (std::size_t k = 1; k < order.size(); ++k)
    if (const std::uint32_t first = order[k - 1], again = order[k]; numbers[first] == numbers[again])
      throw Error(Error_code::input, fmt::format("{0}[{1}] is {2}, as {0}[{3}] is: give each once", name,
                                                 again, numbers[again], first));
  return numbers;
}

std::string path_of(const py::handle& argument) {
  return py::str(py::module_::import("os").attr("fsdecode")(argument));
}

void refuse_rows(const char* name, std::size_t rows, std::size_t columns, std::size_t expected,
                 const char* of) {
  refuse_shape(name, fmt::format("({}, {})", rows, columns),
               fmt::format("({}, {}), a row for each of {},", expected, columns, of));
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
