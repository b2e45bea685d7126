// SPDX-License-Identifier: LGPL-3.0-or-later
// The extension module cellwalk._cellwalk; users import python/cellwalk/__init__.py.
#include "module.h"

#include <cellwalk/internal/io/build_features.h>
#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/query.h>

#include <pybind11/stl.h>

#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "signatures.h"

namespace cellwalk::python {
namespace {

namespace py = pybind11;

constexpr std::size_t row_error = 6;  ///< after the codes

/// The class of cellwalk._errors for each code; never freed, since exceptions may be raised until the
/// interpreter ends.
const py::object& error_class(std::size_t code) {
  static const auto* const classes = [] {
    const py::module_ errors = py::module_::import("cellwalk._errors");
    return new std::vector<py::object>{errors.attr("Error"),
                                       errors.attr("Error"),
                                       errors.attr("UsageError"),
                                       errors.attr("InputError"),
                                       errors.attr("NotCertifiedError"),
                                       errors.attr("OutsideError"),
                                       errors.attr("RowError")};
  }();
  return (*classes)[code];
}

py::dict build_features() {
  py::dict features;
  const Mesher_parts parts = mesher_parts();
  features["meshing"] = parts.meshing;
  features["tetgen"] = parts.tetgen;
  for (const io::Build_feature& feature : io::build_features())
    features[py::str(std::string(feature.name))] = feature.present;
  return features;
}

/// The common base of all classes has no C++ type, and pybind11 ends the process where somebody makes one:
/// pickling with old protocols does. Other modules may share the base: their classes are made as ever.
void refuse_objects_of_the_base() {
  static auto* const base = reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
  static const newfunc make = base->tp_new;
  base->tp_new = [](PyTypeObject* type, PyObject* arguments, PyObject* named) -> PyObject* {
    if (type != base) return make(type, arguments, named);
    PyErr_SetString(PyExc_TypeError, "the base of compiled classes has no objects");
    return nullptr;
  };
}

/// Objects without a value, made by `__new__` or used before `__init__`, would get memory with nothing in it
/// where pybind11 passes them on: they raise instead.
void refuse_objects_without_value(const py::module_& module) {
  for (const auto& [name, member] : py::dict(module.attr("__dict__"))) {
    if (!PyType_Check(member.ptr())) continue;
    auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(member.ptr()));
    if (type == nullptr) continue;
    type->operator_new = [](std::size_t) -> void* {
      throw py::type_error("this object was not made yet: call its class, or what returns objects of it");
    };
  }
}

}  // namespace

PYBIND11_MODULE(_cellwalk, module) {
  module.doc() = "The compiled part of cellwalk.";
  module.attr("__version__") = CELLWALK_VERSION;
  py::list names;
  for (const char* name : motion_status_names) names.append(name);
  module.attr("status_names") = py::tuple(names);
  error_class(0);
  refuse_objects_of_the_base();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Row_error& error) {
      PyErr_SetString(error_class(row_error).ptr(), error.what());
    } catch (const Error& error) {
      PyErr_SetString(error_class(static_cast<std::size_t>(error.code())).ptr(), error.what());
    }
  });
  bind_motions(module);
  bind_environment(module);
  bind_particles(module);
  bind_bodies(module);
  bind_traces(module);
  module.def("build_features", build_features,
             "The optional parts of this build by name, and whether it has them.");
  refuse_objects_without_value(module);
  give_signatures(module);
}

}  // namespace cellwalk::python
