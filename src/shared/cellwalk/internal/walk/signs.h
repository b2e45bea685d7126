// SPDX-License-Identifier: LGPL-3.0-or-later
// The two signs of the walk, computed by a number policy, and the exit of a cell that they determine. Paper:
// section II.
#ifndef CELLWALK_INTERNAL_WALK_SIGNS_H
#define CELLWALK_INTERNAL_WALK_SIGNS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/walk/walk.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// The side of x with respect to facet i: > 0 strictly outside the cell.
template <class Kernel>
auto side(const Cell_view<2>& cell, std::size_t i, const Point<2>& x, Walk_counts& counts) {
  ++counts.side_tests;
  const auto loop = cell.loop(i);
  const auto s = Kernel::orientation(counts.predicates, cell.point(loop[0]), cell.point(loop[1]), x);
  return decltype(s)(-s);  // a number, not an expression of one
}

template <class Kernel>
auto side(const Cell_view<3>& cell, std::size_t i, const Point<3>& x, Walk_counts& counts) {
  ++counts.side_tests;
  const auto loop = cell.loop(i);
  return Kernel::orientation(counts.predicates, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]),
                             x);
}

/// The sign of line ab with respect to ridge k of facet i (3D: edge from loop vertex k to the next; 2D:
/// vertex k). A line that leaves the cell through the facet has signs >= 0 for all ridges.
template <class Kernel>
auto along(const Cell_view<2>& cell, std::size_t i, std::size_t k, const Point<2>& a, const Point<2>& b,
           Walk_counts& counts) {
  ++counts.along_tests;
  const auto s = Kernel::orientation(counts.predicates, a, b, cell.point(cell.loop(i)[k]));
  return k == 0 ? decltype(s)(-s) : s;
}

template <class Kernel>
auto along(const Cell_view<3>& cell, std::size_t i, std::size_t k, const Point<3>& a, const Point<3>& b,
           Walk_counts& counts) {
  ++counts.along_tests;
  const auto loop = cell.loop(i);
  const std::uint16_t next = loop[k + 1 == loop.size() ? 0 : k + 1];
  return Kernel::orientation(counts.predicates, a, b, cell.point(loop[k]), cell.point(next));
}

/// The line ab with its signs, computed by a policy.
template <class Kernel, int D>
struct Line {
  const Point<D>&a, &b;
  Walk_counts& counts;

  int along(const Cell_view<D>& cell, std::size_t i, std::size_t k) const {
    return detail::along<Kernel>(cell, i, k, a, b, counts);
  }
  /// The side of plane abv on which w lies.
  int across(const Point<D>& v, const Point<D>& w) const {
    ++counts.along_tests;
    return Kernel::orientation(counts.predicates, a, b, v, w);
  }
};

/// The exit of a line from a cell.
struct Exit {
  enum Kind : std::uint8_t { arrived, facet, ridge, vertex, none } kind = none;
  std::uint16_t facet_index = 0;  ///< the exit facet, or one that contains the ridge or vertex
  std::uint32_t u = 0, v = 0;     ///< point indices: ridge uv (3D), or vertex u
};

/// The signs of a line with respect to the ridges of a facet, none negative.
using Ridge_signs = std::span<const std::int8_t>;

/// Refines an exit on facet i with zero signs at ridges: inside a ridge or at a vertex.
template <class Line>
Exit exit_on_zero_ridges(const Cell_view<2>& cell, std::size_t i, Ridge_signs signs, const Line&) {
  const std::uint32_t u = cell.point_index(cell.loop(i)[signs[0] == 0 ? 0 : 1]);
  return {Exit::vertex, static_cast<std::uint16_t>(i), u, u};
}

template <class Line>
Exit exit_on_zero_ridges(const Cell_view<3>& cell, std::size_t i, Ridge_signs signs, const Line& line) {
  const auto loop = cell.loop(i);
  const std::size_t n = loop.size();
  const auto facet_index = static_cast<std::uint16_t>(i);
  const auto is_zero = [&](std::size_t k) { return signs[k % n] == 0; };
  const auto at = [&](std::size_t k) { return loop[k % n]; };
  // The first zero ridge of a run.
  std::size_t first = 0;
  while (first < n && !(is_zero(first) && !is_zero(first + n - 1))) ++first;
  first %= n;
  std::size_t last = first;  // last zero ridge of the run
  while (last + 1 < first + n && is_zero(last + 1)) {
    if (!are_collinear(cell.point(at(last)), cell.point(at(last + 1)), cell.point(at(last + 2)))) {
      const std::uint32_t common = cell.point_index(at(last + 1));
      return {Exit::vertex, facet_index, common, common};
    }
    ++last;
  }
  if (last == first)
    return {Exit::ridge, facet_index, cell.point_index(at(first)), cell.point_index(at(first + 1))};
  // Several ridges on one line: the signs of their vertices in order, with a vertex off the line, determine
  // the ridge or vertex.
  std::size_t off = last + 2;
  while (are_collinear(cell.point(at(first)), cell.point(at(first + 1)), cell.point(at(off)))) ++off;
  int previous = 0;
  for (std::size_t k = first; k <= last + 1; ++k) {
    const int s = line.across(cell.point(at(k)), cell.point(at(off)));
    const std::uint32_t here = cell.point_index(at(k));
    if (s == 0) return {Exit::vertex, facet_index, here, here};
    if (k > first && s != previous) return {Exit::ridge, facet_index, cell.point_index(at(k - 1)), here};
    previous = s;
  }
  return {Exit::none, facet_index, 0, 0};  // inexact policies only
}

