// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes that do not conform, by their components, walls and volumes once they are refined.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "environment/facing_oracle.h"
#include "environment/refine/random_blocks.h"

namespace cellwalk {
namespace {

using test::Block;
using test::cells_of;
using test::random_blocks;

struct Refined {
  Refinement refinement;
  Build_report built;
};

/// Refined and certified, with as many cells as before.
template <int D>
Refined refined(Cell_soup<D> soup, double tolerance = 0, Build_options options = {}) {
  Refined result;
  Soup_groups groups;
  const std::size_t cells = soup.cell_count();
  result.refinement = refine(soup, groups, tolerance);
  EXPECT_EQ(soup.cell_count(), cells);
  if (tolerance == 0) {
    if (options.duplicates == Duplicate_vertices::refuse) {
      EXPECT_TRUE(test::overlapping_facets(soup).empty());
    }
    options.split = options.simplicial;
  }
  Environment<D>::build(std::move(soup), options, &result.built);
  EXPECT_EQ(result.built.facing.near.pairs, 0u);
  return result;
}

template <int D>
std::string refusal(Cell_soup<D> soup, double tolerance = 0) {
  const Cell_soup<D> before = soup;
  Soup_groups groups;
  try {
    refine(soup, groups, tolerance);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    EXPECT_EQ(soup.vertices, before.vertices) << "nothing is changed";
    return error.what();
  }
  return {};
}

/// Cells as each of these blocks alone would have.
Cell_soup<3> hexahedra(const std::vector<Block<3>>& blocks) {
  Random random(1);
  return cells_of(blocks, random);
}

/// Turned about two axes: coordinates are rounded.
Cell_soup<3> turned(Cell_soup<3> soup) {
  for (Point<3>& p : soup.points) {
    const auto [x, y, z] = p;
    const double u = std::cos(0.4) * x - std::sin(0.4) * y, v = std::sin(0.4) * x + std::cos(0.4) * y;
    p = {u, std::cos(0.7) * v - std::sin(0.7) * z, std::sin(0.7) * v + std::cos(0.7) * z};
  }
  return soup;
}

TEST(Refine, AHexahedronBesideSixTetrahedra) {
  Random random(1);
  Cell_soup<3> tetrahedra = cells_of<3>({{{1, 0, 0}, {2, 1, 1}}}, random, 1);
  Cell_soup<3> both = hexahedra({{{0, 0, 0}, {1, 1, 1}}});
  const auto offset = static_cast<std::uint32_t>(both.points.size());
  both.points.insert(both.points.end(), tetrahedra.points.begin(), tetrahedra.points.end());
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t f = 4 * c; f < 4 * c + 4; ++f) {
      std::vector<std::uint32_t> loop(tetrahedra.facet(f).begin(), tetrahedra.facet(f).end());
      for (std::uint32_t& v : loop) v += offset;
      both.add_facet(loop);
    }
    both.end_cell();
  }
  const Refined result = refined(both, 0, {.duplicates = Duplicate_vertices::merge});
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.walls, 15u);
  EXPECT_EQ(result.built.certificate.volume, 2);
  EXPECT_EQ(result.built.merged_points, 4u) << "points in the same place are merged afterwards";
  EXPECT_EQ(result.refinement.facing.pairs, 2u);
  EXPECT_EQ(result.refinement.facets, 1u);
  EXPECT_EQ(result.refinement.pieces, 2u);
  EXPECT_EQ(result.refinement.facing.cells[0], 0u);
  EXPECT_EQ(result.refinement.facing.place[0], 1);
}

TEST(Refine, OneBlockAndFourSmallOnesOnIt) {
  const Refined result = refined(hexahedra({{{0, 0, 0}, {2, 2, 2}},
                                            {{0, 0, 2}, {1, 1, 3}},
                                            {{1, 0, 2}, {2, 1, 3}},
                                            {{0, 1, 2}, {1, 2, 3}},
                                            {{1, 1, 2}, {2, 2, 3}}}));
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.walls, 17u);
  EXPECT_EQ(result.built.certificate.volume, 12);
  EXPECT_EQ(result.refinement.pieces, 4u);
}

