// SPDX-License-Identifier: LGPL-3.0-or-later
// Balls, tubes, arrows, discs and surfaces cut into triangles with normals.
#include <cellwalk/internal/drawing/drawing.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace cellwalk::drawing {
namespace {

constexpr int levels[] = {finest_sides, 12, 8, 6, 4, 3};  // of detail
constexpr int round_ends_from = 6;                        // sides
constexpr double head_length = 0.35;                      // of an arrow
constexpr double head_radius = 2.6;                       // in radii of its shaft
constexpr Vector<3> out_of_plane{0, 0, 1};

Vector<3> unit(const Vector<3>& v) { return normalized(v, out_of_plane); }

/// A unit vector orthogonal to the unit vector `axis`.
Vector<3> orthogonal(const Vector<3>& axis) {
  const int least =
      static_cast<int>(std::min_element(axis.begin(), axis.end(),
                                        [](double a, double b) { return std::abs(a) < std::abs(b); }) -
                       axis.begin());
  Vector<3> e{};
  e[static_cast<std::size_t>(least)] = 1;
  return unit(cross(axis, e));
}

void add(Drawing& drawing, const std::array<Point<3>, 3>& corners, const std::array<Vector<3>, 3>& normals,
         std::uint32_t material) {
  drawing.triangles.push_back({corners, normals, material});
}

int ball_rings(int sides) { return std::max(2, sides / 2); }
/// Discs are seen from the front, where corners show.
int disc_sides(int sides) { return sides * 8 / 5; }

std::size_t count(int triangles) { return static_cast<std::size_t>(triangles); }
std::size_t ball_triangles(int sides) { return count(2 * sides * (ball_rings(sides) - 1)); }

/// Those in use are the first ones.
struct Cross_section {
  std::array<Vector<3>, finest_sides> directions;
};

/// Directions around `axis`, the first one closest to `start`.
Cross_section make_ring(const Vector<3>& axis, const Vector<3>& start, int sides) {
  const Vector<3> u = unit(start - dot(start, axis) * axis), v = cross(axis, u);
  Cross_section ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    ring.directions[static_cast<std::size_t>(i)] = std::cos(angle) * u + std::sin(angle) * v;
  }
  return ring;
}

/// The side of a cone or cylinder between two rings. `slope` inclines the normals along the axis from a to b.
void add_side(Drawing& drawing, const Point<3>& a, double radius_a, const Cross_section& ring_a,
              const Point<3>& b, double radius_b, const Cross_section& ring_b, std::uint32_t material) {
  const Vector<3> axis = unit(b - a);
  const double lean = (radius_a - radius_b) / std::max(length(b - a), 1e-300);
  const std::size_t sides = count(drawing.sides);
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t j = (i + 1) % sides;
    const std::array<Point<3>, 4> p{a + radius_a * ring_a.directions[i], a + radius_a * ring_a.directions[j],
                                    b + radius_b * ring_b.directions[j], b + radius_b * ring_b.directions[i]};
    const std::array<Vector<3>, 4> n{
        unit(ring_a.directions[i] + lean * axis), unit(ring_a.directions[j] + lean * axis),
        unit(ring_b.directions[j] + lean * axis), unit(ring_b.directions[i] + lean * axis)};
    add(drawing, {p[0], p[1], p[2]}, {n[0], n[1], n[2]}, material);
    add(drawing, {p[0], p[2], p[3]}, {n[0], n[2], n[3]}, material);
  }
}

}  // namespace

std::size_t triangles_of(const Round_shapes& shapes, int sides, bool flat) {
  const std::size_t ends = sides >= round_ends_from ? shapes.ends : 0;
  const std::size_t round = flat ? count(disc_sides(sides)) : ball_triangles(sides);
  return (shapes.balls + ends) * round + shapes.pieces * (flat ? 2 : count(2 * sides));
}

int sides_within(const Round_shapes& shapes, std::size_t budget, bool flat) {
  for (const int sides : levels)
    if (triangles_of(shapes, sides, flat) <= budget) return sides;
  return std::end(levels)[-1];
}

void add_ball(Drawing& drawing, const Point<3>& centre, double radius, std::uint32_t material) {
  const int sides = drawing.sides, rings = ball_rings(sides);
  const auto direction = [&](int ring, int side) {
    const double polar = std::numbers::pi * ring / rings, angle = 2 * std::numbers::pi * side / sides;
    return Vector<3>{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const std::array<Vector<3>, 4> n{direction(r, s), direction(r + 1, s), direction(r + 1, s + 1),
                                       direction(r, s + 1)};
      const auto at = [&](std::size_t i) { return centre + radius * n[i]; };
      if (r + 1 < rings) add(drawing, {at(0), at(1), at(2)}, {n[0], n[1], n[2]}, material);
      if (r > 0) add(drawing, {at(0), at(2), at(3)}, {n[0], n[2], n[3]}, material);
    }
}

void add_tube(Drawing& drawing, std::span<const Point<3>> line, double radius, std::uint32_t material) {
  std::vector<Point<3>> points;
  for (const Point<3>& p : line)
    if (points.empty() || length(p - points.back()) > 0) points.push_back(p);
  if (points.empty()) return;
  const bool has_round_ends = drawing.sides >= round_ends_from;
  if (has_round_ends || points.size() == 1) add_ball(drawing, points.front(), radius, material);
  if (points.size() == 1) return;
  if (has_round_ends) add_ball(drawing, points.back(), radius, material);
  Vector<3> start = orthogonal(unit(points[1] - points[0]));
  Cross_section previous;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector<3> in = unit(points[i] - points[i == 0 ? 0 : i - 1]);
    const Vector<3> out = unit(points[i + 1 == points.size() ? i : i + 1] - points[i]);
    Vector<3> axis = i == 0 ? out : i + 1 == points.size() ? in : in + out;
    axis = length(axis) > 1e-6 ? unit(axis) : out;  // a reversal has no middle direction
    // The ring's start is carried along, so that the tube does not twist.
    if (length(cross(start, axis)) < 1e-6) start = orthogonal(axis);
    const Cross_section ring = make_ring(axis, start, drawing.sides);
    start = ring.directions[0];
    if (i > 0) add_side(drawing, points[i - 1], radius, previous, points[i], radius, ring, material);
    previous = ring;
  }
}

