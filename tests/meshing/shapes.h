// SPDX-License-Identifier: LGPL-3.0-or-later
// Small surfaces to mesh.
#ifndef CELLWALK_TESTS_MESHING_SHAPES_H
#define CELLWALK_TESTS_MESHING_SHAPES_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/records/surface_soup.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::test {

/// The box with the given corners as six quadrangles.
inline Surface_soup box(const Point<3>& low, const Point<3>& high) {
  Surface_soup s;
  for (int i = 0; i < 8; ++i)
    s.points.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  s.facets = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return s;
}

/// An octahedron whose triangles are cut into four `levels` times, with corners at distance 1 from the
/// origin.
inline Surface_soup octahedron(int levels = 0) {
  Surface_soup s;
  s.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  s.facets = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  for (int level = 0; level < levels; ++level) {
    auto facets = std::move(s.facets);
    s.facets.clear();
    const auto middle = [&s](std::uint32_t a, std::uint32_t b) {
      const Point<3> p = 0.5 * (s.points[a] + s.points[b]);
      const auto it = std::find(s.points.begin(), s.points.end(), p);
      if (it == s.points.end()) s.points.push_back(p);
      return static_cast<std::uint32_t>(std::find(s.points.begin(), s.points.end(), p) - s.points.begin());
    };
    for (const auto& f : facets) {
      const auto ab = middle(f[0], f[1]), bc = middle(f[1], f[2]), ca = middle(f[2], f[0]);
      for (const auto& g : {std::vector{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}})
        s.facets.push_back(g);
    }
  }
  return s;
}

/// Both surfaces as one.
inline Surface_soup join(Surface_soup a, const Surface_soup& b) {
  const auto n = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto facet : b.facets) {
    for (auto& v : facet) v += n;
    a.facets.push_back(facet);
  }
  return a;
}

inline Surface_soup turned(Surface_soup s) {
  for (auto& facet : s.facets) std::reverse(facet.begin(), facet.end());
  return s;
}

/// The message of the error that a call throws, with its code in front; empty if it throws none.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return std::to_string(static_cast<int>(e.code())) + ": " + e.what();
  }
  return {};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_MESHING_SHAPES_H