TEST(Refine, TwoBlocksThatShareAPartOfAPlane) {
  const Refined within = refined(hexahedra({{{0, 0, 0}, {2, 2, 2}}, {{0.5, 0.5, 2}, {1.5, 1.5, 3}}}));
  EXPECT_EQ(within.built.certificate.components, 1u);
  EXPECT_EQ(within.built.certificate.walls, 14u);
  EXPECT_EQ(within.built.certificate.volume, 9);
  EXPECT_EQ(within.refinement.points_added, 0u);
  const Refined across = refined(hexahedra({{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 2}, {3, 3, 3}}}));
  EXPECT_EQ(across.built.certificate.components, 1u);
  EXPECT_EQ(across.built.certificate.volume, 12);
  EXPECT_EQ(across.refinement.points_added, 2u) << "where sides cross";
  EXPECT_EQ(across.refinement.facets, 2u);
}

TEST(Refine, CrossingsThatDoublesCannotRepresentAreRefused) {
  // Lines of slope 1/3 cross whole x there.
  Cell_soup<3> soup = hexahedra({{{0, 0, 0}, {4, 4, 1}}});
  soup.points.insert(soup.points.end(), {{-1, 1, 1}, {5, 3, 1}, {-1, 3, 1}, {1, 2, 3}});
  add_tetrahedron(soup, 8, 9, 10, 11);
  const std::string message = refusal(soup);
  EXPECT_EQ(message.find("cells 0 and 1: their facets cross at about (4, 2.66666667, 1)"), 0u) << message;
  EXPECT_NE(message.find("--conform 1e-9"), std::string::npos);
  const Refined result = refined(soup, 1e-9);
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_GT(result.refinement.points_added, 0u);
}

/// An octree of three levels over two by three by three cubes.
std::vector<Block<3>> octree(std::uint64_t seed) {
  Random random(seed);
  std::vector<Block<3>> blocks;
  const auto add = [&](const auto& self, const Point<3>& low, double size) -> void {
    if (size > 0.25 && random.chance(size == 1 ? 0.5 : 0.35)) {
      for (int corner = 0; corner < 8; ++corner) {
        Point<3> at = low;
        for (std::size_t k = 0; k < 3; ++k) at[k] += corner >> k & 1 ? size / 2 : 0;
        self(self, at, size / 2);
      }
    } else {
      blocks.push_back({low, {low[0] + size, low[1] + size, low[2] + size}});
    }
  };
  for (int cube = 0; cube < 18; ++cube)
    add(add, {double(cube % 2), double(cube / 2 % 3), double(cube / 6)}, 1);
  return blocks;
}

TEST(Refine, Octrees) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Cell_soup<3> soup = hexahedra(octree(seed));
    ASSERT_GT(soup.cell_count(), 60u);
    const Refined result = refined(soup);
    EXPECT_GT(result.refinement.pieces, 100u);
    EXPECT_EQ(result.refinement.points_added, 0u);
    EXPECT_EQ(result.built.certificate.components, 1u);
    EXPECT_EQ(result.built.certificate.membranes, 0u);
    EXPECT_EQ(result.built.certificate.volume, 18);
    EXPECT_EQ(result.built.certificate.cells, soup.cell_count());
  }
}

TEST(Refine, AnOctreeTurnedByTwoAnglesWithinATolerance) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Cell_soup<3> soup = turned(hexahedra(octree(seed)));
    EXPECT_NE(refusal(soup).find("do not touch"), std::string::npos);
    const Refined result = refined(soup, 1e-9);
    EXPECT_EQ(result.built.certificate.components, 1u);
    EXPECT_EQ(result.built.certificate.membranes, 0u);
    EXPECT_NEAR(result.built.certificate.volume, 18, 1e-9);
    EXPECT_GT(result.built.split.cells_made, soup.cell_count());
  }
}

TEST(Refine, GapsAreClosedWithinATolerance) {
  Cell_soup<3> soup = hexahedra({{{0, 0, 0}, {1, 1, 1}}, {{1 + 0x1p-52, 0, 0}, {2, 1, 1}}});
  const std::string message = refusal(soup);
  EXPECT_EQ(message.find("cells 0 and 1 have facets that face each other at (1, 0.5, 0.5)"), 0u) << message;
  const Refined result = refined(soup, 1e-9);
  EXPECT_EQ(result.refinement.points_joined, 4u);
  EXPECT_EQ(result.refinement.farthest, 0x1p-52);
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.volume, 2);
  // Walls that the file marks are meant.
  soup.impassable.assign(soup.impassable.size(), 1);
  EXPECT_EQ(refusal(soup), "");
}

