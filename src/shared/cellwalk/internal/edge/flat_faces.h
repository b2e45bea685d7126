// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces at a vertex that moves in their plane: on which sides of walls in it they are, and what is joined to
// them. Theory: docs/sweep.md, faces.
#ifndef CELLWALK_INTERNAL_EDGE_FLAT_FACES_H
#define CELLWALK_INTERNAL_EDGE_FLAT_FACES_H

#include <cellwalk/edge/face.h>

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
  /// Then the time is 0, and the point the start of p.
  std::optional<Contact<3>> contact;
  std::size_t face = 0;  ///< one that moves in the plane of that wall
  /// The supporting walls after the move, by the numbers of the faces that move in their planes near walls.
  std::vector<std::pair<std::size_t, Supporting_walls>> supporting_walls;
};

/// The supporting walls of all faces at p that move in their own plane, while p goes its way.
/// \param edges all edges at p
/// \param faces all faces at p
/// \pre the sweeps of the edges and faces are free, each by itself
/// Cost: some 100 us, up to milliseconds, if walls lie in the plane; else some us a face.
Flat_faces find_flat_faces(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                           std::span<const Edge_at_vertex> edges, std::span<const Face_at_vertex> faces,
                           Face_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FLAT_FACES_H
