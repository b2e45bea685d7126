// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies and contacts in a picture, in space and in the plane.
#ifndef CELLWALK_INTERNAL_DRAWING_BODIES_H
#define CELLWALK_INTERNAL_DRAWING_BODIES_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/drawing/walls.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::drawing {

/// The appearance of all that a picture shows.
struct Scene_materials {
  Wall_materials environment;
  std::uint32_t catheter, particle, trail, contact, body, body_face;
};
/// \param planar opaque and unlit
Scene_materials add_materials(Drawing& drawing, bool planar);

/// Sizes in drawings, as shares of the diagonal of the environment's box.
constexpr double particle_size = 0.0032, contact_size = 0.0036;
/// Pieces of a tube with as many triangles as the arrow of a contact.
constexpr std::size_t arrow_pieces = 3;

/// A tube along a polyline, a ball, an arrow; in the plane flat ones at a height.
void draw_line(Drawing& drawing, const std::vector<Point<3>>& line, double size, double height,
               std::uint32_t material);
void draw_line(Drawing& drawing, const std::vector<Point<2>>& line, double size, double height,
               std::uint32_t material);
void draw_dot(Drawing& drawing, const Point<3>& p, double size, double height, std::uint32_t material);
void draw_dot(Drawing& drawing, const Point<2>& p, double size, double height, std::uint32_t material);

/// The place of a contact, and its normal as an arrow.
/// \param scale the diagonal of the environment's box, or less for smaller marks
/// \param height, arrow_height in the plane
template <int D>
void draw_contact(Drawing& drawing, const Point<D>& point, const Vector<D>& normal, double scale,
                  double height, double arrow_height, std::uint32_t material);

/// How much of some bodies is drawn, so that their number of triangles is bounded.
struct Body_share {
  double faces = 1, shapes = 1;
  bool edges_of_faces = true;           ///< draws the edges of bodies that have faces
  std::size_t triangles_of_shapes = 0;  ///< about; see bound()

  /// \param edges, faces of all bodies
  Body_share(std::size_t edges, std::size_t faces);
  /// Of the round shapes only as many are drawn as the bound allows, with fewer sides.
  void bound(const Round_shapes& shapes, Drawing& drawing, bool flat);
  template <int D>
  bool draws_edges_of(const Body<D>& body) const {
    return body.faces().empty() || edges_of_faces;
  }
};

/// Adds the round shapes of a body to those counted.
template <int D>
void count_shapes(const Body<D>& body, const Body_share& share, Round_shapes& shapes);

/// How many faces and shapes came before.
struct Numbers_drawn {
  std::size_t faces = 0, shapes = 0;
};

/// Adds a body at some positions: its faces, its edges or, if it has none, its vertices.
/// \param unit the diagonal of the environment's box
template <int D>
void draw_body(Drawing& drawing, const Body<D>& body, std::span<const Point<D>> positions,
               const Scene_materials& materials, const Body_share& share, double unit, double height,
               Numbers_drawn& numbers);

/// The diagonal of the box of an environment.
template <int D>
double diagonal_of(const Snapshot<D>& snapshot);

}  // namespace cellwalk::drawing

#endif  // CELLWALK_INTERNAL_DRAWING_BODIES_H
