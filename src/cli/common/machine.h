// SPDX-License-Identifier: LGPL-3.0-or-later
// What a measured time depends on, besides the program and its input.
#ifndef CELLWALK_CLI_COMMON_MACHINE_H
#define CELLWALK_CLI_COMMON_MACHINE_H

#include <nlohmann/json_fwd.hpp>

namespace cellwalk::cli {

/// Version of the program, compiler, its flags, and model of the CPU ("unknown" where the system does not
/// tell).
nlohmann::ordered_json machine_json();

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_MACHINE_H
