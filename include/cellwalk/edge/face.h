// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of a body face: walls that come through it without crossing its edges. 3D. Theory: docs/sweep.md, faces.
// Paper: figure 6, the case that it leaves open.
#ifndef CELLWALK_EDGE_FACE_H
#define CELLWALK_EDGE_FACE_H

#include <cellwalk/edge/contact.h>
#include <cellwalk/edge/triangle.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <optional>

namespace cellwalk {

/// What a face remembers: the walls in its plane that its inside overlaps, each seen from the cell on the side on which the
/// face lies; in ascending order. Of walls that coincide without being glued, those whose cells are on that side. Nearly always
/// empty. It does not depend on the order of the corners of the face.
using Face_rests = boost::container::small_vector<Half_facet, 2>;

/// The chain of a side of a face, from its first end to its second or, reversed, from its second to its first.
struct Side_chain {
  const Chain* chain;
  bool is_reversed = false;
};

/// Chains of the three sides of a face with corners p, q and r. Null where an edge is blocked before the end of the move.
struct Face_chains {
  Side_chain pq, qr, rp;
  bool are_complete() const { return pq.chain && qr.chain && rp.chain; }
};

/// What the sweeps of faces did. All counts are machine-independent.
struct Face_counts {
  std::uint64_t faces = 0;          ///< swept or registered
  std::uint64_t clear = 0;          ///< proved to meet no wall, by planes and boxes
  std::uint64_t flooded_cells = 0;  ///< cells met by them
  std::uint64_t walls = 0;          ///< walls near the others, whose vertices were tested
  std::uint64_t clipped = 0;        ///< walls clipped in rational numbers
  std::uint64_t flat = 0;           ///< moves in the plane of the face that asked for its rests
  Walk_counts walk;                 ///< of all signs

  static constexpr std::array<std::string_view, 6> names{"swept", "clear",   "flooded_cells",
                                                         "walls", "clipped", "flat"};
};
static_assert(names_all_before<Face_counts>(offsetof(Face_counts, walk)));

struct Face_result {
  Face_rests rests;  ///< after the move
  /// If set, a wall comes through the face, and there are no rests. The normal is that of the face at that time on the side it came
  /// from, unless the inside of the wall is met (kind facet): then it is that of the wall, on the side of the face. `body` is the
  /// part of the face that meets it: its inside, one of its edges, or p.
  std::optional<Contact<3>> contact;
  /// True if no wall comes through the face, but an edge of it, where it moved in the plane of a wall and passed its rim, took the
  /// other side of it than the face. The time of the contact is then 0, the point where p started, and the normal that of the wall
  /// on the side of the face, if the wall has that side.
  bool is_edge_astray = false;
};

/// Sweeps the face pqr while p goes its way and q and r stand still. Returns its rests afterwards, or the first contact. Touching
/// a wall is no contact. If p is blocked on its way, a contact is one before that time, and no rests are returned: the
/// move is not made.
///
/// Walls that cross an edge of the face come through it too, and are reported at the same time as by sweep_triangle(), if not
/// before; what the edges alone are hit by (in the plane of the face), is not.
/// \pre `rests` are those of the face before the move; its edges pq and pr were swept and are free, at least up to the time of a contact;
/// `chains` are those of its edges after the move; if one is null, a contact is looked for, and no rests are returned
/// Degenerate cases: all positions of walls against the face. A face that moves in its own plane is free if its edges
/// are, and on the walls on which it rests pass on its side. A face whose corners lie on one line has no inside.
/// Cost: about 60 ns a cell near the face, where it meets no wall; some hundred ns a wall near it; some ten us for the time of
/// a contact; up to milliseconds where it lies in the plane of walls, or an edge of it does.
Face_result sweep_face(const Snapshot<3>& snapshot, const Way<3>& way, const Particle<3>& q,
                       const Particle<3>& r, const Face_rests& rests, const Face_chains& chains,
                       Face_counts& counts);

struct Face_registration {
  Face_rests rests;
  /// If set, this wall pierces the face, by itself or with others that it meets in the plane of the face, or lies between
  /// the face and one of its edges.
  Half_facet piercing = Half_facet::none;
};

/// The rests of a face where it stands, and whether a wall pierces it (invariant I3). `known` are rests to keep where its edges
/// allow it: those of a face that is valid are found again.
/// \pre `chains` are those of its edges
/// Degenerate cases: a face that lies on walls rests on the side on which its edges do; on membranes that lie strictly inside it, on
/// that of `known`, else on that towards (e, e^2, e^3), e small: a function of the geometry alone.
/// Cost: some us where walls are near, up to milliseconds where it lies in their plane.
Face_registration register_face(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                                const Particle<3>& r, const Face_chains& chains, Face_counts& counts,
                                const Face_rests& known = {});

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_FACE_H
