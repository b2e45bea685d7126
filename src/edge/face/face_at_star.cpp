// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls that enter or leave the plane of a face, and the way of the vertex through it.
#include <cellwalk/internal/edge/face_at_star.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <utility>
#include <vector>

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
    if (at_end == 0 && face_.overlaps({to, a, b})) arrive(wall.facet, at_start);
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

  /// The wall comes from a side: the face is on its other one. Where the free space of the wall is behind it
  /// only, the face will be on a wall that coincides with it.
  void arrive(Half_facet wall, int from_side) {
    for (const Half_facet half : {wall, snapshot_.opposite(wall)})
      if (side_of(half) == -from_side) {
        walls_.push_back(half);
        return;
      }
  }

  const Snapshot<3>& snapshot_;
  const Triangle_in_plane& face_;
  Supporting_walls walls_;
};

/// The vertex on its way through the plane of a face, which it leaves for a side.
class Passing_vertex {
 public:
  Passing_vertex(const Moving_star<3>& star, const std::array<Point<3>, 3>& corners)
      : star_(star), corners_(corners), to_side_(side(star.to())) {
    if (to_side_ == 0 || side(star.from()) * to_side_ > 0) return;
    // Barycentric coordinates of the place, but for a common factor.
    for (std::size_t k = 0; k < 3; ++k) weights_[k] = turn(corners[(k + 1) % 3], corners[(k + 2) % 3]);
    const auto [least, most] = std::ranges::minmax(weights_);
    is_in_closed_ = least * most >= 0;
  }

  /// Whether the vertex, as soon as it has passed the place, draws a wall into the face there.
  bool draws(const Moving_wall<3>& wall) const {
    if (!is_in_closed_ || !wall.swept.is_flat()) return false;
    const auto& [from, to, a, b] = wall.swept.corners();
    const int at_a = side(a) * to_side_, at_b = side(b) * to_side_;
    if (at_a >= 0 && at_b >= 0) return false;
    return (at_a <= 0 && is_inwards(a)) || (at_b <= 0 && is_inwards(b));
  }

  /// \pre draws(wall)
  Collision collision(std::size_t wall) const {
    const auto& [p, q, r] = corners_;
    const Ring before = Exact_value::orientation(p, q, r, star_.from());
    const Ring after = Exact_value::orientation(p, q, r, star_.to());
    std::vector<Ring> weights;
    for (std::size_t k = 0; k < 3; ++k)
      weights.push_back(CGAL::abs(
          Exact_value::orientation(star_.from(), star_.to(), corners_[(k + 1) % 3], corners_[(k + 2) % 3])));
    return {Fraction(before, before - after), {Ring(1), Ring(0), Ring(0)}, std::move(weights), wall};
  }

 private:
  int side(const Point<3>& x) const {
    return Exact::orientation(star_.counts().predicates, corners_[0], corners_[1], corners_[2], x);
  }

  /// The turn of two points around the way of the vertex.
  int turn(const Point<3>& x, const Point<3>& y) const {
    return Exact::orientation(star_.counts().predicates, star_.from(), star_.to(), x, y);
  }
  /// Whether a corner of a wall lies, seen along the way, on the inner side of each edge with the place.
  bool is_inwards(const Point<3>& x) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (weights_[k] != 0) continue;
      // Seen against the way, the corners turn by the sign of to_side_. The place may be one of the two.
      const int inner = turn(x, corners_[(k + 1) % 3]) + turn(corners_[(k + 2) % 3], x);
      if (inner * to_side_ <= 0) return false;
    }
    return true;
  }

  const Moving_star<3>& star_;
  const std::array<Point<3>, 3>& corners_;
  int to_side_;
  std::array<int, 3> weights_{};
  bool is_in_closed_ = false;
};

}  // namespace

std::optional<Collision> face_passed_by_vertex(const Moving_star<3>& star,
                                               const std::array<Point<3>, 3>& corners) {
  const Passing_vertex vertex(star, corners);
  for (std::size_t w = 0; w < star.walls().size(); ++w)
    if (vertex.draws(star.walls()[w])) return vertex.collision(w);
  return {};
}

Face_at_star face_at_star(const Moving_star<3>& star, const std::array<Particle<3>, 3>& corners,
                          const Face_chains& chains, const Supporting_walls& before) {
  const auto& [p, q, r] = corners;
  if (are_collinear(p.position, q.position, r.position)) return {true, {}, {}};
  const std::array points{p.position, q.position, r.position};
  const Triangle_in_plane triangle(points, star.counts());
  Resting_face face(star, triangle, before);
  for (std::size_t w = 0; w < star.walls().size(); ++w)
    if (!face.follow(star.walls()[w])) return {false, star.first_hit(w, points), {}};
  Face_counts counts;
  const Face_registration found =
      stand_face(star.snapshot(), p, q, r, chains, face.walls(), Known::binding, counts);
  star.counts() += counts.walk;
  if (found.piercing != Half_facet::none) return {};
  return {true, {}, found.supporting_walls};
}

}  // namespace cellwalk::detail
