// SPDX-License-Identifier: LGPL-3.0-or-later
// Blades: the conditions on their points and pieces, and how they are made.
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "blade_side.h"

namespace cellwalk {
namespace {

/// A corner counts as in a plane, or on a side, if its distance is at most this share of the size of the
/// polygon: rounded corners span no plane exactly. Nothing needs to lie on a blade.
constexpr double flatness = 1e-9;
/// The distance may also be this many units in the last place of its largest coordinate, far from the origin.
constexpr double flatness_ulps = 4;

[[noreturn]] void refuse(const std::string& what) { throw Error(Error_code::input, what); }

template <int D>
void check_points(std::span<const Point<D>> points, std::size_t least) {
  if (points.size() < least) refuse("a blade has at least " + std::to_string(least) + " points");
  for (const Point<D>& x : points) detail::check_finite(x, "a point of the blade");
}

/// Points in doubles that neither overflow nor underflow, and how far off each other they count as one.
struct Scaled_points {
  explicit Scaled_points(std::span<const Point<3>> points) : x(points.begin(), points.end()) {
    double largest = 0;
    for (const Point<3>& p : x)
      for (const double c : p) largest = std::max(largest, std::abs(c));
    if (largest == 0) return;
    const int exponent = std::ilogb(largest);
    double size = 0;
    for (Point<3>& p : x) {
      for (double& c : p) c = std::ldexp(c, -exponent);
      size = std::max(size, length(p - x.front()));
    }
    slack = flatness * size + flatness_ulps * 0x1p-52;
  }

  std::vector<Point<3>> x;
  double slack = 0;
};

/// The index of the point farthest from the first one.
std::size_t farthest(const std::vector<Point<3>>& x) {
  return static_cast<std::size_t>(
      std::ranges::max_element(x, {}, [&](const Point<3>& p) { return length(p - x[0]); }) - x.begin());
}

/// The widest triangle of the first point, the one farthest from it, and another one: its normal, of the
/// length of its height; zero if all lie in line.
Vector<3> widest_normal(const Scaled_points& of) {
  const Vector<3> along = normalized(of.x[farthest(of.x)] - of.x[0], Vector<3>{});
  Vector<3> widest{};
  for (const Point<3>& p : of.x)
    if (const Vector<3> normal = cross(along, p - of.x[0]); length(normal) > length(widest)) widest = normal;
  return length(widest) > of.slack ? widest : Vector<3>{};
}

bool has_extent(const std::array<Point<2>, 2>& piece) { return piece[0] != piece[1]; }
bool has_extent(const std::array<Point<3>, 3>& piece) {
  return widest_normal(Scaled_points(piece)) != Vector<3>{};
}

/// True if a point lies between two others, but for rounding.
bool is_between(const Point<3>& a, const Point<3>& p, const Point<3>& b, double slack) {
  const Vector<3> along = b - a;
  const double square = dot(along, along);
  const double share = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return length(p - (a + share * along)) <= slack;
}

/// The corners of a convex polygon, in order, without those that lie on its sides.
/// \throw Error(input) for a polygon that is none
std::vector<std::uint32_t> convex_corners(std::span<const Point<3>> points) {
  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t k = 0; k < count; ++k)
    if (points[k] == points[(k + 1) % count])
      refuse("corners " + std::to_string(k) + " and " + std::to_string((k + 1) % count) +
             " of the blade coincide: give each corner once");
  const Scaled_points scaled(points);
  const std::vector<Point<3>>& x = scaled.x;
  const double slack = scaled.slack;
  const Vector<3> normal = normalized(widest_normal(scaled), Vector<3>{});
  if (normal == Vector<3>{}) refuse("the corners of the blade lie in line: give a polygon with an extent");
  const auto height = [&](std::uint32_t k) { return std::abs(dot(normal, x[k] - x[0])); };
  std::vector<std::uint32_t> corners(count);
  for (std::uint32_t k = 0; k < count; ++k) corners[k] = k;
  if (const std::uint32_t off = *std::ranges::max_element(corners, {}, height); height(off) > slack)
    refuse("corner " + std::to_string(off) +
           " of the blade lies off the plane of others: give a planar polygon, or triangles");

