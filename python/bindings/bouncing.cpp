// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups of walls by their names, or by rows of facets.
#include "bouncing.h"

#include <fmt/core.h>

namespace cellwalk::python {
namespace {

/// \throw TypeError
py::sequence sequence_of(const py::handle& argument, const char* name, const char* of) {
  if (!py::isinstance<py::sequence>(argument) || py::isinstance<py::str>(argument))
    throw py::type_error(fmt::format("{} must be a list of {}", name, of));
  return py::reinterpret_borrow<py::sequence>(argument);
}

/// Gives errors the place of the argument.
template <class Work>
void at(const std::string& place, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    throw Error(error.code(), place + ": " + error.what());
  }
}

}  // namespace

Bouncing::Walls Bouncing::walls_of(const py::handle& argument, const char* name) {
  if (py::isinstance<py::str>(argument)) return argument.cast<std::string>();
  return Named_facets(argument, name);
}

Bouncing::Bouncing(const py::object& reflect, const py::object& periodic, int most_bounces)
    : most_bounces_(most_bounces) {
  constexpr const char* pairs = "pairs of groups";
  for (const py::handle walls : sequence_of(reflect, "reflect", "groups"))
    reflecting_.push_back(walls_of(walls, "reflect"));
  for (const py::handle pair : sequence_of(periodic, "periodic", pairs)) {
    const py::sequence both = sequence_of(pair, "periodic", pairs);
    if (py::len(both) != 2) throw py::type_error(fmt::format("periodic must be a list of {}", pairs));
    periodic_.emplace_back(walls_of(py::object(both[0]), "periodic"),
                           walls_of(py::object(both[1]), "periodic"));
  }
  if (most_bounces < 0)
    throw Error(Error_code::usage, fmt::format("most_bounces takes a number from 0, not {}", most_bounces));
}

template <int D>
std::vector<Half_facet> Bouncing::find(const typename World<D>::Reading& reading, const Walls& walls) {
  if (const auto* const named = std::get_if<Named_facets>(&walls)) {
    std::vector<Half_facet> facets;
    for (std::size_t i = 0; i < named->size(); ++i) {
      const Half_facet facet = named->find(reading.snapshot(), i);
      if (facet == Half_facet::none)
        throw Error(Error_code::input, fmt::format("other cells replaced that of facet {}", i));
      facets.push_back(facet);
    }
    return facets;
  }
  const auto& name = std::get<std::string>(walls);
  const Groups<D> groups = reading.groups();
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second.facets;
  std::string names;
  for (const auto& [known, selection] : groups) names += (names.empty() ? "" : ", ") + known;
  throw Error(Error_code::input, fmt::format("there is no group \"{}\": the environment has {}", name,
                                             names.empty() ? "none" : names));
}

template <int D>
Boundary_tracer<D> Bouncing::boundary(const typename World<D>::Reading& reading) const {
  Boundary_tracer<D> made(reading.snapshot(), reading.tracing().tracer, reading.locator());
  for (std::size_t i = 0; i < reflecting_.size(); ++i)
    at(fmt::format("reflect[{}]", i), [&] { made.reflect(find<D>(reading, reflecting_[i])); });
  for (std::size_t i = 0; i < periodic_.size(); ++i)
    at(fmt::format("periodic[{}]", i),
       [&] { made.join(find<D>(reading, periodic_[i].first), find<D>(reading, periodic_[i].second)); });
  return made;
}

template Boundary_tracer<2> Bouncing::boundary(const World<2>::Reading&) const;
template Boundary_tracer<3> Bouncing::boundary(const World<3>::Reading&) const;

}  // namespace cellwalk::python
