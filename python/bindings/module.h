// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of the Python module, one file each.
#ifndef CELLWALK_PYTHON_MODULE_H
#define CELLWALK_PYTHON_MODULE_H

#include <pybind11/pybind11.h>

namespace cellwalk::python {

void bind_environment(pybind11::module_& module);
void bind_motions(pybind11::module_& module);
void bind_particles(pybind11::module_& module);
void bind_bodies(pybind11::module_& module);
/// Adds to the classes Environment and Particles.
void bind_traces(pybind11::module_& module);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_MODULE_H