  std::vector<std::uint32_t> kept;
  for (const std::uint32_t k : corners)
    if (!is_between(x[kept.empty() ? count - 1 : kept.back()], x[k], x[(k + 1) % count], slack))
      kept.push_back(k);
  // Seen along the axis nearest to the normal, exactly.
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  const auto seen = [&](std::size_t k) {
    const Point<3>& p = x[kept[k % kept.size()]];
    return Point<2>{p[(axis + 1) % 3], p[(axis + 2) % 3]};
  };
  Predicate_counts counts;
  int sense = 0;
  std::size_t lowest = 0;  // corners lower than those beside them: one, if it winds around once
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const Point<2> a = seen(k + kept.size() - 1), b = seen(k), c = seen(k + 1);
    const int turn = Exact::orientation(counts, a, b, c);
    if (sense == 0) sense = turn;
    if (turn == 0 || turn != sense)
      refuse("the blade is not convex at corner " + std::to_string(kept[k]) +
             ": give the corners of a convex polygon in order around it, or several blades");
    lowest += b < a && b < c;
  }
  if (lowest != 1) refuse("the blade winds around more than once: give each corner once, in order around it");
  return kept;
}

}  // namespace

template <int D>
Blade<D> blade_along(std::span<const Point<D>> points) {
  check_points<D>(points, D);
  Blade<D> blade;
  blade.points.assign(points.begin(), points.end());
  if constexpr (D == 2) {
    for (std::uint32_t k = 1; k < points.size(); ++k) blade.pieces.push_back({k - 1, k});
  } else {
    const std::vector<std::uint32_t> corners = convex_corners(points);
    for (std::size_t k = 2; k < corners.size(); ++k)
      blade.pieces.push_back({corners[0], corners[k - 1], corners[k]});
  }
  detail::check_blade(blade);
  return blade;
}

Blade<3> swept_blade(std::span<const Point<3>> line, const Vector<3>& displacement) {
  check_points<3>(line, 2);
  if (!is_finite(displacement) || !(length(displacement) > 0))
    refuse("a blade is swept by a displacement of some finite length");
  Blade<3> blade;
  for (const Point<3>& x : line) {
    blade.points.push_back(x);
    blade.points.push_back(x + displacement);
  }
  for (std::uint32_t k = 3; k < blade.points.size(); k += 2) {
    blade.pieces.push_back({k - 3, k - 1, k - 2});
    blade.pieces.push_back({k - 2, k - 1, k});
  }
  detail::check_blade(blade);
  return blade;
}

template Blade<2> blade_along(std::span<const Point<2>>);
template Blade<3> blade_along(std::span<const Point<3>>);

template <int D>
void detail::check_blade(const Blade<D>& blade) {
  check_points<D>(blade.points, 0);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;  // as pieces run along them
  for (const auto& piece : blade.pieces) {
    std::array<Point<D>, static_cast<std::size_t>(D)> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (piece[k] >= blade.points.size())
        refuse("a piece of the blade names point " + std::to_string(piece[k]) + " of " +
               std::to_string(blade.points.size()));
      corners[k] = blade.points[piece[k]];
    }
    if (!has_extent(corners))
      refuse("a piece of the blade has no extent: its corners coincide or lie in line");
    for (std::size_t k = 0; k < corners.size(); ++k) {
      // In the plane pieces begin, and end, at a point.
      const std::uint32_t next = D == 3 ? piece[(k + 1) % 3] : static_cast<std::uint32_t>(k);
      if (!edges.emplace(piece[k], next).second)
        refuse("pieces of the blade do not agree about its sides: let each edge be passed once either way");
    }
  }
}

template void detail::check_blade(const Blade<2>&);
template void detail::check_blade(const Blade<3>&);

}  // namespace cellwalk
