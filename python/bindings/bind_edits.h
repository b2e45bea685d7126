// SPDX-License-Identifier: LGPL-3.0-or-later
// How Python edits environments.
#ifndef CELLWALK_PYTHON_BIND_EDITS_H
#define CELLWALK_PYTHON_BIND_EDITS_H

#include <pybind11/pybind11.h>

#include "world.h"

namespace cellwalk::python {

/// Adds editing(), freeze(), the tables of facets and cells, and the classes of their results.
void bind_edits(pybind11::module_& module, Environment_class& environment);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_BIND_EDITS_H
