// SPDX-License-Identifier: LGPL-3.0-or-later
// A face that the walls at a moving vertex touch: whether they may, and the walls on which it rests then.
// Theory: docs/moving.md, faces.
#ifndef CELLWALK_INTERNAL_EDGE_FACE_AT_STAR_H
#define CELLWALK_INTERNAL_EDGE_FACE_AT_STAR_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/moving_star.h>

#include <array>
#include <optional>

namespace cellwalk::detail {

/// A face after the move of the vertex.
struct Face_at_star {
  bool is_free = false;
  std::optional<Collision> collision;  ///< if it is not free: that with the wall that passes it first
  Supporting_walls supporting_walls;   ///< if it is free
};

/// The collision where the vertex itself passes a point of a face that no wall hits, and draws a wall into it
/// there: all its walls that go through the face move in their own planes. None if it does not.
/// \pre the face is registered
/// Cost: up to five signs, and some for each wall in its own plane if it passes a point of the face; exact
/// numbers if it draws a wall.
std::optional<Collision> face_passed_by_vertex(const Moving_star<3>& star,
                                               const std::array<Point<3>, 3>& corners);

/// Decides about a face that stands still while the vertex moves.
/// \param corners registered as they are after the move
/// \param chains of its edges, after the move
/// \param before its supporting walls before the move
/// \pre no wall of the star hits it, face_passed_by_vertex() finds none, and its corners and edges are free
/// Cost: some us; up to milliseconds if it lies in the plane of walls.
Face_at_star face_at_star(const Moving_star<3>& star, const std::array<Particle<3>, 3>& corners,
                          const Face_chains& chains, const Supporting_walls& before);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_FACE_AT_STAR_H
