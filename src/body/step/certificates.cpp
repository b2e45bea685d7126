// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice of certificates for a body, whose regions begin anew with it.
#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/body/certificates.h>

#include "body/body_state.h"

namespace cellwalk::detail {

template <int D>
void use_certificates(Body<D>& body, const Body_certificates& chosen, Body_counts& counts) {
  body.leave_region(counts);
  Body_access<D>::state_of(body).begin_regions(chosen);
}

template void use_certificates(Body<2>&, const Body_certificates&, Body_counts&);
template void use_certificates(Body<3>&, const Body_certificates&, Body_counts&);

}  // namespace cellwalk::detail
