// SPDX-License-Identifier: LGPL-3.0-or-later
// The faces of a body: that no wall pierces them. 3D.
#ifndef CELLWALK_BODY_SHAPE_BODY_FACES_H
#define CELLWALK_BODY_SHAPE_BODY_FACES_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/kernel/error.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "body/body_state.h"

namespace cellwalk::detail {

/// Where it stands.
/// \pre its edges are not stale
Face_registration registered_face(const Body_state<3>& body, std::uint32_t face, Face_counts& counts);

struct Pierced_face {
  std::uint32_t face;
  Half_facet wall;
};

/// Registers all faces. Returns those that a wall pierces, ascending: the body must not be used then.
std::vector<Pierced_face> register_faces(Body_state<3>& body, Face_counts& counts);

/// True if the wall crosses the plane of the face inside it, so that the body passes it on no sides of walls.
bool is_pierced_on_all_sides(const Body_state<3>& body, const Pierced_face& pierced);

/// \param has_search_ended there may be sides of walls on which the body passes, but they were not found
/// \throw Error(code) naming the face
[[noreturn]] void refuse_pierced(const Body_state<3>& body, const Pierced_face& pierced, Error_code code,
                                 bool has_search_ended = false);

/// Before faces are swept after moves that left them alone: registers them all, for which all vertices and
/// edges are needed.
/// \throw Error(usage) if a wall pierces one, or is nearer to it than its radius
void take_up_faces(Body_state<3>& body, Body_counts& counts);

/// Sweeps the faces of a vertex on its way: stores the first contact, or the supporting walls after the move
/// in the scratch.
/// \pre its edges were swept, and their chains are in the scratch
void sweep_faces(const Body_state<3>& body, Move_scratch<3>& scratch, std::uint32_t vertex,
                 const Vertex_path<3>& path, std::optional<Contact<3>>& first, Face_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_SHAPE_BODY_FACES_H
