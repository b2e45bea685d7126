// SPDX-License-Identifier: LGPL-3.0-or-later
// Layers of cells of all kinds that are cut in several ways, against brute force in rationals: the components
// before, by facets that overlap, are those after.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "environment/facing_oracle.h"
#include "environment/nonconforming.h"

namespace cellwalk {
namespace {

using test::Layers_options;

constexpr int members = 100;  // of each kind and dimension

/// The components of free cells, joined where they share a facet, and by these pairs.
template <int D>
std::size_t count_components(const Cell_soup<D>& soup,
                             const std::vector<std::array<std::uint32_t, 2>>& pairs) {
  std::vector<std::size_t> part(soup.cell_count());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto root = [&](std::size_t c) {
    while (part[c] != c) c = part[c];
    return c;
  };
  std::size_t components = soup.cell_count();
  const auto join = [&](std::size_t c, std::size_t d) {
    if (root(c) == root(d)) return;
    part[root(c)] = root(d);
    --components;
  };
  std::map<std::vector<std::uint32_t>, std::size_t> cell_of;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    if (soup.solid[c]) --components;
    for (std::size_t f = soup.cell_begin[c]; !soup.solid[c] && f < soup.cell_begin[c + 1]; ++f) {
      std::vector<std::uint32_t> vertices(soup.facet(f).begin(), soup.facet(f).end());
      std::sort(vertices.begin(), vertices.end());
      const auto [at, is_first] = cell_of.try_emplace(vertices, c);
      if (!is_first) join(c, at->second);
    }
  }
  for (const auto& [c, d] : pairs) join(c, d);
  return components;
}

struct Judged {
  int refined = 0, refused = 0;
};

template <int D>
Judged judge(const Layers_options& options, std::uint64_t first_seed, double tolerance = 0) {
  Judged judged;
  for (std::uint64_t seed = first_seed; seed < first_seed + members; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cell_soup<D> soup =
        test::layers<D>(options, [&](std::size_t n) { return static_cast<std::size_t>(random.below(n)); });
    if (soup.cell_count() == 0) continue;
    const auto pairs = test::overlapping_facets(soup);
    const std::size_t components = count_components(soup, pairs);
    Cell_soup<D> refined = soup;
    Soup_groups groups;
    Build_report before, built;
    Environment<D>::build(soup, {.duplicates = Duplicate_vertices::keep, .keep_map = false}, &before);
    const bool is_exact = tolerance == 0;
    try {
      const Refinement refinement = refine(refined, groups, tolerance);
      EXPECT_GE(refinement.facing.pairs, pairs.size());
      if (is_exact) {
        EXPECT_EQ(refinement.facing.pairs, pairs.size());
        EXPECT_TRUE(test::overlapping_facets(refined).empty());
      }
      Environment<D>::build(std::move(refined), {.split = !is_exact}, &built);
    } catch (const Error& error) {
      if (is_exact) {
        EXPECT_NE(std::string(error.what()).find("no coordinates give exactly"), std::string::npos)
            << error.what();
      }
      ++judged.refused;
      continue;
    }
    EXPECT_EQ(built.certificate.components, components);
    EXPECT_EQ(built.certificate.membranes, before.certificate.membranes);
    EXPECT_EQ(built.facing.near.pairs, 0u);
    EXPECT_NEAR(built.certificate.free_volume, before.certificate.free_volume,
                (is_exact ? 1e-12 : 1e-8) * before.certificate.free_volume);
    judged.refined += !pairs.empty();
    if (testing::Test::HasFailure()) break;
  }
  return judged;
}

TEST(RefineLayers, HangingNodes) {
  const Judged flat = judge<2>({.hanging = true}, 1000), solid = judge<3>({.hanging = true}, 2000);
  EXPECT_EQ(flat.refused + solid.refused, 0);
  EXPECT_GE(flat.refined, 90);
  EXPECT_GE(solid.refined, 90);
}

TEST(RefineLayers, BlocksThatShareAPlane) {
  const Judged flat = judge<2>({.shifted = true}, 3000), solid = judge<3>({.shifted = true}, 4000);
  EXPECT_EQ(flat.refused + solid.refused, 0) << "all crossings are whole";
  EXPECT_GE(flat.refined, 90);
  EXPECT_GE(solid.refined, 90);
}

TEST(RefineLayers, CellsOfSeveralKindsOnTheSameCorners) {
  const Judged judged = judge<3>({.cells = true}, 5000);
  EXPECT_GE(judged.refined, 80);
}

TEST(RefineLayers, AllAtOnce) {
  const Judged flat = judge<2>(
      {.cells = true, .hanging = true, .shifted = true, .collinear = true, .incomplete = true}, 6000);
  EXPECT_EQ(flat.refused, 0);
  EXPECT_GE(flat.refined, 45);
  const Judged solid =
      judge<3>({.cells = true, .hanging = true, .collinear = true, .incomplete = true}, 7000);
  EXPECT_GE(solid.refined, 80);
  EXPECT_EQ(solid.refused, 0);
  const Judged shifted = judge<3>({.cells = true, .shifted = true, .incomplete = true}, 7500);
  EXPECT_GE(shifted.refined, 10);
  EXPECT_GE(shifted.refused, 50) << "diagonals cross in thirds";
}

TEST(RefineLayers, AllAtOnceWithinATolerance) {
  const Judged judged = judge<3>({.cells = true, .shifted = true, .incomplete = true}, 8000, 1e-9);
  EXPECT_EQ(judged.refused, 0);
  EXPECT_GE(judged.refined, 80);
}

}  // namespace
}  // namespace cellwalk
