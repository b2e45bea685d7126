// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of contacts of the edges of a vertex.
#ifndef CELLWALK_BODY_STEP_MEETS_BEFORE_H
#define CELLWALK_BODY_STEP_MEETS_BEFORE_H

#include <cellwalk/walk/contact.h>

#include <tuple>

namespace cellwalk::detail {

/// As is_before(), but among contacts of several edges the half-facet does not count: ties go to the first
/// edge.
template <int D>
bool meets_before(const Contact<D>& a, const Contact<D>& b) {
  if (const auto order = a.exact_time() <=> b.exact_time(); order != 0) return order < 0;
  return std::tuple(a.body, a.kind) < std::tuple(b.body, b.kind);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_MEETS_BEFORE_H
