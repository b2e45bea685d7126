// SPDX-License-Identifier: LGPL-3.0-or-later
// The processor of this machine.
#ifndef CELLWALK_INTERNAL_IO_CPU_MODEL_H
#define CELLWALK_INTERNAL_IO_CPU_MODEL_H

#include <string>

namespace cellwalk::io {

/// The name that Linux gives the processor; "unknown" where there is none.
std::string cpu_model();

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_CPU_MODEL_H