/// The exit of a line through facet i; Exit::none if it leaves elsewhere.
template <class Line, int D>
Exit exit_through(const Cell_view<D>& cell, std::size_t i, const Line& line) {
  boost::container::small_vector<std::int8_t, 16> signs;
  const std::size_t ridges = cell.loop(i).size();
  bool inside = true;
  for (std::size_t k = 0; k < ridges; ++k) {
    const int s = line.along(cell, i, k);
    if (s < 0) return {};
    inside &= s > 0;
    signs.push_back(static_cast<std::int8_t>(s));
  }
  if (inside) return {Exit::facet, static_cast<std::uint16_t>(i), 0, 0};
  return exit_on_zero_ridges(cell, i, {signs.data(), signs.size()}, line);
}

/// True if x, known to lie in the closed cell and on the plane of facet i, lies in the closed facet. Exact
/// for every policy of the walk; relevant only if a cell has several coplanar facets.
inline bool in_facet(const Cell_view<2>& cell, std::size_t i, const Point<2>& x) {
  const auto loop = cell.loop(i);
  return on_segment<2>(cell.point(loop[0]), cell.point(loop[1]), x);
}

inline bool in_facet(const Cell_view<3>& cell, std::size_t i, const Point<3>& x) {
  const auto loop = cell.loop(i);
  std::vector<Point<3>> polygon;
  for (const std::uint16_t v : loop) polygon.push_back(cell.point(v));
  return in_convex_polygon(polygon, x);
}

/// The other facet at ridge k of facet i; the number of facets if there is none.
template <int D>
std::size_t facet_across(const Cell_view<D>& cell, std::size_t i, std::size_t k) {
  const auto loop = cell.loop(i);
  for (std::size_t j = 0; j < cell.facet_count(); ++j) {
    if (j == i) continue;
    const auto other = cell.loop(j);
    for (std::size_t m = 0; m < other.size(); ++m) {
      if constexpr (D == 2) {
        if (other[m] == loop[k]) return j;
      } else {
        if (other[m] == loop[(k + 1) % loop.size()] && other[(m + 1) % other.size()] == loop[k]) return j;
      }
    }
  }
  return cell.facet_count();
}

/// A vertex or edge of a facet by its position in the loop, or the facet itself.
struct Facet_feature {
  Contact_kind kind = Contact_kind::facet;
  std::uint16_t corner = 0;
};

/// The position of ridge uv (3D) or vertex u = v in the loop of facet i; 0 if it is not there.
template <int D>
std::uint16_t corner_of(const Cell_view<D>& cell, std::size_t i, std::uint32_t u, std::uint32_t v) {
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t here = cell.point_index(loop[k]);
    const std::uint32_t next = u == v ? here : cell.point_index(loop[k + 1 == loop.size() ? 0 : k + 1]);
    if ((here == u && next == v) || (here == v && next == u)) return static_cast<std::uint16_t>(k);
  }
  return 0;
}

/// The lowest feature of facet i that contains x, a point of the closed facet.
template <int D>
Facet_feature lowest_feature(const Cell_view<D>& cell, std::size_t i, const Point<D>& x) {
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (cell.point(loop[k]) == x) return {Contact_kind::vertex, static_cast<std::uint16_t>(k)};
  if constexpr (D == 3)
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (on_segment<3>(cell.point(loop[k]), cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]), x))
        return {Contact_kind::edge, static_cast<std::uint16_t>(k)};
  return {};
}

/// The dimension of the lowest cell of the complex that contains x, given that x lies in the closed cell and
/// on the planes of the facets for which on_plane(i) holds.
template <int D, class On_plane>
std::uint16_t lowest_dimension(const Cell_view<D>& cell, const Point<D>& x, const On_plane& on_plane) {
  for (std::size_t v = 0; v < cell.vertex_count(); ++v)
    if (cell.point(v) == x) return 0;
  bool on_facet = false;
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    if (!on_plane(i)) continue;
    on_facet = true;
    if constexpr (D == 3) {
      const auto loop = cell.loop(i);
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (on_segment<3>(cell.point(loop[k]), cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]), x))
          return 1;
    }
  }
  return on_facet ? D - 1 : D;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_SIGNS_H
