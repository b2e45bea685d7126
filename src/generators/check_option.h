// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to the generators.
#ifndef CELLWALK_GENERATORS_CHECK_OPTION_H
#define CELLWALK_GENERATORS_CHECK_OPTION_H

#include <cellwalk/kernel/error.h>

namespace cellwalk::detail {

/// \throw Error(usage) with the message if the condition does not hold
inline void check_option(bool holds, const char* message) {
  if (!holds) throw Error(Error_code::usage, message);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_GENERATORS_CHECK_OPTION_H
