// SPDX-License-Identifier: LGPL-3.0-or-later
// Pickles: environments as the bytes of compiled ones, and bodies and particles with their environment.
#ifndef CELLWALK_PYTHON_PICKLING_H
#define CELLWALK_PYTHON_PICKLING_H

#include <pybind11/pybind11.h>

#include <cstddef>
#include <vector>

#include "world.h"

namespace cellwalk::python {

/// The environment as it is now, with its names, groups and certificate.
std::vector<std::byte> compiled_bytes(const Shared_world& self);

/// Environments can be pickled and copied.
void bind_pickles(Environment_class& environment);

/// The parts of a pickle.
/// \throw py::value_error if there are not as many of them
void need_parts(const pybind11::tuple& state, std::size_t count);

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_PICKLING_H
