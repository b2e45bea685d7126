// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/wall_list.h"

#include <algorithm>

namespace cellwalk::test {
namespace {

using oracle::Affine;
using oracle::Big;
using oracle::cross;
using oracle::dot;
using oracle::minus;
template <std::size_t D>
using Vec = std::array<Big, D>;

template <std::size_t D>
Affine<static_cast<int>(D), Big> through(const Vec<D>& normal, const Vec<D>& x) {
  return {normal, dot(normal, x)};
}

Affine<2, Big> plane_of(const std::vector<Vec<2>>& points) {
  const Vec<2> along = minus(points[1], points[0]);
  return through<2>({along[1], -along[0]}, points[0]);
}

/// Vertices may be collinear, all but the last with the first.
Affine<3, Big> plane_of(const std::vector<Vec<3>>& points) {
  Vec<3> normal{0, 0, 0};
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec<3> n = cross(minus(points[i - 1], points[0]), minus(points[i], points[0]));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += n[k];
  }
  return through(normal, points[0]);
}

/// True if no two points lie strictly on different sides.
template <int D>
bool is_beside(const Affine<D, Big>& plane, std::span<const Vec<D>> points) {
  bool above = false, below = false;
  for (const Vec<D>& x : points) {
    const int side = oracle::sign(Big(dot(plane.normal, x) - plane.offset));
    above |= side > 0;
    below |= side < 0;
  }
  return !(above && below);
}

template <int D>
std::array<Point<D>, 2> box_of(std::span<const Point<D>> points) {
  std::array<Point<D>, 2> box{points[0], points[0]};
  for (const Point<D>& x : points)
    for (std::size_t i = 0; i < D; ++i) {
      box[0][i] = std::min(box[0][i], x[i]);
      box[1][i] = std::max(box[1][i], x[i]);
    }
  return box;
}

template <int D>
bool boxes_apart(const std::array<Point<D>, 2>& x, const std::array<Point<D>, 2>& y) {
  for (std::size_t i = 0; i < D; ++i)
    if (x[1][i] < y[0][i] || y[1][i] < x[0][i]) return true;
  return false;
}

}  // namespace

template <int D>
struct Wall_list<D>::Swept {
  std::array<Point<D>, 2> box;
  int extra_shift = 0;
  std::vector<Vec<D>> corners;
  std::vector<Affine<D, Big>> planes;  ///< 2D: of the sides, positive outside; 3D: its own

  Swept(const std::array<Point<D>, 3>& points, int shift) : box(box_of<D>(points)) {
    for (const Point<D>& x : points) extra_shift = std::max(extra_shift, oracle::shift_of(x) - shift);
    for (const Point<D>& x : points) corners.push_back(oracle::integer(x, shift + extra_shift));
    if constexpr (D == 3) {
      planes.push_back(plane_of(corners));
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec<2>&u = corners[i], &v = corners[(i + 1) % 3];
        Affine<2, Big> side = plane_of({u, v});
        if (dot(side.normal, corners[(i + 2) % 3]) > side.offset) side = plane_of({v, u});
        planes.push_back(side);
      }
    }
  }
};

template <int D>
Wall_list<D>::Wall_list(const Snapshot<D>& snapshot) {
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f), other = snapshot.opposite(facet);
      if (!snapshot.is_impassable(facet) || (other != Half_facet::none && other < facet)) continue;
      facets.push_back(facet);
      polygons.push_back(polygon(snapshot, facet));
    }
  }
  for (const auto& points : polygons)
    for (const Point<D>& x : points) shift_ = std::max(shift_, oracle::shift_of(x));
  for (const auto& points : polygons) {
    Prepared& wall = prepared_.emplace_back();
    wall.box = box_of<D>(points);
    for (const Point<D>& x : points) wall.points.push_back(oracle::integer(x, shift_));
    wall.plane = plane_of(wall.points);
  }
}

template <int D>
bool Wall_list<D>::is_apart(const Swept& triangle, const Prepared& wall) const {
  if (boxes_apart<D>(triangle.box, wall.box)) return true;
  Affine<D, Big> plane = wall.plane;
  plane.offset <<= triangle.extra_shift;
  if (is_beside<D>(plane, triangle.corners)) return true;
  std::vector<Vec<D>> scaled;
  if (triangle.extra_shift > 0) {
    scaled = wall.points;
    for (Vec<D>& x : scaled)
      for (Big& c : x) c <<= triangle.extra_shift;
  }
  const std::vector<Vec<D>>& points = scaled.empty() ? wall.points : scaled;
  if constexpr (D == 3) {
    return is_beside<3>(triangle.planes[0], points);
  } else {
    return std::any_of(triangle.planes.begin(), triangle.planes.end(), [&](const Affine<2, Big>& side) {
      return dot(side.normal, points[0]) >= side.offset && dot(side.normal, points[1]) >= side.offset;
    });
  }
}

template <int D>
template <class Visit>
void Wall_list<D>::for_each_near(const Point<D>& a, const Point<D>& b, const Point<D>& q,
                                 const Visit& visit) const {
  const Swept triangle({a, b, q}, shift_);
  for (std::size_t w = 0; w < prepared_.size(); ++w)
    if (!is_apart(triangle, prepared_[w]) && !visit(w)) return;
}

template <int D>
bool Wall_list<D>::is_crossed(const Point<D>& a, const Point<D>& b, const Point<D>& q) const {
  bool is_hit = false;
  for_each_near(a, b, q, [&](std::size_t w) {
    is_hit = crosses(a, b, q, polygons[w]);
    return !is_hit;
  });
  return is_hit;
}

template <int D>
std::optional<double> Wall_list<D>::first_hit(const Point<D>& a, const Point<D>& b, const Point<D>& q) const {
  std::optional<double> first;
  for_each_near(a, b, q, [&](std::size_t w) {
    const auto time = first_crossing(a, b, q, polygons[w]);
    if (time && (!first || *time < *first)) first = time;
    return true;
  });
  return first;
}

template class Wall_list<2>;
template class Wall_list<3>;

}  // namespace cellwalk::test
