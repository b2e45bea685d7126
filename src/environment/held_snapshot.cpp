// SPDX-License-Identifier: LGPL-3.0-or-later
// The error for the use of an environment that was moved elsewhere.
#include <cellwalk/internal/environment/held_snapshot.h>
#include <cellwalk/kernel/error.h>

namespace cellwalk {

void detail::refuse_moved_from() {
  throw Error(Error_code::usage, "this environment was moved elsewhere: use the one that it was moved to");
}

}  // namespace cellwalk
