// SPDX-License-Identifier: GPL-3.0-or-later
// Sides as constraints, and floods between the sides of each triangle.
#include "cut_plane.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace cellwalk::detail {

Cut_plane::Cut_plane(const E::Triangle_3& triangle) : plane_(triangle.supporting_plane()) {
  // Of a needle, the rounded normal may be 0, or along an axis in its plane.
  const std::array<E::FT, 3> normal{plane_.a(), plane_.b(), plane_.c()};
  for (int k = 1; k < 3; ++k)
    if (CGAL::abs(normal[k]) > CGAL::abs(normal[axis_])) axis_ = k;
}

std::size_t Cut_plane::add(const E::Triangle_3& triangle, const Triangle& corners) {
  Member member{{}, corners};
  for (int k = 0; k < 3; ++k) {
    member.corners[k] = triangulation_.insert(seen(triangle[k]));
    std::uint32_t& number = member.corners[k]->info().value;
    if (number == none) number = corners[k];
  }
  for (int k = 0; k < 3; ++k)
    triangulation_.insert_constraint(member.corners[k], member.corners[(k + 1) % 3]);
  members_.push_back(member);
  return members_.size() - 1;
}

void Cut_plane::insert(const Trace& trace) {
  const Vertex from = triangulation_.insert(seen(trace.first));
  if (trace.first == trace.second) return;
  const Vertex to = triangulation_.insert(seen(trace.second));
  if (from != to) triangulation_.insert_constraint(from, to);
}

bool Cut_plane::is_near(const E::Point_3& p, double distance) const {
  return std::abs(CGAL::to_double(lifted(seen(p))[axis_] - p[axis_])) <= distance;
}

bool Cut_plane::contains(const E::Triangle_3& triangle, double distance) const {
  return is_near(triangle[0], distance) && is_near(triangle[1], distance) && is_near(triangle[2], distance);
}

Exact_kernel::Triangle_3 Cut_plane::snapped(const E::Triangle_3& other, double distance) const {
  std::array<E::Point_3, 3> p{other[0], other[1], other[2]};
  for (E::Point_3& q : p)
    if (is_near(q, distance)) q = lifted(seen(q));
  return E().collinear_3_object()(p[0], p[1], p[2]) ? other : E::Triangle_3(p[0], p[1], p[2]);
}

std::vector<Exact_kernel::Point_3> Cut_plane::points_on_side(std::size_t triangle, int k) const {
  const std::vector<Vertex> vertices = side(members_[triangle], k);
  std::vector<E::Point_3> points;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) points.push_back(lifted(vertices[i]->point()));
  return points;
}

std::vector<Triangle> Cut_plane::parts(std::size_t triangle,
                                       const std::function<std::uint32_t(const E::Point_3&)>& number) const {
  const Member& member = members_[triangle];
  std::set<std::pair<Vertex, Vertex>> sides;
  Vertex second;
  for (int k = 0; k < 3; ++k) {
    const std::vector<Vertex> vertices = side(member, k);
    if (k == 0) second = vertices[1];
    for (std::size_t i = 1; i < vertices.size(); ++i) sides.insert(std::minmax(vertices[i - 1], vertices[i]));
  }
  const bool is_turned = !E().left_turn_2_object()(member.corners[0]->point(), member.corners[1]->point(),
                                                   member.corners[2]->point());
  Face start;
  int opposite = 0;
  triangulation_.is_edge(member.corners[0], second, start, opposite);
  // The face on the inner side of the first edge.
  const bool runs_on = start->vertex(Triangulation::ccw(opposite)) == member.corners[0];
  if (runs_on == is_turned) start = start->neighbor(opposite);
  const auto number_of = [&](Vertex v) {
    for (int k = 0; k < 3; ++k)
      if (v == member.corners[k]) return member.numbers[k];
    return v->info().value == none ? number(lifted(v->point())) : v->info().value;
  };
  std::set<Face> seen_faces{start};
  std::vector<Face> stack{start};
  std::vector<Triangle> parts;
  while (!stack.empty()) {
    const Face face = stack.back();
    stack.pop_back();
    Triangle part;
    for (int i = 0; i < 3; ++i) {
      part[i] = number_of(face->vertex(i));
      const Face next = face->neighbor(i);
      if (!sides.contains(
              std::minmax(face->vertex(Triangulation::ccw(i)), face->vertex(Triangulation::cw(i)))) &&
          seen_faces.insert(next).second)
        stack.push_back(next);
    }
    if (is_turned) std::swap(part[1], part[2]);
    if (part[0] != part[1] && part[1] != part[2] && part[2] != part[0]) parts.push_back(part);
  }
  return parts;
}

Exact_kernel::Point_2 Cut_plane::seen(const E::Point_3& p) const {
  return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]};
}

Exact_kernel::Point_3 Cut_plane::lifted(const E::Point_2& p) const {
  const std::array<E::FT, 3> normal{plane_.a(), plane_.b(), plane_.c()};
  const int u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
  std::array<E::FT, 3> x;
  x[u] = p.x(), x[v] = p.y();
  x[axis_] = -(normal[u] * p.x() + normal[v] * p.y() + plane_.d()) / normal[axis_];
  return {x[0], x[1], x[2]};
}

std::vector<Cut_plane::Vertex> Cut_plane::side(const Member& member, int k) const {
  const Vertex end = member.corners[(k + 1) % 3];
  std::vector<Vertex> vertices{member.corners[k]};
  while (vertices.back() != end) {
    const Vertex at = vertices.back();
    auto around = triangulation_.incident_vertices(at);
    const auto first = around;
    Vertex next = end;
    do {
      const Vertex v = around;
      if (triangulation_.is_infinite(v) || v == at) continue;
      if (v == end ||
          (E().collinear_2_object()(at->point(), v->point(), end->point()) &&
           E().collinear_are_ordered_along_line_2_object()(at->point(), v->point(), end->point()))) {
        next = v;
        break;
      }
    } while (++around != first);
    vertices.push_back(next);
  }
  return vertices;
}

}  // namespace cellwalk::detail
