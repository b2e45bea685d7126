// SPDX-License-Identifier: LGPL-3.0-or-later
// What exact signs need of the processor beside rounding to nearest: numbers below the least normal one.
#ifndef CELLWALK_INTERNAL_KERNEL_GRADUAL_UNDERFLOW_H
#define CELLWALK_INTERNAL_KERNEL_GRADUAL_UNDERFLOW_H

namespace cellwalk {

/// Cost: 7 ns.
/// \throw Error(usage) if this thread flushes small numbers to zero
void expect_gradual_underflow();

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_GRADUAL_UNDERFLOW_H
