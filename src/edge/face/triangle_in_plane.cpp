// SPDX-License-Identifier: LGPL-3.0-or-later
// Overlaps of the triangle with facets and segments, by separating lines.
#include "triangle_in_plane.h"

#include <cellwalk/internal/walk/signs.h>

#include <algorithm>
#include <utility>

#include "swept_tetrahedron.h"

namespace cellwalk::detail {
namespace {

std::vector<Ring_vector<3>> unit_vectors() { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

/// The part of a convex polygon on which affine functions, given by their values at three points, are not
/// negative. Corners are given by multiples of their coordinates with respect to these points.
std::vector<Ring_vector<3>> clipped(std::vector<Ring_vector<3>> polygon,
                                    const std::vector<Ring_vector<3>>& functions) {
  for (const Ring_vector<3>& f : functions) {
    std::vector<Ring_vector<3>> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Ring_vector<3>&u = polygon[k], &v = polygon[(k + 1) % polygon.size()];
      const Ring at_u = exact_dot(f, u), at_v = exact_dot(f, v);
      if (CGAL::sign(at_u) != CGAL::NEGATIVE) kept.push_back(u);
      if (CGAL::sign(at_u) * CGAL::sign(at_v) >= 0) continue;
      const Ring of_u = CGAL::abs(at_v), of_v = CGAL::abs(at_u);
      kept.push_back({of_u * u[0] + of_v * v[0], of_u * u[1] + of_v * v[1], of_u * u[2] + of_v * v[2]});
    }
    polygon = std::move(kept);
  }
  return polygon;
}

}  // namespace

Triangle_in_plane::Triangle_in_plane(const std::array<Point<3>, 3>& corners, Walk_counts& counts)
    : corners_(corners), counts_(counts) {
  for (; axis_ < 3; ++axis_) {
    own_sense_ = sense(corners[0], corners[1], corners[2]);
    if (own_sense_ != 0) break;
  }
}

int Triangle_in_plane::sense(const Point<3>& u, const Point<3>& v, const Point<3>& w) const {
  return Exact::orientation(counts_.predicates, drop(u), drop(v), drop(w));
}

bool Triangle_in_plane::holds(const Cell_view<3>& cell, std::size_t i) const {
  return std::all_of(corners_.begin(), corners_.end(),
                     [&](const Point<3>& x) { return detail::side<Exact>(cell, i, x, counts_) == 0; });
}

int Triangle_in_plane::side_of_cell(const Cell_view<3>& cell, std::size_t i) const {
  // The first three vertices of a facet are not collinear; they turn counterclockwise seen from outside.
  const auto loop = cell.loop(i);
  return -own_sense_ * sense(cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]));
}

// Convex sets in a plane, at least one of which has a positive area, have disjoint interiors if and only if
// the line of a side of one of them separates them weakly.
bool Triangle_in_plane::overlaps(const Cell_view<3>& cell, std::size_t i) const {
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<3>&c = corners_[k], &d = corners_[(k + 1) % 3];
    if (std::none_of(loop.begin(), loop.end(),
                     [&](std::uint16_t v) { return own_sense_ * sense(c, d, cell.point(v)) > 0; }))
      return false;
  }
  const int facet_sense = -side_of_cell(cell, i) * own_sense_;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point<3>&u = cell.point(loop[k]), &v = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
    if (std::none_of(corners_.begin(), corners_.end(),
                     [&](const Point<3>& x) { return facet_sense * sense(u, v, x) > 0; }))
      return false;
  }
  return true;
}

bool Triangle_in_plane::overlaps(const std::array<Point<3>, 3>& other) const {
  const auto has_beyond = [&](const auto& of, int turn, const auto& points) {
    for (std::size_t k = 0; k < 3; ++k)
      if (std::none_of(points.begin(), points.end(),
                       [&](const Point<3>& x) { return turn * sense(of[k], of[(k + 1) % 3], x) > 0; }))
        return false;
    return true;
  };
  return has_beyond(corners_, own_sense_, other) &&
         has_beyond(other, sense(other[0], other[1], other[2]), corners_);
}

