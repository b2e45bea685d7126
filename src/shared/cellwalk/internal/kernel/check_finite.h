// SPDX-License-Identifier: LGPL-3.0-or-later
// Coordinates that come from outside: exact signs, regions and certificates are of finite numbers only.
#ifndef CELLWALK_INTERNAL_KERNEL_CHECK_FINITE_H
#define CELLWALK_INTERNAL_KERNEL_CHECK_FINITE_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <string>

namespace cellwalk::detail {

[[noreturn, gnu::noinline]] inline void refuse_not_finite(const std::string& name) {
  throw Error(Error_code::input, name + " is not finite: correct its coordinates");
}

/// \param name of the point, for the message
/// \throw Error(input) for a point that is not finite
template <std::size_t D, class Name>
void check_finite(const std::array<double, D>& x, const Name& name) {
  if (!is_finite(x)) [[unlikely]]
    refuse_not_finite(name);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_CHECK_FINITE_H
