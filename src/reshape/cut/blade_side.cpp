// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact signs of edges and points with respect to the pieces of a blade.
#include "blade_side.h"

#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

int sign(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  Predicate_counts counts;
  return Exact::orientation(counts, a, b, c);
}
int sign(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  Predicate_counts counts;
  return Exact::orientation(counts, a, b, c, d);
}

std::optional<double> passes_piece(const std::array<Point<2>, 2>& p, const Point<2>& u, const Point<2>& v) {
  if (sign(p[0], p[1], u) * sign(p[0], p[1], v) >= 0 || sign(u, v, p[0]) * sign(u, v, p[1]) > 0)
    return std::nullopt;
  return crossing_time<2>({u, v, p});
}

std::optional<double> passes_piece(const std::array<Point<3>, 3>& p, const Point<3>& u, const Point<3>& v) {
  if (sign(p[0], p[1], p[2], u) * sign(p[0], p[1], p[2], v) >= 0) return std::nullopt;
  int low = 0, high = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int s = sign(u, v, p[k], p[(k + 1) % 3]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  if (low < 0 && high > 0) return std::nullopt;
  return crossing_time<3>({u, v, p});
}

bool lies_on_piece(const std::array<Point<2>, 2>& p, const Point<2>& x) {
  return on_segment<2>(p[0], p[1], x);
}
bool lies_on_piece(const std::array<Point<3>, 3>& p, const Point<3>& x) {
  return sign(p[0], p[1], p[2], x) == 0 && in_convex_polygon(p, x);
}

Point<2> nearest_on(const std::array<Point<2>, 2>& p, const Vector<2>&, const Point<2>& x) {
  const Vector<2> along = p[1] - p[0];
  return p[0] + std::clamp(dot(x - p[0], along) / dot(along, along), 0.0, 1.0) * along;
}

Point<3> nearest_on(const std::array<Point<3>, 3>& p, const Vector<3>& normal, const Point<3>& x) {
  const Point<3> foot = x + (-dot(x - p[0], normal)) * normal;
  bool is_inside = true;
  Point<3> best = p[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<3>&a = p[k], &b = p[(k + 1) % 3];
    is_inside = is_inside && dot(cross(b - a, foot - a), normal) >= 0;
    const Vector<3> along = b - a;
    const Point<3> near = a + std::clamp(dot(x - a, along) / dot(along, along), 0.0, 1.0) * along;
    if (length(x - near) < least) {
      least = length(x - near);
      best = near;
    }
  }
  return is_inside ? foot : best;
}

/// In doubles, the distance of a point from a piece is off by some 2^-50 of that from its corners. Where they
/// are no farther off than this multiple of the size of the environment, that is 2^-30 of this size, much
/// less than cells are wide.
constexpr double farthest = 0x1p20;

Vector<2> normal_of(const std::array<Point<2>, 2>& p) { return unit_normal(p[0], p[1]); }
Vector<3> normal_of(const std::array<Point<3>, 3>& p) { return unit_normal(p[0], p[1], p[2]); }

}  // namespace

template <int D>
Blade_side<D>::Blade_side(const Blade<D>& blade) {
  check_blade(blade);
  for (const auto& piece : blade.pieces) {
    Corners corners;
    Box<D> box;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      corners[k] = blade.points[piece[k]];
      box.extend(corners[k]);
    }
    pieces_.push_back(corners);
    normals_.push_back(normal_of(corners));
    boxes_.push_back(box);
    box_.extend(box);
  }
}

template <int D>
void Blade_side<D>::check_reach(const Box<D>& environment) const {
  double size = 0;
  for (std::size_t k = 0; k < D; ++k) size = std::max(size, environment.high[k] - environment.low[k]);
  for (const Corners& piece : pieces_)
    for (const Point<D>& x : piece)
      for (std::size_t k = 0; k < D; ++k)
        if (std::max(environment.low[k] - x[k], x[k] - environment.high[k]) > farthest * size)
          throw Error(Error_code::input,
                      "a point of the blade lies too far off: keep it within 2^20 times the size of the "
                      "environment");
}

template <int D>
bool Blade_side<D>::may_pass(const Box<D>& box) const {
  return box_.meets(box) &&
         std::any_of(boxes_.begin(), boxes_.end(), [&](const Box<D>& own) { return own.meets(box); });
}

template <int D>
std::optional<double> Blade_side<D>::passes(const Point<D>& u, const Point<D>& v) const {
  Box<D> box;
  box.extend(u);
  box.extend(v);
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (boxes_[i].meets(box))
      if (const auto share = passes_piece(pieces_[i], u, v)) return share;
  return std::nullopt;
}

template <int D>
bool Blade_side<D>::has(const Point<D>& x) const {
  Box<D> box;
  box.extend(x);
  for (std::size_t i = 0; i < pieces_.size(); ++i)
    if (boxes_[i].meets(box) && lies_on_piece(pieces_[i], x)) return true;
  return false;
}

template <int D>
double Blade_side<D>::side(const Point<D>& x) const {
  double least = std::numeric_limits<double>::infinity(), result = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Vector<D> off = x - nearest_on(pieces_[i], normals_[i], x);
    const double distance = length(off), height = dot(off, normals_[i]);
    constexpr double tie = 1e-9;  // of pieces that are equally near, the one that x lies farthest off decides
    if (distance > (1 + tie) * least) continue;
    if (distance >= (1 - tie) * least && std::abs(height) <= std::abs(result)) continue;
    least = std::min(least, distance);
    result = height;
  }
  return result;
}

template class Blade_side<2>;
template class Blade_side<3>;

}  // namespace cellwalk::detail
