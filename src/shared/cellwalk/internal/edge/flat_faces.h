// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of a body that a vertex takes along: faces that move in their plane, and parts that have the
// vertex alone in common. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_INTERNAL_EDGE_FLAT_FACES_H
#define CELLWALK_INTERNAL_EDGE_FLAT_FACES_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// An edge from the vertex p that moves to one that stands still, with its chains from p.
struct Edge_at_vertex {
  Particle<3> end;
  Chain before;
  const Chain* after;
};

/// A face pqr.
struct Face_at_vertex {
  std::size_t pq, pr;  ///< among the edges at p
  Side_chain qr;
  const Supporting_walls* known;  ///< before the move
};

struct Flat_faces {
  /// Set if a wall comes between the faces, or between a face and an edge: on no side of it all are free.
  /// Then the time is 0, and the point the start of p; or it is a contact of wall_between_parts().
  std::optional<Contact<3>> contact;
  std::size_t face = 0;  ///< one that moves in the plane of that wall
  /// The supporting walls after the move, by the numbers of the faces that move in their planes near walls.
  std::vector<std::pair<std::size_t, Supporting_walls>> supporting_walls;
};

/// The supporting walls of all faces at p that move in their own plane, while p goes its way.
/// \param edges all edges at p
/// \param faces all faces at p
/// \param are_joined one can come from each edge at p to each other one by faces
/// \pre the sweeps of the edges and faces are free, each by itself
/// Cost: some 100 us, up to milliseconds, if walls lie in the plane; else some us a face.
Flat_faces find_flat_faces(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                           std::span<const Edge_at_vertex> edges, std::span<const Face_at_vertex> faces,
                           bool are_joined, Face_counts& counts);

/// The first wall on the way of p that comes between edges and faces at p that are not joined: where p passes
/// along a ridge of walls, all must be in one of the wedges between them. Faces that move in their plane are
/// left out; find_flat_faces() has them. The normal is against the motion.
/// \pre the sweeps of the edges and faces are free, each by itself, up to the time of the contact
/// Cost: a flood along the way, and exact fractions for each wall near it.
std::optional<Contact<3>> wall_between_parts(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                                             std::span<const Edge_at_vertex> edges,
                                             std::span<const Face_at_vertex> faces, Face_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FLAT_FACES_H
