// SPDX-License-Identifier: LGPL-3.0-or-later
// How Python makes environments.
#ifndef CELLWALK_PYTHON_MAKE_ENVIRONMENT_H
#define CELLWALK_PYTHON_MAKE_ENVIRONMENT_H

#include <pybind11/pybind11.h>

#include "world.h"

namespace cellwalk::python {

/// Adds from_arrays, load, import_mesh and generate.
void bind_makers(Environment_class& environment);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_MAKE_ENVIRONMENT_H
