// SPDX-License-Identifier: LGPL-3.0-or-later
// The processor flushes small numbers, or takes them for zero, where its control register says so.
#include <cellwalk/internal/kernel/gradual_underflow.h>
#include <cellwalk/kernel/error.h>

#include <limits>

void cellwalk::expect_gradual_underflow() {
  const volatile double least_normal = std::numeric_limits<double>::min();
  const volatile double least = std::numeric_limits<double>::denorm_min();
  const volatile double half = least_normal / 2;
  if (half == 0 || least * 2 == 0)
    throw Error(
        Error_code::usage,
        "this thread flushes numbers below 2.3e-308 to zero, so that no decision would be exact; code "
        "that was linked with -ffast-math sets that when it is loaded: clear it in this thread");
}