TEST(Refine, CellsOfShortEdgesNeedASmallTolerance) {
  Cell_soup<3> soup = hexahedra({{{0, 0, 0}, {1, 1, 1}}});
  soup.points.insert(soup.points.end(), {{1, 0.001, 0}, {2, 0, 0}, {2, 0.001, 0}, {2, 1, 1}, {2, 0, 1}});
  add_hexahedron(soup, {1, 8, 7, 5, 9, 10, 11, 12});
  EXPECT_NE(refusal(soup, 0.01).find("cell 1: two of its corners at (1, 0.001, 0) would become"),
            std::string::npos);
  EXPECT_EQ(refined(soup, 1e-9).built.certificate.components, 1u);
  EXPECT_EQ(refined(soup).built.certificate.components, 1u);
}

/// Blocks that tile a box, or most of it.
template <int D>
void judge_blocks(std::uint64_t seed, double absent, double in_tetrahedra, int trials,
                  bool simplicial = false) {
  int refined_ones = 0, several = 0;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    Random random(seed + static_cast<std::uint64_t>(trial));
    const auto blocks = random_blocks<D>(random, 8, 2 + random.below(30), absent);
    const Cell_soup<D> soup = cells_of(blocks, random, in_tetrahedra);
    if (soup.cell_count() == 0) continue;
    const auto [components, volume] = test::components_and_volume(blocks);
    const Refined result = refined(soup, 0, {.simplicial = simplicial});
    EXPECT_EQ(result.built.certificate.components, components);
    EXPECT_EQ(result.built.certificate.membranes, 0u);
    EXPECT_NEAR(result.built.certificate.volume, volume, 1e-9);
    refined_ones += result.refinement.facing.pairs > 0;
    several += components > 1;
    EXPECT_EQ(result.refinement.facing.pairs, test::overlapping_facets(soup).size());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(refined_ones, trials / 2);
  if (absent > 0) {
    EXPECT_GT(several, trials / 10);
  }
}

TEST(Refine, RandomBlocks) {
  judge_blocks<3>(1000, 0, 0, 150);
  judge_blocks<2>(2000, 0, 0, 150);
}

TEST(Refine, RandomBlocksWithGapsBetween) {
  judge_blocks<3>(3000, 0.3, 0, 150);
  judge_blocks<2>(4000, 0.3, 0.3, 150);
}

TEST(Refine, AllCellsAreSimplicesIfAsked) {
  judge_blocks<3>(5000, 0.3, 0, 30, true);
  judge_blocks<2>(6000, 0.3, 0, 30, true);
}

TEST(Refine, RefinedMeshesStayAsTheyAre) {
  Random random(7);
  Cell_soup<3> soup = cells_of(random_blocks<3>(random, 8, 20, 0), random);
  Soup_groups groups{{"all", {}}};
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) groups["all"].facets.push_back(f);
  ASSERT_GT(refine(soup, groups, 0).pieces, 0u);
  EXPECT_EQ(groups["all"].facets.size(), soup.facet_count());
  const Cell_soup<3> once = soup;
  EXPECT_EQ(refine(soup, groups, 0).facing.pairs, 0u);
  EXPECT_EQ(soup.vertices, once.vertices);
  EXPECT_EQ(soup.facet_begin, once.facet_begin);
}

