// SPDX-License-Identifier: LGPL-3.0-or-later
// Messages that quote names as the user, or a file, gave them.
#ifndef CELLWALK_CLI_COMMON_PRINTABLE_H
#define CELLWALK_CLI_COMMON_PRINTABLE_H

#include <string>
#include <string_view>

namespace cellwalk::cli {

/// A message as one line that does nothing to a terminal: control characters are written as \n, \x1b and
/// the like.
std::string printable(std::string_view message);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_PRINTABLE_H
