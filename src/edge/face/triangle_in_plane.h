// SPDX-License-Identifier: LGPL-3.0-or-later
// A face at its current position, against walls in its plane and walls that reach it. All signs are exact.
#ifndef CELLWALK_EDGE_FACE_TRIANGLE_IN_PLANE_H
#define CELLWALK_EDGE_FACE_TRIANGLE_IN_PLANE_H

#include <cellwalk/internal/edge/face.h>

#include <array>
#include <cstddef>
#include <vector>

#include "edge/exact/half_space.h"

namespace cellwalk::detail {

/// A triangle of positive area.
class Triangle_in_plane {
 public:
  /// \pre the corners are not collinear
  Triangle_in_plane(const std::array<Point<3>, 3>& corners, Walk_counts& counts);

  const std::array<Point<3>, 3>& corners() const { return corners_; }

  /// > 0 on the side from which the corners turn counterclockwise, 0 in the plane.
  int side(const Point<3>& x) const {
    return Exact::orientation(counts_.predicates, corners_[0], corners_[1], corners_[2], x);
  }
  /// True if a facet lies in the plane.
  bool holds(const Cell_view<3>& cell, std::size_t i) const;
  /// The side() on which the cell of such a facet lies.
  int side_of_cell(const Cell_view<3>& cell, std::size_t i) const;

  /// The side() towards which (e, e^2, e^3) points, e small: it depends on the direction of the plane alone.
  int fixed_side() const { return own_sense_; }

  /// True if the interiors of a facet in the plane and of the triangle overlap.
  bool overlaps(const Cell_view<3>& cell, std::size_t i) const;
  /// True if the interiors of a triangle in the plane, given by its corners, and of this one overlap.
  bool overlaps(const std::array<Point<3>, 3>& other) const;
  /// True if two facets in the plane overlap inside the triangle.
  /// Cost: some ten us, in exact numbers.
  bool overlaps(const Cell_view<3>& c, std::size_t i, const Cell_view<3>& d, std::size_t j) const;
  /// True if a segment in the plane has a part of positive length inside the triangle.
  bool overlaps(const Point<3>& u, const Point<3>& v) const;
  /// True if a facet in the plane has inner points between the ends of a segment in it.
  bool has_inside(const Cell_view<3>& cell, std::size_t i, const Point<3>& u, const Point<3>& v) const;
  /// The corners of the part of a facet in the plane that lies in the closed triangle, each by positive
  /// multiples of its coordinates with respect to the corners of the triangle.
  std::vector<Ring_vector<3>> part_of(const Cell_view<3>& cell, std::size_t i) const;
  /// True if an interior point of a facet lies inside the triangle, and the facet does not lie in its plane.
  bool is_pierced_by(const Cell_view<3>& cell, std::size_t i) const;

 private:
  int sense(const Point<3>& u, const Point<3>& v, const Point<3>& w) const;
  void append_sides(const Cell_view<3>& cell, std::size_t i, std::vector<Ring_vector<3>>& sides) const;
  Point<2> drop(const Point<3>& x) const { return {x[(axis_ + 1) % 3], x[(axis_ + 2) % 3]}; }

  std::array<Point<3>, 3> corners_;
  Walk_counts& counts_;
  std::size_t axis_ = 0;  ///< the first along which the projected triangle has a positive area
  int own_sense_ = 0;     ///< orientation of the projected corners
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_TRIANGLE_IN_PLANE_H
