// SPDX-License-Identifier: LGPL-3.0-or-later
// The state of a pickled environment: its compiled bytes and its report.
#include "pickling.h"

#include <cellwalk/environment/compiled.h>

#include <span>
#include <string_view>
#include <variant>

namespace cellwalk::python {

namespace py = pybind11;

std::vector<std::byte> compiled_bytes(const Shared_world& self) {
  return std::visit(
      []<int D>(const World<D>& world) {
        const typename World<D>::Reading reading(world);
        return compile_to_bytes<D>(reading.environment(), reading.certificate(), reading.groups());
      },
      *self.world);
}

void need_parts(const py::tuple& state, std::size_t count) {
  if (state.size() != count) throw py::value_error("this pickle is of another version of cellwalk");
}

void bind_pickles(Environment_class& environment) {
  environment.def(py::pickle(
      [](const Shared_world& self) {
        const std::vector<std::byte> bytes = compiled_bytes(self);
        return py::make_tuple(py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                              self.report);
      },
      [](const py::tuple& state) {
        need_parts(state, 2);
        const auto held = state[0].cast<py::bytes>();
        const std::string_view bytes = held;
        auto report = state[1].cast<std::string>();
        const py::gil_scoped_release released;
        Any_compiled_environment opened = open_compiled_copy(std::as_bytes(std::span(bytes)));
        return std::visit(
            [&](auto& compiled) {
              return std::make_shared<Shared_world>(share(std::move(compiled.environment),
                                                          compiled.certificate, std::move(report),
                                                          std::move(compiled.groups)));
            },
            opened);
      }));
}

}  // namespace cellwalk::python
