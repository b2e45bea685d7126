// SPDX-License-Identifier: LGPL-3.0-or-later
// Small cells by hand, and exact volumes.
#ifndef CELLWALK_TESTS_ENVIRONMENT_CELL_SAMPLES_H
#define CELLWALK_TESTS_ENVIRONMENT_CELL_SAMPLES_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/records/cell_soup.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::test {

using Loops = std::vector<std::vector<std::uint16_t>>;

/// One cell with its own points.
template <int D>
struct Sample_cell {
  std::vector<Point<D>> points;
  Loops loops;

  Cell_check check() const {
    Cell_shape shape;
    for (const auto& loop : loops) {
      shape.loops.insert(shape.loops.end(), loop.begin(), loop.end());
      shape.loop_begin.push_back(static_cast<std::uint16_t>(shape.loops.size()));
    }
    shape.vertex_count = static_cast<std::uint16_t>(points.size());
    std::vector<std::uint32_t> vertices(points.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) vertices[i] = i;
    return check_cell(Cell_view<D>{&shape, vertices, points});
  }

  Cell_soup<D> soup() const {
    Cell_soup<D> result;
    result.points = points;
    for (const auto& loop : loops) result.add_facet(std::vector<std::uint32_t>(loop.begin(), loop.end()));
    result.end_cell();
    return result;
  }

  Sample_cell reversed() const {
    Sample_cell result = *this;
    for (auto& loop : result.loops) std::reverse(loop.begin(), loop.end());
    std::reverse(result.loops.begin(), result.loops.end());
    return result;
  }
};

inline Sample_cell<3> tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Positively oriented, whatever the order of its vertices.
inline Sample_cell<3> tetrahedron_of(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                     const Point<3>& d) {
  const Sample_cell<3> cell{{a, b, c, d}, tetrahedron().loops};
  return cell.check().defect == Cell_defect::inverted ? cell.reversed() : cell;
}

/// [0,2]^3, vertices in VTK order: bottom, top, then the four sides.
inline Sample_cell<3> cube() {
  return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}},
          {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}

/// The prism over a polygon of the plane z = 0, up to z = 1. Facet 0 is the bottom, 1 the top.
inline Sample_cell<3> prism(const std::vector<Point<2>>& polygon) {
  const auto n = static_cast<std::uint16_t>(polygon.size());
  Sample_cell<3> cell;
  for (const double z : {0.0, 1.0})
    for (const Point<2>& p : polygon) cell.points.push_back({p[0], p[1], z});
  cell.loops.resize(2);
  for (std::uint16_t i = 0; i < n; ++i) {
    const auto next = static_cast<std::uint16_t>((i + 1) % n);
    cell.loops[0].insert(cell.loops[0].begin(), i);
    cell.loops[1].push_back(static_cast<std::uint16_t>(n + i));
    cell.loops.push_back({i, next, static_cast<std::uint16_t>(n + next), static_cast<std::uint16_t>(n + i)});
  }
  return cell;
}

inline Sample_cell<2> polygon(const std::vector<Point<2>>& points) {
  Sample_cell<2> cell{points, {}};
  for (std::uint16_t i = 0; i < points.size(); ++i)
    cell.loops.push_back({i, static_cast<std::uint16_t>((i + 1) % points.size())});
  return cell;
}

/// A twofold cover of an octahedron: its equator is walked twice between the poles. Two vertices lie on each
/// corner of the equator.
inline Sample_cell<3> wound_octahedron() {
  Sample_cell<3> cell{{{0, 0, 1}, {0, 0, -1}}, {}};
  const std::array<Point<3>, 4> equator{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  for (std::uint16_t i = 0; i < 8; ++i) {
    const auto u = static_cast<std::uint16_t>(2 + i), v = static_cast<std::uint16_t>(2 + (i + 1) % 8);
    cell.points.push_back(equator[i % 4]);
    cell.loops.push_back({0, u, v});
    cell.loops.push_back({1, v, u});
  }
  return cell;
}

using Rational = boost::multiprecision::cpp_rational;

inline Rational determinant(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const auto x = [](double v) { return Rational(v); };
  return x(a[0]) * (x(b[1]) * x(c[2]) - x(b[2]) * x(c[1])) -
         x(a[1]) * (x(b[0]) * x(c[2]) - x(b[2]) * x(c[0])) +
         x(a[2]) * (x(b[0]) * x(c[1]) - x(b[1]) * x(c[0]));
}

/// Six times the exact volume of a cell with planar facets.
inline Rational exact_volume(const Cell_soup<3>& soup, std::size_t cell) {
  Rational sum = 0;
  for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
    const auto loop = soup.facet(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += determinant(soup.points[loop[0]], soup.points[loop[i]], soup.points[loop[i + 1]]);
  }
  return sum;
}

/// Twice the exact area of a polygon.
inline Rational exact_volume(const Cell_soup<2>& soup, std::size_t cell) {
  Rational sum = 0;
  for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
    const Point<2>&a = soup.points[soup.facet(f)[0]], &b = soup.points[soup.facet(f)[1]];
    sum += Rational(a[0]) * Rational(b[1]) - Rational(a[1]) * Rational(b[0]);
  }
  return sum;
}

template <int D>
Rational exact_volume(const Cell_soup<D>& soup) {
  Rational sum = 0;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) sum += exact_volume(soup, c);
  return sum;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_CELL_SAMPLES_H
