// SPDX-License-Identifier: LGPL-3.0-or-later
// Names of the ways in which moves of points of an environment end.
#ifndef CELLWALK_CLI_COMMON_MOVE_END_NAMES_H
#define CELLWALK_CLI_COMMON_MOVE_END_NAMES_H

#include <array>

namespace cellwalk::cli {

/// By Move_end.
inline constexpr std::array<const char*, 5> move_end_names{"reached", "contact", "touch", "cell", "boundary"};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_MOVE_END_NAMES_H
