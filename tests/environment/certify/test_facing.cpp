// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes that do not conform are refused, wherever they are built, unless duplicates are kept.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "environment/facing_oracle.h"
#include "environment/nonconforming.h"

namespace cellwalk {
namespace {

using test::layers;
using test::Layers_options;

constexpr int members = 120;  // of each kind and dimension

template <int D>
Cell_soup<D> member(const Layers_options& options, std::uint64_t seed) {
  Random random(seed);
  return layers<D>(options, [&](std::size_t n) { return static_cast<std::size_t>(random.below(n)); });
}

/// The report of a soup that is built with duplicates kept.
template <int D>
Facing_walls kept(const Cell_soup<D>& soup) {
  Build_report report;
  Environment<D>::build(soup, {.duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false},
                        &report);
  return report.facing;
}

/// Why a soup is refused; empty if it is not.
template <int D>
std::string refusal(const Cell_soup<D>& soup, Duplicate_vertices duplicates = Duplicate_vertices::refuse) {
  try {
    Environment<D>::build(soup, {.duplicates = duplicates, .split = false, .keep_map = false});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    return error.what();
  }
  return {};
}

/// True if a rounded point lies in the boxes of two cells.
template <int D>
bool is_in_both(const Cell_soup<D>& soup, const Facing_facets& found) {
  constexpr double margin = 1e-9;
  bool is_in = found.place.size() == D;
  for (const std::uint32_t c : found.cells)
    for (std::size_t k = 0; is_in && k < D; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
        for (const std::uint32_t v : soup.facet(f)) {
          low = std::min(low, soup.points[v][k]);
          high = std::max(high, soup.points[v][k]);
        }
      is_in = found.place[k] > low - margin && found.place[k] < high + margin;
    }
  return is_in;
}

/// Refused exactly if facets overlap, with the first two cells, and found as often as in rationals. Returns
/// the number of members with such facets.
template <int D>
int judge(const Layers_options& options, std::uint64_t first_seed) {
  int refused = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + members; ++seed) {
    SCOPED_TRACE(seed);
    const Cell_soup<D> soup = member<D>(options, seed);
    if (soup.cell_count() == 0) continue;
    const auto expected = test::overlapping_facets(soup);
    const Facing_walls found = kept(soup);
    EXPECT_EQ(found.overlapping.pairs, expected.size());
    EXPECT_EQ(found.near.pairs, 0u);
    const std::string message = refusal(soup);
    EXPECT_EQ(message.empty(), expected.empty()) << message;
    if (seed % 8 == 0) {
      EXPECT_EQ(refusal(soup, Duplicate_vertices::merge), message);
    }
    if (expected.empty()) continue;
    ++refused;
    EXPECT_EQ(found.overlapping.cells, expected[0]);
    EXPECT_TRUE(is_in_both(soup, found.overlapping));
    const std::string cells = "cells " + std::to_string(expected[0][0]) + " and " +
                              std::to_string(expected[0][1]) + " share a part";
    EXPECT_EQ(message.find(cells), 0u) << message;
    EXPECT_NE(message.find("--duplicates keep"), std::string::npos);
    if (testing::Test::HasFailure()) break;
  }
  return refused;
}

TEST(Facing, CellsOfSeveralKindsOnTheSameCorners) { EXPECT_GE(judge<3>({.cells = true}, 1000), 100); }

TEST(Facing, HangingNodes) {
  EXPECT_GE(judge<2>({.hanging = true}, 2000), 100);
  EXPECT_GE(judge<3>({.hanging = true}, 3000), 100);
  EXPECT_GE(judge<2>({.cells = true, .hanging = true}, 4000), 100);
}

TEST(Facing, BlocksThatShareAPlane) {
  EXPECT_GE(judge<2>({.shifted = true}, 5000), 100);
  EXPECT_GE(judge<3>({.shifted = true}, 6000), 100);
}

TEST(Facing, VerticesWithinSides) {
  // Polyhedra with the points on their edges: in 2D they conform, as far as all have them.
  EXPECT_GE(judge<2>({.shifted = true, .collinear = true}, 7000), 60);
  EXPECT_GE(judge<3>({.shifted = true, .collinear = true}, 8000), 100);
}

TEST(Facing, SolidCellsAndCellsLeftOut) {
  const int refused_2 =
      judge<2>({.cells = true, .hanging = true, .collinear = true, .incomplete = true}, 9000);
  EXPECT_GE(refused_2, 60);
  EXPECT_LT(refused_2, members) << "some have none";
  EXPECT_GE(judge<2>({.shifted = true, .incomplete = true, .turned = false}, 9500), 60);
  EXPECT_GE(judge<3>({.cells = true, .collinear = true, .incomplete = true, .turned = false}, 10000), 60);
}

TEST(Facing, MeshesThatConformAreAccepted) {
  EXPECT_EQ(judge<2>({}, 11000), 0);
  EXPECT_EQ(judge<3>({}, 12000), 0);
  EXPECT_EQ(judge<2>({.cells = true}, 13000), 0) << "triangles beside squares";
  EXPECT_EQ(judge<2>({.incomplete = true}, 14000), 0);
  EXPECT_EQ(judge<3>({.incomplete = true}, 15000), 0);
}

/// Layers with points of their own: with a gap, the pairs that overlap without it are near.
template <int D>
int judge_gaps(Layers_options options, std::uint64_t first_seed) {
  constexpr double least = 0x1p-44;  // the sums stay exact
  int gaps = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + members; ++seed) {
    SCOPED_TRACE(seed);
    options.gap = 0;
    const Cell_soup<D> torn = member<D>(options, seed);
    const std::size_t pairs = test::overlapping_facets(torn).size();
    EXPECT_EQ(kept(torn).overlapping.pairs, pairs);
    EXPECT_NE(refusal(torn).find("lie in the same place"), std::string::npos);
    options.gap = std::ldexp(least, static_cast<int>(seed % 8));
    const Cell_soup<D> parted = member<D>(options, seed);
    const Facing_walls found = kept(parted);
    EXPECT_EQ(found.near.pairs, pairs);
    EXPECT_EQ(found.overlapping.pairs, 0u);
    EXPECT_GT(found.near.distance, 0);
    EXPECT_LT(found.near.distance, 64 * options.gap);
    EXPECT_TRUE(is_in_both(parted, found.near));
    EXPECT_EQ(refusal(parted), "") << "no tolerance decides";
    if (seed % 8 == 0) {
      options.gap = 0x1p-10;
      EXPECT_EQ(kept(member<D>(options, seed)).near.pairs, 0u);
    }
    gaps += pairs > 0;
    if (testing::Test::HasFailure()) break;
  }
  return gaps;
}

