// SPDX-License-Identifier: LGPL-3.0-or-later
// The narrowest place against all pairs, with exact distances.
#include <cellwalk/kernel/error.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "meshing/fill/narrow_place.h"
#include "meshing/odd_surfaces.h"

namespace cellwalk {
namespace {

using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using detail::Narrow_place;

Exact_kernel::Point_3 exact(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// All pairs of a surface.
struct Nearest {
  double size = 0, vertices = std::numeric_limits<double>::infinity(), facets = vertices;

  explicit Nearest(const Surface_soup& s) {
    Point<3> low = s.points[0], high = low;
    for (const auto& p : s.points)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    size = length(high - low);
    for (std::size_t i = 0; i < s.points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) vertices = std::min(vertices, length(s.points[i] - s.points[j]));
    for (std::size_t f = 0; f < s.facets.size(); ++f)
      for (std::size_t g = 0; g < f; ++g) facets = std::min(facets, distance(s, s.facets[f], s.facets[g]));
  }

 private:
  using Facet = std::vector<std::uint32_t>;

  static std::pair<double, double> extent(const Surface_soup& s, const Facet& f, std::size_t k) {
    return std::minmax({s.points[f[0]][k], s.points[f[1]][k], s.points[f[2]][k]});
  }

  double distance(const Surface_soup& s, const Facet& f, const Facet& g) {
    const auto common = [](const Facet& of, std::uint32_t v) {
      return std::find(of.begin(), of.end(), v) != of.end();
    };
    const auto shared = std::count_if(f.begin(), f.end(), [&](std::uint32_t v) { return common(g, v); });
    const double apart = 1e-3 * size, infinite = std::numeric_limits<double>::infinity();
    if (shared > 1) return infinite;
    // Facets whose boxes are apart are not near.
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [f_low, f_high] = extent(s, f, k);
      const auto [g_low, g_high] = extent(s, g, k);
      if (f_low > g_high + apart || g_low > f_high + apart) return infinite;
    }
    Exact_kernel::FT least = -1;
    const auto take = [&least](const Exact_kernel::FT& d) {
      if (least < 0 || d < least) least = d;
    };
    for (const auto& [a, b] : {std::pair(&f, &g), std::pair(&g, &f)}) {
      const auto at = [&s, of = b](std::size_t k) { return exact(s.points[(*of)[k]]); };
      for (const std::uint32_t v : *a)
        if (!common(*b, v))
          take(CGAL::squared_distance(exact(s.points[v]), Exact_kernel::Triangle_3(at(0), at(1), at(2))));
    }
    if (shared == 0)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          take(CGAL::squared_distance(
              Exact_kernel::Segment_3(exact(s.points[f[i]]), exact(s.points[f[(i + 1) % 3]])),
              Exact_kernel::Segment_3(exact(s.points[g[j]]), exact(s.points[g[(j + 1) % 3]]))));
    return std::sqrt(CGAL::to_double(least));
  }
};

TEST(NarrowPlace, IsThatOfAllPairs) {
  constexpr double near = 1e-7, rounding = 1e-14;
  std::size_t by_vertices = 0, by_facets = 0, wide = 0, refused = 0;
  for (std::size_t i = 0; i < 140; ++i) {
    if (i % test::odd_kinds == 14 || i % test::odd_kinds == 15) continue;  // squares out of range
    const test::Odd_surface odd = test::odd_surface(i);
    Surface_soup surface;
    try {
      surface = check_surface(odd.surface);
    } catch (const Error&) {
      ++refused;
      continue;
    }
    SCOPED_TRACE(odd.name);
    const Nearest nearest(surface);
    const auto places = detail::narrow_places({surface});
    ASSERT_FALSE(places.empty());
    const Narrow_place &first = places.front(), &last = places.back();
    const double vertices = nearest.vertices / nearest.size, facets = nearest.facets / nearest.size;
    if (vertices < near) {
      EXPECT_TRUE(first.are_vertices);
      EXPECT_NEAR(first.distance, vertices, 1e-9 * vertices);
      ++by_vertices;
    }
    if (facets < std::min(near, 0.49 * vertices) && vertices > 10 * rounding) {
      EXPECT_FALSE(last.are_vertices);
      EXPECT_NEAR(last.distance, facets, 1e-3 * facets + rounding);
      ++by_facets;
    }
    if (vertices >= near && facets >= near) {
      EXPECT_LE(first.distance, vertices * (1 + 1e-9));
      ++wide;
    }
  }
  EXPECT_GE(by_vertices, 20u);
  EXPECT_GE(by_facets, 10u);
  EXPECT_GE(wide, 10u);
  EXPECT_LE(refused, 40u);
}

/// The text has no numbers out of range, whatever the size.
TEST(NarrowPlace, IsTheSameInEverySize) {
  const Surface_soup plain = check_surface(test::cube_with_point_on_edge(1e-12));
  detail::Feature_names names;
  names.add("surface", {0, 1, 2, 3, 4, 5, 6, 7, 8}, 9, std::vector<std::uint32_t>(14, 0), 14);
  const auto places = detail::narrow_places({plain});
  EXPECT_EQ(detail::describe(places, names), "vertices 0 and 8 are 5.77e-13 of the size apart, at (0, 0, 0)");
  for (const int exponent : {-1020, -300, 300, 1020}) {
    Surface_soup other = plain;
    for (auto& p : other.points)
      for (double& x : p) x = std::ldexp(x, exponent);
    const auto found = detail::narrow_places({other});
    ASSERT_EQ(found.size(), places.size());
    EXPECT_EQ(found[0].features, places[0].features) << exponent;
    // The point that is near leaves the range of normal numbers.
    EXPECT_NEAR(found[0].distance, places[0].distance, (exponent < -1000 ? 1e-3 : 0) * places[0].distance)
        << exponent;
  }
}

}  // namespace
}  // namespace cellwalk
