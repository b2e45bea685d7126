// SPDX-License-Identifier: LGPL-3.0-or-later
#include "environment/facing_oracle.h"

#include <boost/multiprecision/gmp.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace cellwalk::test {
namespace {

using Ratio = boost::multiprecision::mpq_rational;
template <int D>
using Rational_place = std::array<Ratio, static_cast<std::size_t>(D)>;

/// A facet that one cell has.
template <int D>
struct Side {
  std::uint32_t cell;
  std::vector<Rational_place<D>> corners;
  Rational_place<D> across;  ///< its area vector
  Point<D> low, high;
};

template <int D>
Rational_place<D> difference(const Rational_place<D>& a, const Rational_place<D>& b) {
  Rational_place<D> d;
  for (std::size_t k = 0; k < D; ++k) d[k] = a[k] - b[k];
  return d;
}

template <int D>
Ratio product(const Rational_place<D>& a, const Rational_place<D>& b) {
  Ratio sum = 0;
  for (std::size_t k = 0; k < D; ++k) sum += a[k] * b[k];
  return sum;
}

/// A vector across a facet, of the length of its area (2D: its length).
Rational_place<2> area_vector(const std::vector<Rational_place<2>>& corners) {
  const Rational_place<2> along = difference<2>(corners[1], corners[0]);
  return {along[1], -along[0]};
}

Rational_place<3> area_vector(const std::vector<Rational_place<3>>& corners) {
  Rational_place<3> sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Rational_place<3> a = difference<3>(corners[i], corners[0]),
                            b = difference<3>(corners[(i + 1) % corners.size()], corners[0]);
    for (std::size_t k = 0; k < 3; ++k)
      sum[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  }
  for (Ratio& x : sum) x /= 2;
  return sum;
}

template <int D>
std::vector<Side<D>> lone_sides(const Cell_soup<D>& soup) {
  std::map<std::vector<std::uint32_t>, int> cells_of;
  const auto key = [&](std::size_t f) {
    std::vector<std::uint32_t> vertices(soup.facet(f).begin(), soup.facet(f).end());
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  for (std::size_t f = 0; f < soup.facet_count(); ++f) ++cells_of[key(f)];
  std::vector<Side<D>> sides;
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      if (soup.solid[c] || cells_of[key(f)] != 1) continue;
      Side<D> side{c, {}, {}, {}, {}};
      side.low.fill(std::numeric_limits<double>::infinity());
      side.high.fill(-std::numeric_limits<double>::infinity());
      for (const std::uint32_t v : soup.facet(f)) {
        Rational_place<D> corner;
        for (std::size_t k = 0; k < D; ++k) {
          corner[k] = Ratio(soup.points[v][k]);
          side.low[k] = std::min(side.low[k], soup.points[v][k]);
          side.high[k] = std::max(side.high[k], soup.points[v][k]);
        }
        side.corners.push_back(std::move(corner));
      }
      side.across = area_vector(side.corners);
      sides.push_back(std::move(side));
    }
  return sides;
}

/// A convex polygon on that side of a hyperplane to which `inwards` points.
template <int D>
std::vector<Rational_place<D>> cut(const std::vector<Rational_place<D>>& polygon,
                                   const Rational_place<D>& from, const Rational_place<D>& inwards) {
  std::vector<Rational_place<D>> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Rational_place<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Ratio at_p = product<D>(inwards, difference<D>(p, from)),
                at_q = product<D>(inwards, difference<D>(q, from));
    if (at_p >= 0) rest.push_back(p);
    if (at_p * at_q >= 0) continue;
    Rational_place<D> crossing;
    for (std::size_t k = 0; k < D; ++k) crossing[k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
    rest.push_back(std::move(crossing));
  }
  return rest;
}

bool has_extent(const std::vector<Rational_place<2>>& segment) {
  return std::any_of(segment.begin(), segment.end(),
                     [&](const Rational_place<2>& x) { return x != segment[0]; });
}

bool has_extent(const std::vector<Rational_place<3>>& polygon) {
  return !polygon.empty() && area_vector(polygon) != Rational_place<3>{0, 0, 0};
}

template <int D>
bool overlap(const Side<D>& f, const Side<D>& g) {
  std::size_t touching = 0;
  for (std::size_t k = 0; k < D; ++k) {
    if (f.high[k] < g.low[k] || g.high[k] < f.low[k]) return false;
    touching += f.high[k] == g.low[k] || g.high[k] == f.low[k];
  }
  if (touching > 1) return false;
  const Rational_place<D>& across = f.across;
  if (product<D>(across, g.across) >= 0) return false;
  for (const Rational_place<D>& x : g.corners)
    if (product<D>(across, difference<D>(x, f.corners[0])) != 0) return false;
  std::vector<Rational_place<D>> common = g.corners;
  for (std::size_t i = 0; i < f.corners.size(); ++i) {
    const Rational_place<D>&p = f.corners[i], &q = f.corners[(i + 1) % f.corners.size()];
    const Rational_place<D> along = difference<D>(q, p);
    if constexpr (D == 2)
      common = cut<2>(common, p, along);
    else
      common =
          cut<3>(common, p,
                 {across[1] * along[2] - across[2] * along[1], across[2] * along[0] - across[0] * along[2],
                  across[0] * along[1] - across[1] * along[0]});
  }
  return !common.empty() && has_extent(common);
}

}  // namespace

template <int D>
std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<D>& soup) {
  const std::vector<Side<D>> sides = lone_sides(soup);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sides[i].cell != sides[j].cell && overlap<D>(sides[i], sides[j]))
        pairs.push_back({sides[j].cell, sides[i].cell});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<2>&);
template std::vector<std::array<std::uint32_t, 2>> overlapping_facets(const Cell_soup<3>&);

}  // namespace cellwalk::test