TEST(Facing, GapsOfRoundingAreCounted) {
  EXPECT_EQ(judge_gaps<2>({.hanging = true}, 20000), members);
  EXPECT_EQ(judge_gaps<3>({.hanging = true}, 21000), members);
  EXPECT_EQ(judge_gaps<2>({.shifted = true}, 22000), members);
  EXPECT_EQ(judge_gaps<3>({.cells = true, .by_layer = true}, 23000), members);
}

/// Two unit cubes (squares), the second one beyond a gap, and moved.
template <int D>
Cell_soup<D> two_blocks(double gap, const Vector<D>& shift) {
  Cell_soup<D> soup;
  if constexpr (D == 2)
    soup = square_grid({.cells = {1, 1}});
  else
    soup = hex_grid({.cells = {1, 1, 1}});
  const std::size_t n = soup.points.size();
  const Cell_soup<D> first = soup;
  for (std::size_t v = 0; v < n; ++v) {
    Point<D> p = first.points[v];
    p[0] += 1 + gap;
    soup.points.push_back(p);
  }
  for (Point<D>& p : soup.points) p = p + shift;
  for (std::size_t f = 0; f < first.facet_count(); ++f) {
    std::vector<std::uint32_t> loop(first.facet(f).begin(), first.facet(f).end());
    for (std::uint32_t& v : loop) v += static_cast<std::uint32_t>(n);
    soup.add_facet(loop);
  }
  soup.end_cell();
  return soup;
}

