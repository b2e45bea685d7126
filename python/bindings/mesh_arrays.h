// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments as arrays of other programs.
#ifndef CELLWALK_PYTHON_MESH_ARRAYS_H
#define CELLWALK_PYTHON_MESH_ARRAYS_H

#include <pybind11/pybind11.h>

#include "world.h"

namespace cellwalk::python {

/// Adds to_arrays(), and the class of its result.
void bind_mesh_arrays(pybind11::module_& module, Environment_class& environment);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_MESH_ARRAYS_H
