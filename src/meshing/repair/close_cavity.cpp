// SPDX-License-Identifier: GPL-3.0-or-later
// Two floods that meet at the narrowest places between them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "cavity.h"
#include "changes.h"

namespace cellwalk::detail {
namespace {

/// Gates count this much less for the flood from the hull. In a tube of constant width, the mouth is at its
/// end then. With 1 it may lie anywhere in it, with 0.3 narrow lumens were lost; from 0.5 to 0.8 results
/// agree to 1 %.
constexpr double handicap = 0.7;

/// The radius of the sphere through four points, by the formula of the product of opposite edges.
double circumradius(const Tetgen_result& mesh, std::uint32_t tetrahedron) {
  const auto& t = mesh.tetrahedra[tetrahedron];
  const Point<3>& o = mesh.points[t[0]];
  const Vector<3> a = mesh.points[t[1]] - o, b = mesh.points[t[2]] - o, c = mesh.points[t[3]] - o;
  const double volume = dot(a, cross(b, c));
  if (volume == 0) return std::numeric_limits<double>::infinity();
  const Vector<3> sum = dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b);
  return length(sum) / (2 * std::abs(volume));
}

struct Sphere {
  Point<3> centre;
  double radius;
};

/// The smallest sphere with three points on it.
Sphere smallest_sphere(const Point<3>& p, const Point<3>& q, const Point<3>& r) {
  const Vector<3> a = q - p, b = r - p, n = cross(a, b);
  const double square = dot(n, n);
  if (square == 0) return {p, std::numeric_limits<double>::infinity()};
  const Vector<3> to_centre = (1 / (2 * square)) * (dot(a, a) * cross(b, n) + dot(b, b) * cross(n, a));
  return {p + to_centre, length(to_centre)};
}

/// The width of the way through the facet opposite corner i: the radius of its circle, if the sphere around
/// that is empty, or else of the smaller sphere beside it.
double gate(const Tetgen_result& mesh, std::uint32_t t, int i) {
  const auto n = static_cast<std::uint32_t>(mesh.neighbours[t][i]);
  const Triangle f = opposite(mesh.tetrahedra[t], i);
  const Sphere sphere = smallest_sphere(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]);
  const auto lies_in = [&](std::uint32_t v) {
    return std::find(f.begin(), f.end(), v) == f.end() &&
           length(mesh.points[v] - sphere.centre) < sphere.radius;
  };
  const auto &s = mesh.tetrahedra[t], &u = mesh.tetrahedra[n];
  if (std::none_of(s.begin(), s.end(), lies_in) && std::none_of(u.begin(), u.end(), lies_in))
    return sphere.radius;
  return std::min(circumradius(mesh, t), circumradius(mesh, n));
}

}  // namespace

std::uint32_t locate(const Tetgen_result& mesh, const Point<3>& p) {
  std::uint32_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& c = mesh.tetrahedra[t];
    const std::array<Vector<3>, 4> to{mesh.points[c[0]] - p, mesh.points[c[1]] - p, mesh.points[c[2]] - p,
                                      mesh.points[c[3]] - p};
    const std::array<double, 4> parts{dot(to[1], cross(to[2], to[3])), dot(to[0], cross(to[3], to[2])),
                                      dot(to[3], cross(to[0], to[1])), dot(to[2], cross(to[1], to[0]))};
    const double whole = parts[0] + parts[1] + parts[2] + parts[3];
    const double least = *std::min_element(parts.begin(), parts.end()) / whole;
    if (whole > 0 && least > most) most = least, best = t;
  }
  return best;
}

Cavity close_cavity(const Tetgen_result& mesh, const Labels& labels, const std::vector<Point<3>>& inside) {
  enum : std::uint8_t { nobody, from_inside, from_hull };
  std::vector<std::uint8_t> owner(mesh.tetrahedra.size(), nobody);
  std::vector<bool> is_on_hull(mesh.points.size(), false);
  using Arrival = std::tuple<double, std::uint32_t, std::uint8_t>;  // the width, where, whose
  std::priority_queue<Arrival> arrivals;
  constexpr double widest = std::numeric_limits<double>::infinity();
  for (const Point<3>& p : inside) arrivals.push({widest, locate(mesh, p), from_inside});
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbours[t][i] >= 0) continue;
      for (const std::uint32_t v : opposite(mesh.tetrahedra[t], i)) is_on_hull[v] = true;
      arrivals.push({widest, t, from_hull});
    }
  const auto is_closed = [&](std::uint32_t t, int i) {
    const auto at = labels.find(opposite(mesh.tetrahedra[t], i));
    return at != labels.end() && at->second.part != Part::sheet;
  };
  while (!arrivals.empty()) {
    const auto [width, t, who] = arrivals.top();
    arrivals.pop();
    if (owner[t] != nobody) continue;
    owner[t] = who;
    for (int i = 0; i < 4; ++i) {
      const std::int32_t n = mesh.neighbours[t][i];
      if (n < 0 || owner[n] != nobody || is_closed(t, i)) continue;
      const double here = (who == from_hull ? handicap : 1) * gate(mesh, t, i);
      arrivals.push({std::min(width, here), static_cast<std::uint32_t>(n), who});
    }
  }
  const auto refuse = [&](const Point<3>& p) {
    refuse_surface(
        fmt::format("lies beside the point {} (--inside): no way out of it is narrower than the box "
                    "around the surface; give a point in the free space",
                    describe(p)));
  };
  Cavity cavity{std::vector<bool>(mesh.tetrahedra.size(), false), {}};
  for (const Point<3>& p : inside)
    if (owner[locate(mesh, p)] != from_inside) refuse(p);
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (owner[t] != from_inside) continue;
    cavity.is_inside[t] = true;
    for (int i = 0; i < 4; ++i) {
      const std::int32_t n = mesh.neighbours[t][i];
      if (n < 0 || owner[n] == from_inside || is_closed(t, i)) continue;
      const auto& c = mesh.tetrahedra[t];
      Facet f{{c[(i + 1) & 3], c[(i + 2) & 3], c[(i + 3) & 3]}, Part::mouth, 0};
      if ((i & 1) != 0) turn(f);
      if (std::any_of(c.begin(), c.end(), [&](std::uint32_t v) { return v != c[i] && is_on_hull[v]; }))
        refuse(inside[0]);
      cavity.mouths.push_back(f);
    }
  }
  return cavity;
}

}  // namespace cellwalk::detail
