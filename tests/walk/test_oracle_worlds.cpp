// SPDX-License-Identifier: LGPL-3.0-or-later
// The worlds of the oracle tests have every degeneracy that they are meant to have. Counted on integer
// lattices, where arithmetic in doubles is exact.
#include <cellwalk/kernel/point.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "oracle/exact_world.h"
#include "oracle/seed.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::oracle {
namespace {

struct Features {
  int membranes = 0, solid_cells = 0, pinched_vertices = 0, pinched_edges = 0;
  int coplanar_facets = 0;      ///< cells with two facets in one plane
  int collinear_vertices = 0;   ///< facets with three vertices on one line
  int facets_shared_twice = 0;  ///< pairs of cells that share several facets
  int of_which_one_a_wall = 0;  ///< pairs of which one facet is a wall and another is not
  int duplicates = 0;           ///< points where another one lies
  /// Pairs of cells with a slit between them in the plane of a facet that they share.
  int slits_beside_ways = 0;
};

template <int D>
std::set<std::uint32_t> vertices_of(const Cell_soup<D>& soup, std::size_t cell) {
  return {soup.vertices.begin() + soup.facet_begin[soup.cell_begin[cell]],
          soup.vertices.begin() + soup.facet_begin[soup.cell_begin[cell + 1]]};
}

/// Cells that have all these vertices but fall apart where only facets with all of them join cells.
template <int D>
bool is_pinched(const Cell_soup<D>& soup, const Facet_table& table,
                const std::vector<std::uint32_t>& feature) {
  const auto has = [&](auto&& vertices) {
    return std::all_of(feature.begin(), feature.end(), [&](std::uint32_t v) {
      return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
    });
  };
  std::set<std::size_t> left;
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    if (has(vertices_of(soup, c))) left.insert(c);
  if (left.empty()) return false;
  std::vector<std::size_t> queue{*left.begin()};
  left.erase(left.begin());
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (std::size_t f = soup.cell_begin[queue[head]]; f < soup.cell_begin[queue[head] + 1]; ++f)
      if (table.opposite[f] >= 0 && has(soup.facet(f)) && left.erase(table.cell[table.opposite[f]]) > 0)
        queue.push_back(table.cell[table.opposite[f]]);
  return !left.empty();
}

bool are_on_one_line(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  return cross(b - a, c - a) == Vector<3>{};
}

/// A multiple of the normal of a facet whose first three vertices may lie on one line.
template <int D>
Vector<D> normal_of(const Cell_soup<D>& soup, std::size_t facet) {
  const auto loop = soup.facet(facet);
  const Point<D>& o = soup.points[loop[0]];
  Vector<D> sum{};
  if constexpr (D == 2) {
    const Vector<2> e = soup.points[loop[1]] - o;
    sum = {e[1], -e[0]};
  } else {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum = sum + cross(soup.points[loop[i]] - o, soup.points[loop[i + 1]] - o);
  }
  return sum;
}

template <int D>
void count_in_cell(const Cell_soup<D>& soup, std::size_t c, Features& features) {
  bool coplanar = false;
  for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    const auto loop = soup.facet(f);
    const Vector<D> normal = normal_of(soup, f);
    for (std::size_t g = f + 1; g < soup.cell_begin[c + 1]; ++g) {
      const auto other = soup.facet(g);
      coplanar = coplanar || std::all_of(other.begin(), other.end(), [&](std::uint32_t v) {
                   return dot(normal, soup.points[v] - soup.points[loop[0]]) == 0;
                 });
    }
    if constexpr (D == 3)
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (are_on_one_line(soup.points[loop[k]], soup.points[loop[(k + 1) % loop.size()]],
                            soup.points[loop[(k + 2) % loop.size()]])) {
          ++features.collinear_vertices;
          break;
        }
  }
  features.coplanar_facets += coplanar;
  features.solid_cells += soup.solid[c];
}

/// True if the middle of one facet lies in the box of the other, and they lie in one plane. For rectangles.
template <int D>
bool lie_on_each_other(const Cell_soup<D>& soup, std::size_t f, std::size_t g) {
  const auto holds_middle = [&](std::size_t box, std::size_t facet) {
    const auto loop = soup.facet(facet), rim = soup.facet(box);
    Point<D> middle{};
    for (const std::uint32_t v : loop)
      middle = middle + (1.0 / static_cast<double>(loop.size())) * soup.points[v];
    for (std::size_t i = 0; i < D; ++i) {
      const auto [low, high] = std::minmax_element(
          rim.begin(), rim.end(), [&](auto u, auto v) { return soup.points[u][i] < soup.points[v][i]; });
      if (middle[i] < soup.points[*low][i] || middle[i] > soup.points[*high][i]) return false;
    }
    return true;
  };
  const auto in_plane = [&](std::uint32_t v) {
    return dot(normal_of(soup, f), soup.points[v] - soup.points[soup.facet(f)[0]]) == 0;
  };
  return std::all_of(soup.facet(g).begin(), soup.facet(g).end(), in_plane) &&
         (holds_middle(f, g) || holds_middle(g, f));
}

