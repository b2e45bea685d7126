// SPDX-License-Identifier: LGPL-3.0-or-later
// The position of a face relative to a new wall, and its supporting walls among others.
#include <cellwalk/internal/edge/closing_face.h>

#include "find_supporting_walls.h"
#include "triangle_in_plane.h"

namespace cellwalk::detail {

Face_at_facet place_of_face(const Snapshot<3>& snapshot, Half_facet facet,
                            const std::array<Point<3>, 3>& face, Walk_counts& counts) {
  const Cell_view<3> cell = snapshot.view(snapshot.cell_of(facet));
  const std::size_t i = snapshot.facet_of(facet);
  const Triangle_in_plane triangle(face, counts);
  if (triangle.holds(cell, i))
    return triangle.overlaps(cell, i) ? Face_at_facet::in_plane : Face_at_facet::other;
  return triangle.is_pierced_by(cell, i) ? Face_at_facet::pierced : Face_at_facet::other;
}

Face_registration stand_among_walls(const Snapshot<3>& snapshot, const std::array<Particle<3>, 3>& corners,
                                    const Face_chains& chains, const Supporting_walls& known,
                                    Walk_counts& counts) {
  Face_counts face_counts;
  const auto& [p, q, r] = corners;
  Face_registration result = stand_face(snapshot, p, q, r, chains, known, Known::binding, face_counts);
  counts += face_counts.walk;
  return result;
}

}  // namespace cellwalk::detail
