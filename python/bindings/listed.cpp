// SPDX-License-Identifier: LGPL-3.0-or-later
// The conversion of Python sequences to the bodies and particles that a Reshaping holds.
#include "listed.h"

#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

namespace cellwalk::python {
namespace {

template <class Owner>
void list_all(const std::shared_ptr<Any_world>& world, const py::object& given, const char* name,
              const char* type, std::vector<py::object>& objects, std::vector<Owner*>& owners) {
  const auto type_name = [](const py::handle& object) {
    return std::string(py::str(py::type::of(object).attr("__name__")));
  };
  if (!py::isinstance<py::iterable>(given))
    throw py::type_error(fmt::format("{} is {}: a list of {} is needed", name, type_name(given), type));
  for (const py::handle item : given) {
    const std::size_t i = owners.size();
    if (!py::isinstance<Owner>(item))
      throw py::type_error(
          fmt::format("{}[{}] is {}: a list of {} is needed", name, i, type_name(item), type));
    Owner* const owner = item.cast<Owner*>();
    if (owner->world() != world)
      throw Error(Error_code::usage,
                  fmt::format("{}[{}] lies in another environment: list it where that changes", name, i));
    if (const auto first = std::find(owners.begin(), owners.end(), owner); first != owners.end())
      throw Error(Error_code::usage,
                  fmt::format("{0}[{1}] is {0}[{2}] again: list it once", name, i, first - owners.begin()));
    objects.push_back(py::reinterpret_borrow<py::object>(item));
    owners.push_back(owner);
  }
}

}  // namespace

Listed listed_of(const std::shared_ptr<Any_world>& world, const py::object& bodies,
                 const py::object& particles) {
  Listed listed;
  list_all(world, bodies, "bodies", "Body", listed.objects, listed.bodies);
  list_all(world, particles, "particles", "Particles", listed.objects, listed.particles);
  return listed;
}

}  // namespace cellwalk::python
