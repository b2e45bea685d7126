// SPDX-License-Identifier: LGPL-3.0-or-later
// Signatures of functions where Python looks for them, and calls that do not follow them.
#ifndef CELLWALK_PYTHON_SIGNATURES_H
#define CELLWALK_PYTHON_SIGNATURES_H

#include <pybind11/pybind11.h>

namespace cellwalk::python {

/// Moves the signatures that pybind11 writes into docstrings to where inspect.signature(), help() and editors
/// look for them, and names classes after the module that users import. Calls with arguments that do not fit
/// raise a TypeError of one line.
void give_signatures(const pybind11::module_& module);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_SIGNATURES_H
