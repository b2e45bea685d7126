// SPDX-License-Identifier: LGPL-3.0-or-later
// Plain exact checks of a cell soup, written apart from the library's certification.
#ifndef CELLWALK_TESTS_ENVIRONMENT_SOUP_CHECKS_H
#define CELLWALK_TESTS_ENVIRONMENT_SOUP_CHECKS_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/records/cell_soup.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::test {

inline int sign(const Cell_soup<3>& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                std::uint32_t d) {
  Predicate_counts counts;
  return Lazy::orientation(counts, soup.points[a], soup.points[b], soup.points[c], soup.points[d]);
}

inline int sign(const Cell_soup<2>& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Predicate_counts counts;
  return Lazy::orientation(counts, soup.points[a], soup.points[b], soup.points[c]);
}

inline std::set<std::uint32_t> vertices_of(const auto& soup, std::size_t cell) {
  std::set<std::uint32_t> vertices;
  for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f)
    for (std::uint32_t v : soup.facet(f)) vertices.insert(v);
  return vertices;
}

/// Why cell is not exactly convex, planar, closed and positive; empty if it is.
inline std::string flaw(const Cell_soup<3>& soup, std::size_t cell) {
  const auto vertices = vertices_of(soup, cell);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
    const auto loop = soup.facet(f);
    const std::set<std::uint32_t> own(loop.begin(), loop.end());
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (!edges.insert({loop[i], loop[(i + 1) % loop.size()]}).second)
        return "an edge is used twice in one direction";
    // Seen from a strictly inner vertex of the cell, every turn of the loop is to the left or straight on.
    bool seen = false;
    for (std::uint32_t w : vertices) {
      int turns = 0;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int s = sign(soup, loop[i], loop[(i + 1) % loop.size()], loop[(i + 2) % loop.size()], w);
        if (s > 0) return "a vertex lies outside a facet, or the facet is not convex";
        if (s < 0) ++turns;
      }
      if (own.count(w) && turns) return "a facet is not planar";
      if (turns > 0 && turns < 3) return "a facet does not turn round";
      seen = seen || turns > 0;
    }
    if (!seen) return "the cell is flat";
  }
  for (const auto& [a, b] : edges)
    if (!edges.count({b, a})) return "the cell is not closed";
  return {};
}

inline std::string flaw(const Cell_soup<2>& soup, std::size_t cell) {
  std::vector<std::uint32_t> polygon;
  const std::size_t begin = soup.cell_begin[cell], end = soup.cell_begin[cell + 1];
  for (std::size_t f = begin; f < end; ++f) {
    polygon.push_back(soup.facet(f)[0]);
    if (soup.facet(f)[1] != soup.facet(f + 1 == end ? begin : f + 1)[0]) return "the cell is not closed";
  }
  bool turned = false;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::uint32_t w : polygon) {
      const int s = sign(soup, polygon[i], polygon[(i + 1) % polygon.size()], w);
      if (s < 0) return "a vertex lies outside an edge";
      turned = turned || s > 0;
    }
  return turned ? "" : "the cell is flat";
}

/// Volume or area by the divergence theorem, rounded.
inline double volume(const Cell_soup<3>& soup) {
  double sum = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto loop = soup.facet(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += dot(soup.points[loop[0]], cross(soup.points[loop[i]], soup.points[loop[i + 1]]));
  }
  return sum / 6;
}

inline double volume(const Cell_soup<2>& soup) {
  double sum = 0;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto& a = soup.points[soup.facet(f)[0]];
    const auto& b = soup.points[soup.facet(f)[1]];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum / 2;
}

/// How many facets have two sides, and how many have one; a vertex set with more than two sides throws off
/// the count.
struct Facet_counts {
  std::size_t inner = 0, boundary = 0, crowded = 0;
};

template <int D>
Facet_counts count_facets(const Cell_soup<D>& soup) {
  std::map<std::set<std::uint32_t>, int> sides;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto loop = soup.facet(f);
    ++sides[{loop.begin(), loop.end()}];
  }
  Facet_counts counts;
  for (const auto& [facet, n] : sides) ++(n == 1 ? counts.boundary : n == 2 ? counts.inner : counts.crowded);
  return counts;
}

/// FNV-1a over all bytes of a soup: the same on every machine, or generators are not reproducible.
template <int D>
std::uint64_t hash(const Cell_soup<D>& soup) {
  std::uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&h](const auto& values) {
    for (const auto& value : values) {
      unsigned char bytes[sizeof(value)];
      std::memcpy(bytes, &value, sizeof(value));
      for (unsigned char byte : bytes) h = (h ^ byte) * 0x100000001b3u;
    }
  };
  add(soup.points), add(soup.cell_begin), add(soup.facet_begin), add(soup.vertices);
  add(soup.impassable), add(soup.solid);
  return h;
}

/// Every cell is convex and closed, no facet belongs to more than two, and they can be glued.
template <int D>
void expect_sound(const Cell_soup<D>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c) ASSERT_EQ(flaw(soup, c), "") << "cell " << c;
  EXPECT_EQ(count_facets(soup).crowded, 0u);
  EXPECT_NO_THROW(glue(soup));
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_SOUP_CHECKS_H
