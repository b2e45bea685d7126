// SPDX-License-Identifier: LGPL-3.0-or-later
// Access for programs of one dimension to the content of files, whose dimension is known only when they are
// read.
#ifndef CELLWALK_KERNEL_OF_DIMENSION_H
#define CELLWALK_KERNEL_OF_DIMENSION_H

#include <cellwalk/kernel/error.h>

#include <string>
#include <utility>
#include <variant>

namespace cellwalk {

/// The value held, such as the environment of an import, if it has dimension D.
/// \throw Error(input) if it has the other dimension
template <int D, template <int> class Kind>
const Kind<D>& of_dimension(const std::variant<Kind<2>, Kind<3>>& any) {
  if (const Kind<D>* held = std::get_if<Kind<D>>(&any)) return *held;
  throw Error(Error_code::input, "this has dimension " + std::to_string(5 - D) + ", where " +
                                     std::to_string(D) + " is expected: give one of that dimension");
}
template <int D, template <int> class Kind>
Kind<D>& of_dimension(std::variant<Kind<2>, Kind<3>>& any) {
  return const_cast<Kind<D>&>(of_dimension<D>(std::as_const(any)));
}
/// The same of a temporary, which is moved from.
template <int D, template <int> class Kind>
Kind<D> of_dimension(std::variant<Kind<2>, Kind<3>>&& any) {
  return std::move(of_dimension<D>(any));
}

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_OF_DIMENSION_H
