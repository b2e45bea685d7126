// SPDX-License-Identifier: LGPL-3.0-or-later
// Which side of the walls the vertices of a body are on.
#ifndef CELLWALK_BODY_REGISTRATION_H
#define CELLWALK_BODY_REGISTRATION_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/face.h>
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

/// How a body was registered before, which may be out of date. Empty if it was not.
template <int D>
struct Registered_before {
  std::span<const Particle<D>> particles;
  /// May be empty alone: then all are found anew. So may those of faces, which body_faces.h registers.
  std::span<const Chain> chains;
  std::span<const Supporting_walls> supporting_walls;
};

/// What `before` says is kept where it still holds: the cell of a vertex, and so its side of walls, and the
/// chain of an edge.
/// \throw Error(outside) as Body does
template <int D>
Registered<D> register_body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                            const Registered_before<D>& before = {});

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGISTRATION_H