// The half-planes bounded by the sides of the facet, each by the values at the corners of an affine function
// that is positive inside.
void Triangle_in_plane::append_sides(const Cell_view<3>& cell, std::size_t i,
                                     std::vector<Ring_vector<3>>& sides) const {
  const auto loop = cell.loop(i);
  const int facet_sense = -side_of_cell(cell, i) * own_sense_;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point<2> u = drop(cell.point(loop[k])), v = drop(cell.point(loop[(k + 1) % loop.size()]));
    Ring_vector<3>& side = sides.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      side[c] = Exact_value::orientation(u, v, drop(corners_[c]));
      if (facet_sense < 0) side[c] = -side[c];
    }
  }
}

// The triangle is clipped by the sides of both, its points given by their volumes with the corners. Open
// convex sets have a point in common if the rest of the closed ones lies on no side of any of them.
bool Triangle_in_plane::overlaps(const Cell_view<3>& c, std::size_t i, const Cell_view<3>& d,
                                 std::size_t j) const {
  std::vector<Ring_vector<3>> sides = unit_vectors();
  append_sides(c, i, sides);
  append_sides(d, j, sides);
  const std::vector<Ring_vector<3>> polygon = clipped(unit_vectors(), sides);
  return std::none_of(sides.begin(), sides.end(), [&](const Ring_vector<3>& side) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Ring_vector<3>& x) { return CGAL::is_zero(exact_dot(side, x)); });
  });
}

std::vector<Ring_vector<3>> Triangle_in_plane::part_of(const Cell_view<3>& cell, std::size_t i) const {
  std::vector<Ring_vector<3>> sides;
  append_sides(cell, i, sides);
  return clipped(unit_vectors(), sides);
}

bool Triangle_in_plane::overlaps(const Point<3>& u, const Point<3>& v) const {
  bool is_left = false, is_right = false;
  for (const Point<3>& x : corners_) {
    const int s = sense(u, v, x);
    is_left |= s > 0;
    is_right |= s < 0;
  }
  if (!is_left || !is_right) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<3>&c = corners_[k], &d = corners_[(k + 1) % 3];
    if (own_sense_ * sense(c, d, u) <= 0 && own_sense_ * sense(c, d, v) <= 0) return false;
  }
  return true;
}

// An open segment and an open convex polygon are disjoint if and only if the line of the segment, or of a
// side of the polygon, separates them weakly.
bool Triangle_in_plane::has_inside(const Cell_view<3>& cell, std::size_t i, const Point<3>& u,
                                   const Point<3>& v) const {
  const auto loop = cell.loop(i);
  bool is_left = false, is_right = false;
  for (const std::uint16_t k : loop) {
    const int s = sense(u, v, cell.point(k));
    is_left |= s > 0;
    is_right |= s < 0;
  }
  if (!is_left || !is_right) return false;
  const int facet_sense = -side_of_cell(cell, i) * own_sense_;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point<3>&c = cell.point(loop[k]), &d = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
    if (facet_sense * sense(c, d, u) <= 0 && facet_sense * sense(c, d, v) <= 0) return false;
  }
  return true;
}

bool Triangle_in_plane::is_pierced_by(const Cell_view<3>& cell, std::size_t i) const {
  bool is_above = false, is_below = false;
  for (const std::uint16_t v : cell.loop(i)) {
    const int s = side(cell.point(v));
    is_above |= s > 0;
    is_below |= s < 0;
  }
  if (!is_above || !is_below) return false;
  // Tetrahedra on both sides of the triangle: the facet has points inside the triangle if it enters one of
  // them through the triangle, off its sides. The apex may be any point off the plane.
  Point<3> apex = corners_[0];
  apex[axis_] += std::max(1.0, std::abs(apex[axis_]));
  std::vector<Volumes> in_plane;
  for (const Volumes& x : clip(cell, i, {apex, corners_[0], corners_[1], corners_[2]}))
    if (x[0] == 0) in_plane.push_back({1, x[1], x[2], x[3]});
  return !in_plane.empty() && reaches_inside(in_plane);
}

}  // namespace cellwalk::detail
