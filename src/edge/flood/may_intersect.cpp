// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact tests that separate a facet from the triangle: boxes, planes, and lines of the sides.
#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace cellwalk::detail {
namespace {

/// Signs none of which is negative, or none of which is positive: then a line passes the closed polygon whose
/// sides they belong to.
class One_sided {
 public:
  void add(int sign) {
    some_negative_ |= sign < 0;
    some_positive_ |= sign > 0;
  }
  explicit operator bool() const { return !(some_negative_ && some_positive_); }

 private:
  bool some_negative_ = false, some_positive_ = false;
};

/// False if the boxes of a facet and the triangle are disjoint.
template <int D>
bool boxes_meet(const Cell_view<D>& cell, std::size_t i, const Swept_triangle<D>& t) {
  const auto loop = cell.loop(i);
  for (int k = 0; k < D; ++k) {
    const auto [low, high] = std::minmax({t.a[k], t.b[k], t.q[k]});
    bool is_below = true, is_above = true;
    for (const std::uint16_t v : loop) {
      const double x = cell.point(v)[k];
      is_below &= x < low;
      is_above &= x > high;
    }
    if (is_below || is_above) return false;
  }
  return true;
}

/// True if the triangle is the path of p alone.
template <int D>
bool is_segment(const Swept_triangle<D>& t) {
  return t.q == t.a;
}

int sign_in_plane(const Point<2>& u, const Point<2>& v, const Point<2>& x, Walk_counts& counts) {
  return Exact::orientation(counts.predicates, u, v, x);
}

}  // namespace

template <int D>
bool may_overlap(const Cell_view<D>& cell, std::size_t i, const Swept_triangle<D>& t, Walk_counts& counts) {
  const int at_q = side<Exact>(cell, i, t.q, counts);
  if (at_q != 0 && side<Exact>(cell, i, t.a, counts) == at_q && side<Exact>(cell, i, t.b, counts) == at_q)
    return false;
  return boxes_meet<D>(cell, i, t);
}

template bool may_overlap<2>(const Cell_view<2>&, std::size_t, const Swept_triangle<2>&, Walk_counts&);
template bool may_overlap<3>(const Cell_view<3>&, std::size_t, const Swept_triangle<3>&, Walk_counts&);

bool may_intersect(const Cell_view<2>& cell, std::size_t i, const Swept_triangle<2>& t, Walk_counts& counts) {
  if (!boxes_meet<2>(cell, i, t)) return false;
  const auto loop = cell.loop(i);
  const Point<2>&u = cell.point(loop[0]), &v = cell.point(loop[1]);
  // Convex sets in the plane are disjoint if and only if the line of a side of one of them separates them.
  const std::array<const Point<2>*, 3> corners{&t.a, &t.b, &t.q};
  int sum = 0;
  for (const auto* corner : corners) sum += sign_in_plane(u, v, *corner, counts);
  if (std::abs(sum) == 3) return false;
  const int sense = sign_in_plane(t.a, t.b, t.q, counts);
  if (sense == 0) {
    // A path without an edge is a segment, whose line may separate them.
    return !is_segment<2>(t) || sign_in_plane(t.a, t.b, u, counts) * sign_in_plane(t.a, t.b, v, counts) <= 0;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<2>&c = *corners[k], &d = *corners[(k + 1) % 3];
    if (sense * sign_in_plane(c, d, u, counts) < 0 && sense * sign_in_plane(c, d, v, counts) < 0)
      return false;
  }
  return true;
}

bool may_intersect(const Cell_view<3>& cell, std::size_t i, const Swept_triangle<3>& t, Walk_counts& counts) {
  if (!boxes_meet<3>(cell, i, t)) return false;
  const auto sign = [&](const Point<3>& u, const Point<3>& v, const Point<3>& w, const Point<3>& x) {
    return Exact::orientation(counts.predicates, u, v, w, x);
  };
  const std::array<const Point<3>*, 3> corners{&t.a, &t.b, &t.q};
  std::array<int, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) sides[k] = detail::side<Exact>(cell, i, *corners[k], counts);
  if (std::abs(sides[0] + sides[1] + sides[2]) == 3) return false;
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (sides[k] * sides[next] > 0) continue;
    if (sides[k] == 0 && sides[next] == 0) return true;
    // In either direction, but not from b, which may be so far away that differences from it lose the other
    // points.
    const std::size_t from = k == 1 ? next : k, to = k == 1 ? k : next;
    One_sided passed;
    for (std::size_t r = 0; r < loop.size() && passed; ++r)
      passed.add(detail::along<Exact>(cell, i, r, *corners[from], *corners[to], counts));
    if (passed) return true;
  }
  if (is_segment<3>(t)) return false;
  boost::container::small_vector<int, 8> heights;
  for (const std::uint16_t v : loop) heights.push_back(sign(t.a, t.b, t.q, cell.point(v)));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::size_t next = k + 1 == loop.size() ? 0 : k + 1;
    if (heights[k] * heights[next] > 0) continue;
    if (heights[k] == 0 && heights[next] == 0) return true;
    const Point<3>&u = cell.point(loop[k]), &v = cell.point(loop[next]);
    One_sided passed;
    for (std::size_t r = 0; r < 3 && passed; ++r) passed.add(sign(u, v, *corners[r], *corners[(r + 1) % 3]));
    if (passed) return true;
  }
  return false;
}

bool may_meet_ridge(const Cell_view<2>& cell, std::size_t i, std::size_t k, const Swept_triangle<2>& t,
                    Walk_counts& counts) {
  const int sense = sign_in_plane(t.a, t.b, t.q, counts);
  const Point<2>& x = cell.point(cell.loop(i)[k]);
  return sense == 0 ||
         (sense * sign_in_plane(t.a, t.b, x, counts) >= 0 &&
          sense * sign_in_plane(t.b, t.q, x, counts) >= 0 && sense * sign_in_plane(t.q, t.a, x, counts) >= 0);
}

bool may_meet_ridge(const Cell_view<3>& cell, std::size_t i, std::size_t k, const Swept_triangle<3>& t,
                    Walk_counts& counts) {
  const auto loop = cell.loop(i);
  const Point<3>&u = cell.point(loop[k]), &v = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
  const auto sign = [&](const Point<3>& x, const Point<3>& y, const Point<3>& z, const Point<3>& w) {
    return Exact::orientation(counts.predicates, x, y, z, w);
  };
  const int at_u = sign(t.a, t.b, t.q, u), at_v = sign(t.a, t.b, t.q, v);
  if (at_u * at_v > 0) return false;
  if (at_u == 0 && at_v == 0) return true;
  One_sided passed;
  passed.add(sign(u, v, t.a, t.b));
  passed.add(sign(u, v, t.b, t.q));
  passed.add(sign(u, v, t.q, t.a));
  return static_cast<bool>(passed);
}

}  // namespace cellwalk::detail
