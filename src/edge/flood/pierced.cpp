// SPDX-License-Identifier: LGPL-3.0-or-later
#include "pierced.h"

#include <cellwalk/internal/walk/signs.h>

#include <boost/container/small_vector.hpp>

namespace cellwalk::detail {

bool is_pierced(const Cell_view<2>& cell, std::size_t i, const Swept_triangle<2>& t, Walk_counts& counts) {
  const auto sign = [&](const Point<2>& u, const Point<2>& v, const Point<2>& w) {
    return Exact::orientation(counts.predicates, u, v, w);
  };
  if (side<Exact>(cell, i, t.q, counts) == 0) return false;
  const int sense = sign(t.a, t.b, t.q);
  if (sense == 0) return false;
  for (const std::uint16_t v : cell.loop(i)) {
    const Point<2>& x = cell.point(v);
    if (sense * sign(t.a, t.b, x) > 0 && sense * sign(t.b, t.q, x) > 0 && sense * sign(t.q, t.a, x) > 0)
      return true;
  }
  return false;
}

bool is_pierced(const Cell_view<3>& cell, std::size_t i, const Swept_triangle<3>& t, Walk_counts& counts) {
  const auto sign = [&](const Point<3>& u, const Point<3>& v, const Point<3>& w, const Point<3>& x) {
    return Exact::orientation(counts.predicates, u, v, w, x);
  };
  if (side<Exact>(cell, i, t.q, counts) == 0) return false;
  const auto loop = cell.loop(i);
  boost::container::small_vector<int, 8> heights;
  for (const std::uint16_t v : loop) heights.push_back(sign(t.a, t.b, t.q, cell.point(v)));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::size_t next = k + 1 == loop.size() ? 0 : k + 1;
    if (heights[k] * heights[next] >= 0) continue;
    const Point<3>&u = cell.point(loop[k]), &v = cell.point(loop[next]);
    const int sense = sign(u, v, t.a, t.b);
    if (sense != 0 && sign(u, v, t.b, t.q) == sense && sign(u, v, t.q, t.a) == sense) return true;
  }
  return false;
}

}  // namespace cellwalk::detail
