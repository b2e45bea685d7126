// SPDX-License-Identifier: LGPL-3.0-or-later
// How Python moves the walls of environments.
#ifndef CELLWALK_PYTHON_RESHAPE_H
#define CELLWALK_PYTHON_RESHAPE_H

#include <pybind11/pybind11.h>

#include "world.h"

namespace cellwalk::python {

/// Adds reshape(), and the class of its result.
void bind_reshape(pybind11::module_& module, Environment_class& environment);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_RESHAPE_H
