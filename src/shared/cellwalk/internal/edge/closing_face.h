// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces of bodies at facets that are to become walls. Theory: docs/cutting.md.
#ifndef CELLWALK_INTERNAL_EDGE_CLOSING_FACE_H
#define CELLWALK_INTERNAL_EDGE_CLOSING_FACE_H

#include <cellwalk/internal/edge/face.h>

#include <array>

namespace cellwalk::detail {

/// How a face and a facet lie to each other.
enum class Face_at_facet : std::uint8_t {
  other,     ///< they may touch
  pierced,   ///< an inner point of the facet lies in the open face, and not the whole facet in its plane
  in_plane,  ///< they lie in one plane, and their insides overlap
};

/// \pre the corners of the face are not collinear
Face_at_facet place_of_face(const Snapshot<3>& snapshot, Half_facet facet,
                            const std::array<Point<3>, 3>& face, Walk_counts& counts);

/// A face where it stands among walls, some of which are new. It stays on the sides of walls that are known;
/// an edge on another side of one is an obstacle.
/// Cost: that of register_face().
Face_registration stand_among_walls(const Snapshot<3>& snapshot, const std::array<Particle<3>, 3>& corners,
                                    const Face_chains& chains, const Supporting_walls& known,
                                    Walk_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_CLOSING_FACE_H
