// SPDX-License-Identifier: LGPL-3.0-or-later
// The properties of a batch of motions in Python, and its counts as dictionaries.
#include "motions.h"

#include <algorithm>
#include <limits>

#include "module.h"

namespace cellwalk::python {

const py::object& Motions::cell_numbers() {
  if (!cell.is_none()) return cell;
  py::array_t<std::int32_t> numbers(handles.size());
  const std::uint32_t* handle = handles.data();
  std::int32_t* number = numbers.mutable_data();
  std::visit(
      [&]<int D>(const World<D>& chosen) {
        const typename World<D>::Reading reading(chosen);
        for (std::size_t i = 0; i < size(); ++i) number[i] = number_of(reading.snapshot(), Cell{handle[i]});
      },
      *world);
  return cell = std::move(numbers);
}

const py::object& Motions::times() {
  if (!time.is_none()) return time;
  py::array_t<double> all(handles.size());
  const std::uint32_t* const handle = handles.data();
  double* const when = all.mutable_data();
  for (std::size_t i = 0; i < size(); ++i)
    when[i] = Cell{handle[i]} == Cell::none ? std::numeric_limits<double>::quiet_NaN() : 1;
  for (const auto& [row, at] : stops) when[row] = at;
  return time = std::move(all);
}

const py::object& Motions::distances() {
  if (!distance.is_none()) return distance;
  py::array_t<double> all(status.size());
  double* const how_far = all.mutable_data();
  std::fill_n(how_far, size(), std::numeric_limits<double>::quiet_NaN());
  for (const auto& [row, at] : close) how_far[row] = at;
  return distance = std::move(all);
}

py::dict to_dict(const Walk_counts& counts) {
  py::dict result = to_dict<Walk_counts>(counts);
  for (const auto& [name, count] : named_counts(counts.predicates)) result[py::str(name)] = count;
  return result;
}

py::dict to_dict(const Edge_counts& counts) {
  py::dict result = to_dict<Edge_counts>(counts);
  result["walk"] = to_dict(counts.walk);
  return result;
}

void bind_motions(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(Contact_row_2, row, time, point, normal, kind, body, cell, facet);
  PYBIND11_NUMPY_DTYPE(Contact_row_3, row, time, point, normal, kind, body, cell, facet);
  py::class_<Motions>(module, "Motions", "The results of a batch of motions, row by row.")
      .def_readonly("status", &Motions::status, "uint8 (N,): codes of Status.")
      .def_property_readonly(
          "time", [](Motions& motions) { return motions.times(); },
          "float64 (N,): the fraction of the motion that is free; 1 if it arrives, NaN if it was not made.")
      .def_property_readonly(
          "distance", [](Motions& motions) { return motions.distances(); },
          "float64 (N,): how far a start that is closer to a wall than its radius (Status.CLOSE) is from the "
          "nearest one, rounded down; NaN in other rows.")
      .def_readonly("cells", &Motions::cells,
                    "uint32 (N,): the number of cells that the moving point visited.")
      .def_readonly(
          "contacts", &Motions::contacts,
          "A structured array with a row for each contact, in the order of `row`: row, time, point, normal "
          "(unit, on the free side), kind (Feature of the environment), body (Feature of the moving object), "
          "cell and facet (the wall, as the number of a facet of the cell). A start that is closer than its "
          "radius has a row with the nearest point of the walls, the time NaN and the normal 0.")
      .def_readonly("counts", &Motions::counts, "The machine-independent counts of the batch.")
      .def_property_readonly(
          "cell", [](Motions& motions) { return motions.cell_numbers(); },
          "int32 (N,): the cell in which the motion ends, numbered as in the file; -1 if it was not made.")
      .def("__len__", &Motions::size)
      .def("__repr__", [](const Motions& motions) {
        return "<cellwalk.Motions of " + std::to_string(motions.size()) + " rows, " +
               std::to_string(motions.contacts.shape(0)) + " contacts>";
      });
}

}  // namespace cellwalk::python
