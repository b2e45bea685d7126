// SPDX-License-Identifier: LGPL-3.0-or-later
#include "oracle/parity.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "oracle/number.h"

namespace cellwalk::oracle {
namespace {

using boost::multiprecision::cpp_int;
using Whole_point = std::array<cpp_int, 3>;

/// Scaled so that every double is whole.
Whole_point whole(const Point<3>& p) {
  constexpr int smallest_exponent = -1074;
  Whole_point w;
  for (int i = 0; i < 3; ++i) {
    const Dyadic d = to_dyadic(p[i]);
    w[i] = d.mantissa == 0 ? cpp_int(0) : cpp_int(d.mantissa) << (d.exponent - smallest_exponent);
  }
  return w;
}

/// Sign of the volume of a tetrahedron.
int volume_sign(const Whole_point& a, const Whole_point& b, const Whole_point& c, const Whole_point& d) {
  std::array<Whole_point, 3> m{b, c, d};
  for (Whole_point& row : m)
    for (int i = 0; i < 3; ++i) row[i] -= a[i];
  const cpp_int det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                      m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                      m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.sign();
}

enum class Crossing { none, proper, unclear };

Crossing crossing(const Whole_point& p, const Whole_point& q, const Surface_soup& surface,
                  std::size_t facet) {
  const auto& loop = surface.facets[facet];
  const Whole_point a = whole(surface.points[loop[0]]), b = whole(surface.points[loop[1]]),
                    c = whole(surface.points[loop[2]]);
  const int at_p = volume_sign(a, b, c, p), at_q = volume_sign(a, b, c, q);
  if (at_p * at_q > 0) return Crossing::none;
  const int ab = volume_sign(p, q, a, b), bc = volume_sign(p, q, b, c), ca = volume_sign(p, q, c, a);
  if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return Crossing::none;
  return at_p * at_q * ab * bc * ca == 0 ? Crossing::unclear : Crossing::proper;
}

}  // namespace

bool is_inside(const Surface_soup& surface, const Point<3>& p) {
  Point<3> low = p, high = p;
  for (const Point<3>& x : surface.points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  constexpr int most_tries = 20;
  for (int k = 1; k <= most_tries; ++k) {
    // Nearly along an axis, so that few triangles need exact signs.
    const double lean = 0x1p-10 * k * (high[0] - low[0]);
    const Point<3> q{high[0] + (high[0] - low[0]), p[1] + lean, p[2] + lean / 3};
    const Whole_point exact_p = whole(p), exact_q = whole(q);
    bool inside = false, clear = true;
    for (std::size_t f = 0; f < surface.facets.size() && clear; ++f) {
      bool apart = false;
      for (int i = 0; i < 3; ++i) {
        const auto [first, last] =
            std::minmax({surface.points[surface.facets[f][0]][i], surface.points[surface.facets[f][1]][i],
                         surface.points[surface.facets[f][2]][i]});
        apart = apart || last < std::min(p[i], q[i]) || first > std::max(p[i], q[i]);
      }
      if (apart) continue;
      const Crossing c = crossing(exact_p, exact_q, surface, f);
      clear = c != Crossing::unclear;
      inside ^= c == Crossing::proper;
    }
    if (clear) return inside;
  }
  throw std::runtime_error("the point lies on the surface, or the surface is not closed");
}

}  // namespace cellwalk::oracle
