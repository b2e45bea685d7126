// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/body/certificates.h>

#include "body_state.h"

namespace cellwalk::detail {

template <int D>
void use_certificates(Body<D>& body, const Body_certificates& chosen, Body_counts& counts) {
  body.leave_region(counts);
  Body_state<D>& state = *body.state_;
  state.certificates = chosen;
  const bool rests_first = is_rod(state.topology, state.positions.size(), chosen);
  state.region =
      Region_cache<D>(state.positions.size(), state.chains.size(), worthwhile(chosen, rests_first));
  state.pool = Region_pool<D>(state.positions.size(), chosen, rests_first);
  state.pool.prepare(*state.snapshot, state.particles);
}

template void use_certificates(Body<2>&, const Body_certificates&, Body_counts&);
template void use_certificates(Body<3>&, const Body_certificates&, Body_counts&);

}  // namespace cellwalk::detail
