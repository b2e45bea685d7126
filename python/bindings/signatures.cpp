// SPDX-License-Identifier: LGPL-3.0-or-later
// The first line of the docstring of a compiled function, as CPython reads a signature from it:
//
//     move(self: cellwalk._cellwalk.Particles, targets: object, *, threads: int = 0) -> ...
//     move(self, targets, *, threads=0)
//     --
//
// CPython hides these lines in `__doc__`, and types have no place in them: they are in the stubs.
#include "signatures.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::python {
namespace {

namespace py = pybind11;

/// The parts of a text between commas, and its end, outside of brackets and of strings.
std::vector<std::string_view> parts_of(std::string_view text, std::size_t& end) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  int depth = 0;
  bool is_quoted = false;
  for (end = 0; end < text.size(); ++end) {
    const char c = text[end];
    if (c == '\'') is_quoted = !is_quoted;
    if (is_quoted) continue;
    const bool closes = c == ')' || c == ']' || c == '}';
    if ((closes && depth == 0) || (c == ',' && depth == 0)) {
      parts.push_back(text.substr(begin, end - begin));
      begin = end + 1;
      if (closes) return parts;
    }
    depth += (c == '(' || c == '[' || c == '{') - closes;
  }
  return parts;
}

/// A parameter without its type: its name and its default value.
std::string untyped(std::string_view parameter) {
  parameter.remove_prefix(std::min(parameter.find_first_not_of(' '), parameter.size()));
  std::string result(parameter.substr(0, parameter.find_first_of(":=")));
  if (const std::size_t value = parameter.find(" = "); value != std::string_view::npos)
    result += "=" + std::string(parameter.substr(value + 3));
  return result;
}

struct Documented {
  std::string parameters, text;
};

/// None for what pybind11 did not write.
std::optional<Documented> read(std::string_view name, const char* doc) {
  if (doc == nullptr) return std::nullopt;
  std::string_view rest = doc;
  if (!rest.starts_with(name) || rest.substr(name.size(), 1) != "(") return std::nullopt;
  rest.remove_prefix(name.size() + 1);
  Documented found;
  std::size_t end = 0;
  for (const std::string_view parameter : parts_of(rest, end))
    found.parameters += (found.parameters.empty() ? "" : ", ") + untyped(parameter);
  const std::size_t line_end = rest.find('\n', end);
  if (line_end == std::string_view::npos) return std::nullopt;
  rest.remove_prefix(line_end);
  rest.remove_prefix(std::min(rest.find_first_not_of('\n'), rest.size()));
  found.text = rest.substr(0, rest.find_last_not_of('\n') + 1);
  return found;
}

std::string written(std::string_view name, const std::string& parameters, const std::string& text) {
  return std::string(name) + "(" + parameters + ")\n--\n\n" + text;
}

PyCFunctionWithKeywords of_pybind = nullptr;  ///< which calls all functions of the module

/// Calls a function. If the arguments do not fit, pybind11 shows all of them; then what is wrong is said
/// instead.
PyObject* call(PyObject* self, PyObject* arguments, PyObject* named) {
  PyObject* const result = of_pybind(self, arguments, named);
  if (result != nullptr || !PyErr_ExceptionMatches(PyExc_TypeError)) return result;
  py::error_already_set raised;
  const std::string said = py::str(raised.value());
  if (said.find("): incompatible ") == std::string::npos) {
    raised.restore();
    return nullptr;
  }
  try {
    const py::object refusal = py::module_::import("cellwalk._calls").attr("refusal");
    const py::dict by_name = named == nullptr ? py::dict() : py::reinterpret_borrow<py::dict>(named);
    const std::string text = py::str(refusal(said, py::reinterpret_borrow<py::tuple>(arguments), by_name));
    PyErr_SetString(PyExc_TypeError, text.c_str());
  } catch (py::error_already_set& failure) {
    failure.restore();
  }
  return nullptr;
}

/// The compiled function of a member of a class or module, or null.
PyCFunctionObject* function_of(PyObject* member) {
  if (PyInstanceMethod_Check(member)) member = PyInstanceMethod_Function(member);
  if (Py_TYPE(member) == &PyStaticMethod_Type)
    return function_of(py::reinterpret_borrow<py::object>(member).attr("__func__").ptr());
  return PyCFunction_Check(member) ? reinterpret_cast<PyCFunctionObject*>(member) : nullptr;
}

/// Returns the parameters.
std::string give_signature(PyCFunctionObject& function) {
  PyMethodDef& definition = *function.m_ml;
  const auto found = read(definition.ml_name, definition.ml_doc);
  if (!found) return {};
  // pybind11 made the text in this way, and frees it with the function.
  std::free(const_cast<char*>(definition.ml_doc));
  definition.ml_doc = strdup(written(definition.ml_name, found->parameters, found->text).c_str());
  using Any_function = void (*)();
  of_pybind = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<Any_function>(definition.ml_meth));
  definition.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<Any_function>(call));
  return found->parameters;
}

/// A class is called with what its constructor takes. Python keeps this text as long as the class.
void give_signature(PyTypeObject& type, const std::string& of_constructor) {
  const std::string parameters = of_constructor.starts_with("self, ") ? of_constructor.substr(6) : "";
  const std::string_view full = type.tp_name;
  const std::string doc = written(full.substr(full.rfind('.') + 1), parameters, type.tp_doc);
  auto* const kept = static_cast<char*>(PyObject_Malloc(doc.size() + 1));
  if (kept == nullptr) throw std::bad_alloc();
  std::memcpy(kept, doc.c_str(), doc.size() + 1);
  PyObject_Free(const_cast<char*>(type.tp_doc));
  type.tp_doc = kept;
}

}  // namespace

void give_signatures(const py::module_& module) {
  for (const auto& [name, member] : py::dict(module.attr("__dict__"))) {
    if (auto* const function = function_of(member.ptr())) give_signature(*function);
    if (!PyType_Check(member.ptr())) continue;
    py::setattr(member, "__module__", py::str("cellwalk"));
    for (const auto& [of_member, attribute] : py::dict(member.attr("__dict__")))
      if (auto* const function = function_of(attribute.ptr())) {
        const std::string parameters = give_signature(*function);
        if (of_member.equal(py::str("__init__")) && !parameters.empty())
          give_signature(*reinterpret_cast<PyTypeObject*>(member.ptr()), parameters);
      }
  }
}

}  // namespace cellwalk::python
