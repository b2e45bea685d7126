// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of a body face in 3D, which finds walls that come through it without crossing its edges. Theory:
// docs/sweep.md, faces. Paper: figure 6, the case that it leaves open.
#ifndef CELLWALK_INTERNAL_EDGE_FACE_H
#define CELLWALK_INTERNAL_EDGE_FACE_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <optional>

namespace cellwalk {

/// The supporting walls of a face: the walls in its plane that overlap its interior, each seen from the cell
/// on the side of the face; in ascending order. Of coincident walls that are not glued, those whose cells are
/// on that side. Nearly always empty. Independent of the order of the corners of the face.
using Supporting_walls = boost::container::small_vector<Half_facet, 2>;

/// The chain of a side of a face, from its first end to its second or, reversed, from its second to its
/// first.
struct Side_chain {
  const Chain* chain;
  bool is_reversed = false;
};

/// Chains of the three sides of a face with corners p, q and r; null for an edge that is blocked before the
/// end of the move.
struct Face_chains {
  Side_chain pq, qr, rp;
  bool are_complete() const { return pq.chain && qr.chain && rp.chain; }
};

struct Face_result {
  Supporting_walls supporting_walls;  ///< after the move
  /// If set, a wall comes through the face, and `supporting_walls` is empty. The normal is that of the face
  /// at that time, on the side from which the face came, or, if the interior of the wall is met (kind facet),
  /// that of the wall on the side of the face. `body` is the feature of the face that meets the wall: its
  /// interior, one of its edges, or p.
  std::optional<Contact<3>> contact;
  bool are_walls_near = false;  ///< walls that may meet the face on its way
  /// True if no wall comes through the face, but one of its edges, which moved in the plane of a wall and
  /// passed its rim, is on the other side of the wall. Then the time is 0, the point is the start of p, and
  /// the normal is that of the wall on the side of the face, if the wall has that side.
  bool is_edge_on_other_side = false;
};

/// Sweeps the face pqr while p moves along its path and q and r stand still. Returns the supporting walls
/// after the move, or the first contact. Touching a wall is no contact. If p is blocked on its path, only
/// contacts before that time count, and no supporting walls are returned, since the move is not made.
/// Walls that come between two faces, over the edge that they share, concern no single face: Body finds them.
///
/// Walls that cross an edge of the face come through it too, and are reported at the same time as by
/// sweep_triangle(), or earlier; walls that hit only the edges (in the plane of the face) are not reported.
/// \param snapshot in which the face lies
/// \param path the path of p, which may be blocked
/// \param q,r the corners that stand still
/// \param supporting_walls the supporting walls of the face before the move
/// \param chains the chains of its edges after the move; if one is null, only a contact is searched, and no
///        supporting walls are returned
/// \param counts raised by the sweep
/// \pre the sweeps of the edges pq and pr are free, at least up to the time of a contact
/// Degenerate cases: all positions of walls relative to the face. A face that moves in its own plane is free
/// if its edges are, and if walls in the plane that are joined under the area that it sweeps have it and its
/// edges on one side. A face with collinear corners has no interior.
/// Cost: about 60 ns a cell near the face if it meets no wall; some hundred ns a wall near it; some ten us
/// for the time of a contact; up to milliseconds if the face or one of its edges lies in the plane of walls.
Face_result sweep_face(const Snapshot<3>& snapshot, const Vertex_path<3>& path, const Particle<3>& q,
                       const Particle<3>& r, const Supporting_walls& supporting_walls,
                       const Face_chains& chains, Face_counts& counts);

struct Face_registration {
  Supporting_walls supporting_walls;
  /// If set, this wall pierces the face, alone or together with others that it meets in the plane of the
  /// face, or it lies between the face and one of its edges.
  Half_facet piercing = Half_facet::none;
};

/// Finds the supporting walls of a face at its current position, and a wall that pierces it (invariant I3).
/// \param snapshot in which the face lies
/// \param p,q,r the corners, with their cells
/// \param chains the chains of its edges
/// \param counts raised by the registration
/// \param known supporting walls to keep if the edges allow it; those of a valid face are found again
/// Degenerate cases: a face on walls is on the side of its edges; on membranes strictly inside it, on the
/// side of `known`, otherwise on the side towards (e, e^2, e^3), e small, which depends on the geometry
/// alone.
/// Cost: some us if walls are near, up to milliseconds if it lies in their plane.
Face_registration register_face(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                                const Particle<3>& r, const Face_chains& chains, Face_counts& counts,
                                const Supporting_walls& known = {});

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_EDGE_FACE_H
