// SPDX-License-Identifier: LGPL-3.0-or-later
// Which side of the walls the vertices of a body are on.
#ifndef CELLWALK_BODY_REGISTRATION_H
#define CELLWALK_BODY_REGISTRATION_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/locate.h>

#include <span>
#include <vector>

namespace cellwalk::detail {

template <int D>
struct Registered {
  std::vector<Particle<D>> particles;
  std::vector<Chain> chains;  ///< of the edges, from their first end to their second
};

/// `before`, if not empty, says for each vertex where it was registered last: on walls it takes the same side
/// if it can.
/// \throw Error(outside) as Body does
template <int D>
Registered<D> register_body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                            std::span<const Particle<D>> before = {});

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGISTRATION_H
