// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for a point that sees all triangles of a cell: a vertex, a mean or the middle of the kernel.
#include "star.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace cellwalk::detail {
namespace {

constexpr std::uint32_t no_vertex = 0xffffffffu;

bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

bool share_edge(const Triangle& s, const Triangle& t) {
  return (has(s, t[0]) + has(s, t[1]) + has(s, t[2])) >= 2;
}

/// The triangles as seen from one point.
class Viewpoint {
 public:
  Viewpoint(Predicate_counts& counts, std::span<const Point<3>> points, const Point<3>& eye)
      : counts_(counts), points_(points), eye_(eye) {}

  bool sees_inside(const Triangle& t) const {
    return Exact::orientation(counts_, points_[t[0]], points_[t[1]], points_[t[2]], eye_) < 0;
  }

  /// True if the open cones over two triangles are disjoint. A plane through the eye separates them, and can
  /// be rotated until it contains two of their vertices.
  bool are_apart(const Triangle& s, const Triangle& t) const {
    // They lie on different sides of a common edge, since both are seen from inside.
    if (share_edge(s, t)) return true;
    for (int i = 0; i < 3; ++i) {
      if (separates(s[i], s[(i + 1) % 3], s, t) || separates(t[i], t[(i + 1) % 3], s, t)) return true;
      for (int j = 0; j < 3; ++j)
        if (separates(s[i], t[j], s, t)) return true;
    }
    return false;
  }

 private:
  /// True if the plane through the eye, a and b has s on one closed side and t on the other.
  bool separates(std::uint32_t a, std::uint32_t b, const Triangle& s, const Triangle& t) const {
    if (a == b) return false;
    int side_of_s = 0, side_of_t = 0;
    for (const auto& [triangle, side] : {std::pair{&s, &side_of_s}, std::pair{&t, &side_of_t}})
      for (const std::uint32_t v : *triangle) {
        if (v == a || v == b) continue;
        const int sign = Exact::orientation(counts_, eye_, points_[a], points_[b], points_[v]);
        if (sign * *side < 0) return false;
        if (sign != 0) *side = sign;
      }
    return side_of_s * side_of_t < 0;  // neither lies in the plane: their tetrahedra are positive
  }

  Predicate_counts& counts_;
  std::span<const Point<3>> points_;
  const Point<3>& eye_;
};

/// True if the tetrahedra from `eye` (the vertex `apex`, unless it is no_vertex) over all triangles without
/// apex are positive and do not overlap.
bool is_star(Predicate_counts& counts, std::span<const Point<3>> points, const Triangulation& surface,
             const Point<3>& eye, std::uint32_t apex) {
  const Viewpoint view(counts, points, eye);
  for (const Triangle& t : surface)
    if (!has(t, apex) && !view.sees_inside(t)) return false;
  for (std::size_t i = 0; i < surface.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!has(surface[i], apex) && !has(surface[j], apex) && !view.are_apart(surface[i], surface[j]))
        return false;
  return true;
}

std::vector<std::uint32_t> vertices_of(const Triangulation& surface) {
  std::vector<std::uint32_t> vertices;
  for (const Triangle& t : surface) vertices.insert(vertices.end(), t.begin(), t.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// True if every edge is used once in each direction; diagonals of different facets may coincide.
bool is_edge_manifold(const Triangulation& surface) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& t : surface)
    for (int i = 0; i < 3; ++i) edges.push_back({t[i], t[(i + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
         std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
           return std::binary_search(edges.begin(), edges.end(), std::array<std::uint32_t, 2>{e[1], e[0]});
         });
}

struct Half_space {
  Vector<3> normal;
  double offset;
};

}  // namespace

bool middle_of_kernel(std::span<const Point<3>> points, const Triangulation& surface, Point<3>& middle) {
  // All corners of the kernel are intersections of three planes; the cost grows with the fourth power of
  // their number.
  constexpr std::size_t most_triangles = 96;
  // Slack for rounding, in units of the cell's size: candidates only, the signs decide.
  constexpr double slack = 1e-12;
  if (surface.size() > most_triangles) return false;
  const Point<3> origin = points[surface[0][0]];
  double size = 0;
  for (const Triangle& t : surface)
    for (const std::uint32_t v : t) size = std::max(size, length(points[v] - origin));
  boost::container::small_vector<Half_space, 16> planes;
  for (const Triangle& t : surface) {
    const Point<3> a = (1 / size) * (points[t[0]] - origin), b = (1 / size) * (points[t[1]] - origin),
                   c = (1 / size) * (points[t[2]] - origin);
    Vector<3> normal = cross(b - a, c - a);
    const double norm = length(normal);
    if (!(norm > 0)) return false;
    normal = (1 / norm) * normal;
    planes.push_back({normal, dot(normal, a)});
  }
  Vector<3> sum{};
  double corners = 0;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector<3> direction = cross(planes[i].normal, planes[j].normal);
      for (std::size_t k = 0; k < j; ++k) {
        const double determinant = dot(direction, planes[k].normal);
        if (std::abs(determinant) < slack) continue;
        const Vector<3> corner =
            (1 / determinant) *
            (planes[k].offset * direction + planes[i].offset * cross(planes[j].normal, planes[k].normal) +
             planes[j].offset * cross(planes[k].normal, planes[i].normal));
        if (std::any_of(planes.begin(), planes.end(),
                        [&](const Half_space& h) { return dot(h.normal, corner) > h.offset + slack; }))
          continue;
        sum = sum + corner;
        ++corners;
      }
    }
  if (corners == 0) return false;
  middle = origin + (size / corners) * sum;
  return is_finite(middle);
}

double enclosed_volume(std::span<const Point<3>> points, const Triangulation& surface) {
  const Point<3>& o = points[surface[0][0]];
  double volume = 0;
  for (const Triangle& t : surface)
    volume += dot(points[t[0]] - o, cross(points[t[1]] - o, points[t[2]] - o)) / 6;
  return volume;
}

Star find_star(Predicate_counts& counts, std::span<const Point<3>> points, const Triangulation& surface) {
  if (!is_edge_manifold(surface)) return {};
  const std::vector<std::uint32_t> vertices = vertices_of(surface);
  for (const std::uint32_t v : vertices)
    if (is_star(counts, points, surface, points[v], v)) return {true, true, v, {}};

  Point<3> mean_of_vertices{}, mean_of_triangles{};
  for (const std::uint32_t v : vertices)
    mean_of_vertices = mean_of_vertices + (1.0 / static_cast<double>(vertices.size())) * points[v];
  for (const Triangle& t : surface)
    for (const std::uint32_t v : t)
      mean_of_triangles = mean_of_triangles + (1.0 / static_cast<double>(3 * surface.size())) * points[v];
  for (const Point<3>& eye : {mean_of_vertices, mean_of_triangles})
    if (is_star(counts, points, surface, eye, no_vertex)) return {true, false, no_vertex, eye};
  Point<3> middle;
  if (middle_of_kernel(points, surface, middle) && is_star(counts, points, surface, middle, no_vertex))
    return {true, false, no_vertex, middle};
  return {};
}

}  // namespace cellwalk::detail
