// SPDX-License-Identifier: LGPL-3.0-or-later
// A visible corner found from a convex one, and exact tests of the point between them.
#include "hole_points.h"

#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <optional>

namespace cellwalk::io {
namespace {

/// The number of times that a candidate is moved towards its corner if rounding has put it on the wrong side.
constexpr int most_halvings = 40;

class Search {
 public:
  Search(const std::vector<Point<2>>& points, const std::vector<Point_ring>& rings, std::size_t hole)
      : points_(points), rings_(rings), hole_(hole) {}

  std::vector<Point<2>> run() {
    const Point_ring& ring = rings_[hole_];
    // The lowest corner, of these the leftmost, is convex, so it determines the orientation of the ring.
    const std::size_t n = ring.size();
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (at(i) < at(lowest)) lowest = i;
    const int turn = corner_turn(lowest);
    const bool touched = is_touched();
    std::vector<Point<2>> found;
    for (std::size_t k = 0; k < n && (found.empty() || touched); ++k) {
      const std::size_t i = (lowest + k) % n;
      if (turn == 0 || corner_turn(i) != turn) continue;
      if (const auto p = beside_corner(i, turn)) found.push_back(*p);
    }
    return found;
  }

 private:
  const Point<2>& at(std::size_t i) const { return points_[rings_[hole_][i]]; }
  std::size_t after(std::size_t i) const { return (i + 1) % rings_[hole_].size(); }
  std::size_t before(std::size_t i) const { return (i + rings_[hole_].size() - 1) % rings_[hole_].size(); }
  int turn(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
    return Exact::orientation(counts_, a, b, c);
  }
  int corner_turn(std::size_t i) { return turn(at(before(i)), at(i), at(after(i))); }

  bool is_touched() const {
    std::vector<std::uint32_t> own(rings_[hole_]);
    std::sort(own.begin(), own.end());
    for (std::size_t r = 0; r < rings_.size(); ++r)
      for (std::uint32_t v : rings_[r])
        if (r != hole_ && std::binary_search(own.begin(), own.end(), v)) return true;
    return false;
  }

  /// A point on a segment from the convex corner b into the hole. In the triangle a, b, c, the corner of any
  /// ring that is farthest from ac is visible from b, so the segment between them lies in the hole; if there
  /// is none, the middle of ac is visible.
  std::optional<Point<2>> beside_corner(std::size_t i, int side) {
    const Point<2>&a = at(before(i)), &b = at(i), &c = at(after(i));
    Point<2> seen{a[0] / 2 + c[0] / 2, a[1] / 2 + c[1] / 2};
    std::optional<Point<2>> farthest;
    for (const Point_ring& ring : rings_)
      for (std::uint32_t v : ring) {
        const Point<2>& p = points_[v];
        if (turn(a, b, p) * side <= 0 || turn(b, c, p) * side <= 0 || turn(c, a, p) * side < 0) continue;
        if (!farthest || is_farther(a, c, p, *farthest, side)) farthest = p;
      }
    if (farthest) seen = *farthest;
    for (double s = 0.5; s > std::ldexp(1.0, -most_halvings); s /= 2) {
      const Point<2> p{b[0] + s * (seen[0] - b[0]), b[1] + s * (seen[1] - b[1])};
      if (is_in_hole(p)) return p;
    }
    return std::nullopt;
  }

  /// Rounded products suffice for this preference, since the point found is checked exactly.
  static bool is_farther(const Point<2>& a, const Point<2>& c, const Point<2>& p, const Point<2>& q,
                         int side) {
    const Vector<2> along = c - a, d = p - q;
    return side * (along[0] * d[1] - along[1] * d[0]) < 0;
  }

  /// True if p lies on no ring, inside the ring of the hole, and in an even number of rings.
  bool is_in_hole(const Point<2>& p) {
    bool in_domain = false;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      bool inside = false;
      const Point_ring& ring = rings_[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point<2>*u = &points_[ring[i]], *v = &points_[ring[(i + 1) % ring.size()]];
        if (std::max((*u)[1], (*v)[1]) < p[1] || std::min((*u)[1], (*v)[1]) > p[1]) continue;
        const int o = turn(*u, *v, p);
        if (o == 0 && std::min((*u)[0], (*v)[0]) <= p[0] && p[0] <= std::max((*u)[0], (*v)[0])) return false;
        const bool up = (*u)[1] <= p[1];
        if (up != ((*v)[1] <= p[1]) && (up ? o > 0 : o < 0)) inside = !inside;
      }
      if (r == hole_ && !inside) return false;
      in_domain ^= inside;
    }
    return !in_domain;
  }

  const std::vector<Point<2>>& points_;
  const std::vector<Point_ring>& rings_;
  std::size_t hole_;
  Predicate_counts counts_;
};

}  // namespace

std::vector<Point<2>> hole_points(const std::vector<Point<2>>& points, const std::vector<Point_ring>& rings,
                                  std::size_t hole) {
  return Search(points, rings, hole).run();
}

}  // namespace cellwalk::io
