// SPDX-License-Identifier: LGPL-3.0-or-later
// The tetrahedron that a face sweeps while one of its corners moves from a to b and the others, q and r,
// stand still.
#ifndef CELLWALK_EDGE_FACE_SWEPT_TETRAHEDRON_H
#define CELLWALK_EDGE_FACE_SWEPT_TETRAHEDRON_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>

#include <array>
#include <vector>

#include "broad_phase.h"
#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// The volumes that a point spans with the facets of a tetrahedron opposite to a, b, q and r; positive
/// inside. They may have a common factor.
using Volumes = std::array<Ring, 4>;

/// The part of a facet in a closed tetrahedron, by the volumes of its corners, in order. It may be empty, a
/// point or a segment.
std::vector<Volumes> clip(const Cell_view<3>& cell, std::size_t i, const Corners& corners);

/// True if no volume is 0 at all corners of a polygon; then its interior points lie inside the tetrahedron.
bool reaches_inside(const std::vector<Volumes>& polygon);

/// A tetrahedron abqr of positive volume.
class Swept_tetrahedron {
 public:
  /// \pre a, b, q and r do not lie in one plane
  Swept_tetrahedron(const Corners& corners, Face_counts& counts);

  /// True if the open tetrahedron and a facet have a point in common. Exact.
  /// Cost: 4 to some 100 signs.
  bool meets(const Cell_view<3>& cell, std::size_t i) const;

  /// The first meeting of the face with a part of a facet.
  struct Touch {
    Fraction time;
    Exact_point<3> point;
    Facet_feature feature;  ///< the lowest feature of the facet that contains the point
    Body_feature body;      ///< the part of the face
  };
  /// The first of the points of a facet in the closed tetrahedron, off qr; of those at the same time, the one
  /// on the lowest feature of the facet.
  /// \pre there is one
  Touch first_touch(const Cell_view<3>& cell, std::size_t i) const;

  /// The unit normal of the face at a time, on the side of a, rounded.
  Vector<3> normal_at(const Fraction& time) const;

 private:
  int sign(std::size_t corner, const Point<3>& x) const;
  bool is_parted_at_edge(const Cell_view<3>& cell, std::size_t i) const;

  Corners corners_;
  Face_counts& counts_;
  int sense_;  ///< orientation of a, b, q, r
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_SWEPT_TETRAHEDRON_H