TEST(Refine, WallsAndGroupsFollowTheirPieces) {
  // The top of the large block is a wall in a group; a small one stands on it.
  Cell_soup<3> soup = hexahedra({{{0, 0, 0}, {2, 2, 2}}, {{0.5, 0.5, 2}, {1.5, 1.5, 3}}});
  soup.impassable[1] = 1;
  Soup_groups groups{{"top", {{1}, {}}}, {"side", {{2}, {1}}}};
  const Refinement refinement = refine(soup, groups, 0);
  EXPECT_EQ(refinement.pieces, 5u);
  EXPECT_EQ(groups["top"].facets, (std::vector<std::uint32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(groups["side"].facets, (std::vector<std::uint32_t>{6}));
  EXPECT_EQ(groups["side"].cells, (std::vector<std::uint32_t>{1}));
  const Group_places<3> places(soup, groups);
  Build_report built;
  const auto environment = Environment<3>::build(std::move(soup), {}, &built);
  EXPECT_EQ(built.certificate.membranes, 1u);
  EXPECT_EQ(built.certificate.components, 2u);
  EXPECT_EQ(places.find(environment.snapshot(), {}).at("top").facets.size(), 5u);
}

TEST(Refine, SolidCellsAndMeshesThatConformStayAsTheyAre) {
  Cell_soup<3> soup = hexahedra({{{0, 0, 0}, {2, 2, 2}}, {{0.5, 0.5, 2}, {1.5, 1.5, 3}}});
  soup.solid[1] = 1;
  const Refined result = refined(soup);
  EXPECT_EQ(result.refinement.facing.pairs, 0u);
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.free_volume, 8);
}

TEST(Refine, InvertedMeshesAreTurnedRoundAfterwards) {
  Random random(11);
  Cell_soup<3> soup = cells_of(random_blocks<3>(random, 8, 20, 0), random);
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    std::reverse(soup.vertices.begin() + soup.facet_begin[f],
                 soup.vertices.begin() + soup.facet_begin[f + 1]);
  const Refined result = refined(soup);
  EXPECT_TRUE(result.built.flipped);
  EXPECT_GT(result.refinement.pieces, 0u);
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.volume, 512);
}

/// Blocks that have points of their own, each off by a few units in the last place.
template <int D>
Cell_soup<D> rounded_apart(const std::vector<Block<D>>& blocks, Random& random) {
  Cell_soup<D> soup;
  for (const Block<D>& block : blocks) {
    Cell_soup<D> own = cells_of<D>({block}, random);
    const auto offset = static_cast<std::uint32_t>(soup.points.size());
    for (Point<D>& p : own.points) {
      for (double& x : p) x += 0x1p-50 * static_cast<double>(random.below(5));
      soup.points.push_back(p);
    }
    for (std::size_t f = 0; f < own.facet_count(); ++f) {
      std::vector<std::uint32_t> loop(own.facet(f).begin(), own.facet(f).end());
      for (std::uint32_t& v : loop) v += offset;
      soup.add_facet(loop);
    }
    if (own.cell_count() > 0) soup.end_cell();
  }
  return soup;
}

template <int D>
void judge_rounded(std::uint64_t first_seed) {
  int refused = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto blocks = random_blocks<D>(random, 8, 2 + random.below(12), 0.2);
    const Cell_soup<D> soup = rounded_apart(blocks, random);
    if (soup.cell_count() == 0) continue;
    const auto [components, volume] = test::components_and_volume(blocks);
    try {
      const Refined result = refined(soup, 1e-9, {.duplicates = Duplicate_vertices::merge});
      EXPECT_EQ(result.built.certificate.components, components);
      EXPECT_NEAR(result.built.certificate.volume, volume, 1e-9);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::not_certified);
      ++refused;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(refused, 0);
}

TEST(Refine, BlocksThatRoundingHasPartedAreJoined) {
  judge_rounded<2>(7000);
  judge_rounded<3>(8000);
}

TEST(Refine, CellsThatOverlapAreLeftToCertification) {
  Cell_soup<3> soup = hexahedra(
      {{{0, 0, 0}, {4, 4, 1}}, {{0, 0, 1}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}, {{0, 3, 1}, {1, 4, 2}}});
  Soup_groups groups;
  try {
    refine(soup, groups, 0);
    Environment<3>::build(std::move(soup));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("cells overlap"), std::string::npos) << error.what();
  }
}

TEST(Refine, ManyCellsOnOne) {
  std::vector<Block<3>> blocks{{{0, 0, 0}, {40, 40, 1}}};
  for (int i = 0; i < 1600; ++i)
    if (i % 7 != 3)
      blocks.push_back({{double(i % 40), double(i / 40), 1}, {double(i % 40 + 1), double(i / 40 + 1), 2}});
  const Refined result = refined(hexahedra(blocks));
  EXPECT_EQ(result.built.certificate.components, 1u);
  EXPECT_EQ(result.built.certificate.membranes, 0u);
  EXPECT_EQ(result.built.certificate.volume, 1600.0 + static_cast<double>(blocks.size() - 1));
}

}  // namespace
}  // namespace cellwalk
