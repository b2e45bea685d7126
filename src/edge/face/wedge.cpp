// SPDX-License-Identifier: LGPL-3.0-or-later
// The first point of a swept triangle that a wall in its plane covers, and the contact there.
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/wedge.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <utility>

#include "broad_phase.h"
#include "edge/exact/rational_segment.h"
#include "triangle_in_plane.h"

namespace cellwalk::detail {
namespace {

/// Where an edge that sweeps a triangle first meets a wall in the plane of the triangle.
struct Wall_meeting {
  Fraction time;
  Exact_point<3> point;
  Facet_feature feature;
  Half_facet wall;

  bool is_before(const Wall_meeting& other) const {
    if (time < other.time || other.time < time) return time < other.time;
    if (feature.kind != other.feature.kind) return feature.kind < other.feature.kind;
    return wall < other.wall;
  }
};

/// \param x multiples of the coordinates with respect to the corners
Exact_point<3> point_at(const Ring_vector<3>& x, const std::array<Point<3>, 3>& corners) {
  Exact_point<3> point;
  point.denominator = x[0] + x[1] + x[2];
  for (std::size_t i = 0; i < 3; ++i) {
    point.numerator[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) point.numerator[i] += x[k] * Ring(corners[k][i]);
  }
  return point;
}

/// The first of the corners of a part of the triangle abq. The time is constant on lines through q, so that
/// one of them off q is met first.
std::optional<Wall_meeting> first_wall_meeting(const Snapshot<3>& snapshot, Half_facet wall,
                                               const Triangle_in_plane& triangle) {
  const Cell_view<3> cell = snapshot.view(snapshot.cell_of(wall));
  const std::size_t i = snapshot.facet_of(wall);
  std::optional<Wall_meeting> first;
  for (const Ring_vector<3>& x : triangle.part_of(cell, i)) {
    const Ring moving = x[0] + x[1];
    if (CGAL::is_zero(moving)) continue;
    const Exact_point<3> point = point_at(x, triangle.corners());
    Wall_meeting met{Fraction(x[1], moving), point, lowest_feature<3>(cell, i, point), wall};
    if (!first || met.is_before(*first)) first = std::move(met);
  }
  return first;
}

/// Of the edge at a time, in the plane of its motion from a to b, against the motion; rounded.
Vector<3> normal_against(const Point<3>& a, const Point<3>& b, const Point<3>& q, double time) {
  const Vector<3> edge = q - (a + time * (b - a)), back = a - b;
  const double square = dot(edge, edge);
  Vector<3> normal = square > 0 ? back - (dot(back, edge) / square) * edge : back;
  if (!(dot(normal, normal) > 0)) normal = back;
  return normalized(normal);
}

}  // namespace

std::optional<Contact<3>> wall_in_wedge(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                                        const Point<3>& q, Face_counts& counts) {
  const Point<3>&a = path.from.position, &b = path.to.position;
  if (are_collinear(a, b, q)) return {};
  Candidate_walls candidates(path.from.cell);
  find_candidate_walls(snapshot, {a, b, q, q}, candidates, counts);
  if (candidates.walls.empty()) return {};
  const Triangle_in_plane triangle({a, b, q}, counts.walk);
  std::optional<Wall_meeting> first;
  for (const Half_facet wall : candidates.walls) {
    const Cell_view<3> cell = snapshot.view(snapshot.cell_of(wall));
    const std::size_t i = snapshot.facet_of(wall);
    if (!triangle.holds(cell, i) || !triangle.overlaps(cell, i)) continue;
    ++counts.clipped;
    std::optional<Wall_meeting> met = first_wall_meeting(snapshot, wall, triangle);
    if (met && (!first || met->is_before(*first))) first = std::move(met);
  }
  if (!first) return {};
  Contact<3> contact;
  contact.set_time(to_time(first->time));
  contact.point = first->point.rounded();
  contact.kind = first->feature.kind;
  contact.corner = first->feature.corner;
  contact.body = Body_feature::edge;
  contact.facet = first->wall;
  contact.cell = snapshot.cell_of(first->wall);
  contact.normal = normal_against(a, b, q, to_double(first->time));
  return contact;
}

}  // namespace cellwalk::detail
