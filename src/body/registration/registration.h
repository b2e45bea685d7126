// SPDX-License-Identifier: LGPL-3.0-or-later
// Which side of the walls the vertices of a body are on.
#ifndef CELLWALK_BODY_REGISTRATION_REGISTRATION_H
#define CELLWALK_BODY_REGISTRATION_REGISTRATION_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/environment/edit_log.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/locate.h>

#include <cstdint>
#include <map>
#include <vector>

namespace cellwalk::detail {

template <int D>
struct Registered {
  std::vector<Particle<D>> particles;
  std::vector<Chain> chains;  ///< of the edges, from their first end to their second
};

/// How a body was registered before, which may be out of date, with the names of today. Empty if it was not.
template <int D>
struct Registered_before {
  std::vector<Particle<D>> particles;  ///< Cell::none where the cell is gone, or another one has its name
  std::map<std::uint32_t, std::vector<Cell>> parts;  ///< of the cells of vertices that were split
  std::vector<Chain> chains;
  std::vector<bool> may_keep_chain;  ///< of the edges; else another one is found that lies where it did
  std::vector<Supporting_walls> supporting_walls;  ///< of faces, which body_faces.h registers
  Edits_since edits;
  bool prefers_cells = true;  ///< of the sides that a vertex can have, that of its cell is tried first
};

/// A vertex keeps its side of the walls that stood before: one that was linked with its cell. The chain of an
/// edge is kept where it still holds.
/// \throw Error(outside) as Body does
template <int D>
Registered<D> register_body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup,
                            const Registered_before<D>& before = {});

/// The sides of walls of each vertex between which the edges of a body leave the choice, in the order of
/// preference.
/// \throw Error(outside) as Body does
std::vector<std::vector<Particle<3>>> sides_left(const Snapshot<3>& snapshot, const Locator<3>& locator,
                                                 const Body_soup<3>& soup);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGISTRATION_REGISTRATION_H
