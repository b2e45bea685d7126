// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces and tallies: the cells that motions cross, with the lengths in them, and sums of these by cell.
#ifndef CELLWALK_PYTHON_TRACES_H
#define CELLWALK_PYTHON_TRACES_H

#include <cstddef>
#include <cstdint>
#include <memory>

#include "arrays.h"

namespace cellwalk::python {

/// Memory that is not written before it gets its values. Needs no interpreter.
template <class T>
struct Buffer {
  explicit Buffer(std::size_t count) : values(std::make_unique_for_overwrite<T[]>(count)), size(count) {}
  std::unique_ptr<T[]> values;
  std::size_t size;
};

/// An array that owns the values of a buffer.
template <class T>
py::array_t<T> to_array(Buffer<T>&& buffer) {
  const py::capsule owner(buffer.values.get(), [](void* values) { delete[] static_cast<T*>(values); });
  return py::array_t<T>(static_cast<py::ssize_t>(buffer.size), buffer.values.release(), owner);
}

/// The class Traces of Python.
struct Trace_arrays {
  py::array_t<std::int64_t> offsets, surface_offsets;
  py::array_t<std::int32_t> cells, surfaces, cell, wall;
  py::array_t<double> lengths;
  py::array heading;
  py::array_t<bool> forward;
  py::array_t<std::uint8_t> status;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_TRACES_H