void add_arrow(Drawing& drawing, const Point<3>& tail, const Vector<3>& direction, double arrow_length,
               double radius, std::uint32_t material) {
  const Vector<3> axis = unit(direction);
  const Cross_section ring = make_ring(axis, orthogonal(axis), drawing.sides);
  const std::size_t sides = count(drawing.sides);
  const Point<3> neck = tail + ((1 - head_length) * arrow_length) * axis, tip = tail + arrow_length * axis;
  add_side(drawing, tail, radius, ring, neck, radius, ring, material);
  add_side(drawing, neck, head_radius * radius, ring, tip, 0, ring, material);
  const Vector<3> back = -1.0 * axis;
  for (std::size_t i = 0; i < sides; ++i)  // the base of the head
    add(drawing,
        {neck, neck + (head_radius * radius) * ring.directions[i],
         neck + (head_radius * radius) * ring.directions[(i + 1) % sides]},
        {back, back, back}, material);
}

void add_surface(Drawing& drawing, std::span<const Point<3>> points,
                 std::span<const std::vector<std::uint32_t>> facets, std::uint32_t material, double crease) {
  // Newell's sum: the facet's normal times twice its area, so that averages are weighted by area.
  std::vector<Vector<3>> weighted(facets.size());
  std::vector<std::vector<std::uint32_t>> facets_of(points.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& loop = facets[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      facets_of[loop[i]].push_back(static_cast<std::uint32_t>(f));
      weighted[f] = weighted[f] + cross(points[loop[i]] - points[loop[0]],
                                        points[loop[(i + 1) % loop.size()]] - points[loop[0]]);
    }
  }
  std::size_t triangles = drawing.triangles.size();
  for (const auto& loop : facets) triangles += loop.size() - 2;
  // Surfaces are many in some drawings: to reserve for each just its own would copy the others every time.
  if (triangles > 2 * drawing.triangles.capacity()) drawing.triangles.reserve(triangles);
  const double smallest_cosine = std::cos(crease * std::numbers::pi / 180);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& loop = facets[f];
    const Vector<3> flat = unit(weighted[f]);
    std::vector<Vector<3>> normals;
    for (const std::uint32_t p : loop) {
      Vector<3> sum = weighted[f];
      for (const std::uint32_t g : facets_of[p])
        if (g != f && dot(unit(weighted[g]), flat) > smallest_cosine) sum = sum + weighted[g];
      normals.push_back(unit(sum));
    }
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      add(drawing, {points[loop[0]], points[loop[i]], points[loop[i + 1]]},
          {normals[0], normals[i], normals[i + 1]}, material);
  }
}

void add_disc(Drawing& drawing, const Point<2>& centre, double radius, double height,
              std::uint32_t material) {
  const int sides = disc_sides(drawing.sides);
  const auto at = [&](int side) {
    const double angle = 2 * std::numbers::pi * side / sides;
    return Point<3>{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle), height};
  };
  for (int s = 0; s < sides; ++s)
    add(drawing, {Point<3>{centre[0], centre[1], height}, at(s), at(s + 1)},
        {out_of_plane, out_of_plane, out_of_plane}, material);
}

void add_flat_line(Drawing& drawing, const Point<2>& a, const Point<2>& b, double width, double height,
                   std::uint32_t material) {
  const double l = length(b - a);
  const bool has_round_ends = drawing.sides >= round_ends_from;
  if (has_round_ends || !(l > 0)) add_disc(drawing, a, width / 2, height, material);
  if (!(l > 0)) return;
  if (has_round_ends) add_disc(drawing, b, width / 2, height, material);
  const Vector<2> side = (width / 2 / l) * Vector<2>{a[1] - b[1], b[0] - a[0]};
  const auto lift = [height](const Point<2>& p) { return Point<3>{p[0], p[1], height}; };
  const std::array<Point<3>, 4> p{lift(a - side), lift(b - side), lift(b + side), lift(a + side)};
  add(drawing, {p[0], p[1], p[2]}, {out_of_plane, out_of_plane, out_of_plane}, material);
  add(drawing, {p[0], p[2], p[3]}, {out_of_plane, out_of_plane, out_of_plane}, material);
}

void add_flat_arrow(Drawing& drawing, const Point<2>& tail, const Vector<2>& direction, double arrow_length,
                    double width, double height, std::uint32_t material) {
  const double l = length(direction);
  if (!(l > 0)) return;
  const Vector<2> axis = (1 / l) * direction, side{-axis[1], axis[0]};
  const Point<2> neck = tail + ((1 - head_length) * arrow_length) * axis, tip = tail + arrow_length * axis;
  add_flat_line(drawing, tail, neck, width, height, material);
  const Point<2> left = neck + (head_radius * width / 2) * side,
                 right = neck - (head_radius * width / 2) * side;
  const auto lift = [height](const Point<2>& p) { return Point<3>{p[0], p[1], height}; };
  add(drawing, {lift(right), lift(tip), lift(left)}, {out_of_plane, out_of_plane, out_of_plane}, material);
}

}  // namespace cellwalk::drawing