TEST(Facing, TheToleranceIsABillionthOrWhatCoordinatesAreOff) {
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(kept(two_blocks<3>(ulp, {})).near.pairs, 1u);
  EXPECT_EQ(kept(two_blocks<3>(2e-9, {})).near.pairs, 1u) << "of a diagonal of 2.4";
  EXPECT_EQ(kept(two_blocks<3>(3e-9, {})).near.pairs, 0u);
  // Far away, an ulp is 2^-20.
  EXPECT_EQ(kept(two_blocks<3>(0x1p-20, {0x1p32, 0, 0})).near.pairs, 1u);
  EXPECT_EQ(kept(two_blocks<2>(0x1p-20, {0, 0x1p32})).near.pairs, 1u);
  EXPECT_EQ(kept(two_blocks<2>(0x1p-10, {0x1p32, 0})).near.pairs, 0u);
}

TEST(Facing, AFarCellMakesNothingNear) {
  // Seen from 10^15 away all cells are within a billionth of the diagonal.
  Cell_soup<2> soup = square_grid({.cells = {20, 20}, .solid_cells = {5, 50, 55, 200}});
  soup.points.push_back({1e15, 0});
  soup.points.push_back({1e15, 1});
  soup.points.push_back({1e15 - 1, 1});
  const auto n = static_cast<std::uint32_t>(soup.points.size());
  add_polygon(soup, std::vector<std::uint32_t>{n - 3, n - 2, n - 1});
  EXPECT_EQ(kept(soup).near.pairs, 0u);
  EXPECT_EQ(refusal(soup), "");
}

TEST(Facing, CellsAreThoseOfTheInput) {
  // The first cell is split, so that those after it have other numbers then.
  Cell_soup<3> soup = hex_grid({.cells = {1, 1, 1}});
  for (Point<3>& p : soup.points) p[2] += 9;
  soup.points[0][2] -= 0.5;
  const std::uint32_t n = static_cast<std::uint32_t>(soup.points.size());
  const Cell_soup<3> blocks = member<3>({.hanging = true, .turned = false}, 1);
  soup.points.insert(soup.points.end(), blocks.points.begin(), blocks.points.end());
  for (std::size_t c = 0; c < blocks.cell_count(); ++c) {
    for (std::size_t f = blocks.cell_begin[c]; f < blocks.cell_begin[c + 1]; ++f) {
      std::vector<std::uint32_t> loop(blocks.facet(f).begin(), blocks.facet(f).end());
      for (std::uint32_t& v : loop) v += n;
      soup.add_facet(loop);
    }
    soup.end_cell();
  }
  const auto expected = test::overlapping_facets(blocks);
  ASSERT_FALSE(expected.empty());
  Build_report report;
  Environment<3>::build(soup, {.duplicates = Duplicate_vertices::keep}, &report);
  EXPECT_GT(report.split.cells_made, 1u);
  EXPECT_EQ(report.facing.overlapping.cells,
            (std::array<std::uint32_t, 2>{expected[0][0] + 1, expected[0][1] + 1}));
}

TEST(Facing, MovedWallsMayTouch) {
  // Two squares a gap apart, as a valve that is shut: the walls close the gap, and stay walls.
  Environment<2> environment = Environment<2>::build(two_blocks<2>(0.5, {}));
  const auto points = environment.snapshot().points();
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (points[v][0] == 1.5) environment.move_vertex(v, {1, points[v][1] / 2 + 0.25});
  Facing_walls facing;
  EXPECT_EQ(environment.certify(&facing).components, 2u);
  EXPECT_EQ(facing.overlapping.pairs, 1u);
  EXPECT_NE(refusal(environment.soup()), "") << "as a file, it is suspicious";
}

TEST(Facing, TheSameForAnyNumberOfThreads) {
  const Cell_soup<3> soup = member<3>({.cells = true, .hanging = true}, 77);
  const std::string message = refusal(soup);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(refusal(soup), message);
  EXPECT_FALSE(message.empty());
}

}  // namespace
}  // namespace cellwalk
