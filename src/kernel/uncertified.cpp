// SPDX-License-Identifier: LGPL-3.0-or-later
// The error for contradictory decisions.
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/kernel/error.h>

void cellwalk::refuse_uncertified() {
  throw Error(Error_code::not_certified,
              "cells, walls and planes of this environment contradict each other: it is not certified, and "
              "`cellwalk check` says where");
}
