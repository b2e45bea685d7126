// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of all kinds with regions free of walls. Rods have none by themselves.
#ifndef CELLWALK_TESTS_BODY_WITH_REGIONS_H
#define CELLWALK_TESTS_BODY_WITH_REGIONS_H

#include <cellwalk/internal/body/certificates.h>

namespace cellwalk::test {

template <int D>
void have_regions(Body<D>& body) {
  detail::Body_certificates all;
  all.least_edges_a_vertex = 0;
  Body_counts uncounted;
  detail::use_certificates(body, all, uncounted);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_WITH_REGIONS_H
