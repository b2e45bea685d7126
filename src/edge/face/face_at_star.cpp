// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/face_at_star.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>

#include "find_supporting_walls.h"
#include "triangle_in_plane.h"

namespace cellwalk::detail {
namespace {

/// The supporting walls of a face as far as the walls at the vertex that leave its plane, or arrive in it,
/// change them.
class Resting_face {
 public:
  Resting_face(const Moving_star<3>& star, const Triangle_in_plane& face, const Supporting_walls& before)
      : snapshot_(star.snapshot()), face_(face), walls_(before) {}

  const Supporting_walls& walls() const { return walls_; }

  /// False if a wall would pass the face. A wall that moves in its own plane changes nothing here.
  bool follow(const Moving_wall<3>& wall) {
    if (wall.swept.is_flat()) return true;
    const auto& [from, to, a, b] = wall.swept.corners();
    if (face_.side(a) != 0 || face_.side(b) != 0) return true;
    const int at_start = face_.side(from), at_end = face_.side(to);
    if (at_start == 0 && face_.overlaps({from, a, b})) return leave(wall.facet, at_end);
    if (at_end == 0 && face_.overlaps({to, a, b})) return arrive(wall.facet, at_start);
    return true;
  }

 private:
  /// The side of the plane of the face on which the free cell of a wall in it lies; 0 if there is none.
  int side_of(Half_facet half) const {
    if (half == Half_facet::none || snapshot_.is_solid(snapshot_.cell_of(half))) return 0;
    const Cell_view<3> cell = snapshot_.view(snapshot_.cell_of(half));
    const auto loop = cell.loop(snapshot_.facet_of(half));
    for (std::uint16_t v = 0;; ++v)
      if (std::find(loop.begin(), loop.end(), v) == loop.end()) return face_.side(cell.point(v));
  }

  /// The wall goes to a side: the face must not be there.
  bool leave(Half_facet wall, int to_side) {
    for (const Half_facet half : {wall, snapshot_.opposite(wall)}) {
      const auto known = std::find(walls_.begin(), walls_.end(), half);
      if (known == walls_.end()) continue;
      walls_.erase(known);
      return side_of(half) != to_side;
    }
    // The face is not on this wall, but on one that coincides with it: behind its only side.
    const int one = side_of(wall), other = side_of(snapshot_.opposite(wall));
    return (one == 0 || other == 0) && one + other == to_side;
  }

  /// The wall comes from a side: the face is on its other one.
  bool arrive(Half_facet wall, int from_side) {
    for (const Half_facet half : {wall, snapshot_.opposite(wall)}) {
      if (side_of(half) != -from_side) continue;
      walls_.push_back(half);
      return true;
    }
    return false;
  }

  const Snapshot<3>& snapshot_;
  const Triangle_in_plane& face_;
  Supporting_walls walls_;
};

}  // namespace

Face_at_star face_at_star(const Moving_star<3>& star, const std::array<Particle<3>, 3>& corners,
                          const Face_chains& chains, const Supporting_walls& before) {
  const auto& [p, q, r] = corners;
  if (are_collinear(p.position, q.position, r.position)) return {true, {}, {}};
  const Triangle_in_plane triangle({p.position, q.position, r.position}, star.counts());
  Resting_face face(star, triangle, before);
  for (std::size_t w = 0; w < star.walls().size(); ++w)
    if (!face.follow(star.walls()[w])) return {false, w, {}};
  Face_counts counts;
  const Face_registration found =
      stand_face(star.snapshot(), p, q, r, chains, face.walls(), Known::binding, counts);
  star.counts() += counts.walk;
  if (found.piercing != Half_facet::none) return {};
  return {true, {}, found.supporting_walls};
}

}  // namespace cellwalk::detail