/// The cells of a passable facet have one-sided walls in its plane that lie on each other.
template <int D>
bool is_beside_slit(const Cell_soup<D>& soup, const Facet_table& table, std::size_t facet) {
  const std::uint32_t c = table.cell[facet], d = table.cell[static_cast<std::size_t>(table.opposite[facet])];
  const Vector<D> normal = normal_of(soup, facet);
  for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
    if (table.opposite[f] >= 0 ||
        dot(normal, soup.points[soup.facet(f)[0]] - soup.points[soup.facet(facet)[0]]) != 0)
      continue;
    for (std::size_t g = soup.cell_begin[d]; g < soup.cell_begin[d + 1]; ++g)
      if (table.opposite[g] < 0 && lie_on_each_other(soup, f, g)) return true;
  }
  return false;
}

template <int D>
void count_in_world(const Cell_soup<D>& soup, Features& features) {
  const Facet_table table = make_facet_table(soup);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> shared;  // walls, passable
  std::set<std::vector<std::uint32_t>> edges;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) count_in_cell(soup, c, features);
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    const auto loop = soup.facet(f);
    for (std::size_t k = 0; D == 3 && k < loop.size(); ++k) {
      const auto [u, v] = std::minmax(loop[k], loop[(k + 1) % loop.size()]);
      edges.insert({u, v});
    }
    if (table.opposite[f] < 0) continue;
    const std::uint32_t c = table.cell[f], d = table.cell[table.opposite[f]];
    if (c > d) continue;
    ++shared[{c, d}][table.passable[f]];
    features.slits_beside_ways += table.passable[f] && is_beside_slit(soup, table, f);
    features.membranes += !table.passable[f] && !soup.solid[c] && !soup.solid[d];
  }
  features.duplicates += static_cast<int>(soup.points.size() -
                                          std::set<Point<D>>(soup.points.begin(), soup.points.end()).size());
  for (const auto& [cells, facets] : shared) {
    features.facets_shared_twice += facets[0] + facets[1] > 1;
    features.of_which_one_a_wall += facets[0] > 0 && facets[1] > 0;
  }
  for (std::uint32_t v = 0; v < soup.points.size(); ++v)
    features.pinched_vertices += is_pinched(soup, table, {v});
  for (const auto& edge : edges) features.pinched_edges += is_pinched(soup, table, edge);
}

template <int D>
Features count(int kind) {
  Features features;
  for (int k = 0; k < 8; ++k) {
    const World<D> world = make_world<D>(world_kinds * k + kind);
    EXPECT_TRUE(world.is_dyadic);
    count_in_world(world.soup, features);
  }
  return features;
}

template <int D>
void expect_every_degeneracy() {
  const Features integer = count<D>(0), boxes = count<D>(7), pinched = count<D>(8);
  EXPECT_GT(integer.membranes, 20);
  EXPECT_GT(integer.solid_cells, 3);
  EXPECT_GT(boxes.coplanar_facets, 20);
  EXPECT_GT(boxes.facets_shared_twice, 10);
  EXPECT_GT(boxes.of_which_one_a_wall, 5);
  EXPECT_GT(pinched.pinched_vertices, 10);
  EXPECT_EQ(integer.duplicates + boxes.duplicates + boxes.slits_beside_ways, 0);
  for (const int kind : {12, 13, 14}) {
    const Features slits = count<D>(kind);
    EXPECT_GT(slits.duplicates, 20) << kind;
    EXPECT_GT(slits.slits_beside_ways, kind == 13 ? 5 : 0) << kind;
    EXPECT_GT(slits.membranes, 5) << kind;
  }
  if constexpr (D == 3) {
    EXPECT_GT(boxes.collinear_vertices, 10);
    EXPECT_GT(pinched.pinched_edges, 10);
  }
}

TEST(OracleWorlds, HaveEveryDegeneracyInThePlane) { expect_every_degeneracy<2>(); }
TEST(OracleWorlds, HaveEveryDegeneracyInSpace) { expect_every_degeneracy<3>(); }

TEST(OracleWorlds, AreOthersForAnotherSeed) {
  const char* const set = std::getenv("CELLWALK_TEST_SEED");
  const std::string before = set == nullptr ? "" : set;
  const auto points = [](const char* seed) {
    setenv("CELLWALK_TEST_SEED", seed, 1);
    std::vector<Point<3>> all;
    for (std::uint64_t i = 0; i < world_kinds; ++i)
      for (const Point<3>& p : make_world<3>(i).soup.points) all.push_back(p);
    return all;
  };
  EXPECT_EQ(points("3"), points("3"));
  EXPECT_NE(points("3"), points("4"));
  EXPECT_NE(points("0"), points("3"));
  EXPECT_EQ(reseeded(7) % 720720, 7u) << "kinds of worlds are chosen by remainders";
  before.empty() ? unsetenv("CELLWALK_TEST_SEED") : setenv("CELLWALK_TEST_SEED", before.c_str(), 1);
}

}  // namespace
}  // namespace cellwalk::oracle
