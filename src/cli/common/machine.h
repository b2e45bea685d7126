// SPDX-License-Identifier: LGPL-3.0-or-later
// The conditions of a measured time, besides the program and its input.
#ifndef CELLWALK_CLI_COMMON_MACHINE_H
#define CELLWALK_CLI_COMMON_MACHINE_H

#include <nlohmann/json_fwd.hpp>

namespace cellwalk::cli {

/// The version of the program, the compiler, its flags, and the model of the CPU ("unknown" if the system
/// does not report it).
nlohmann::ordered_json machine_json();

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_MACHINE_H
