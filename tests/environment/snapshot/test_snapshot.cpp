// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/kernel/exact.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace cellwalk {
namespace {

template <int D>
Cell_soup<D> world(std::uint64_t seed) {
  return lattice_world(mixed_lattice_world<D>(seed));
}

/// Side of x against a half-facet, from its loop.
int side(const Snapshot<2>& s, Half_facet f, const Point<2>& x) {
  Predicate_counts counts;
  const auto loop = s.loop(f);
  return -Exact::orientation(counts, s.point(loop[0]), s.point(loop[1]), x);
}
int side(const Snapshot<3>& s, Half_facet f, const Point<3>& x) {
  Predicate_counts counts;
  const auto loop = s.loop(f);
  return Exact::orientation(counts, s.point(loop[0]), s.point(loop[1]), s.point(loop[2]), x);
}

template <int D>
void expect_same_as_soup(const Cell_soup<D>& soup, const Gluing& gluing) {
  std::vector<Half_facet> slots;
  const Snapshot<D> s = Snapshot<D>::compile(soup, gluing, &slots);
  ASSERT_EQ(s.cell_count(), soup.cell_count());
  ASSERT_EQ(slots.size(), soup.facet_count());
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const Cell cell = s.cell(c);
    EXPECT_EQ(s.index(cell), c);
    EXPECT_EQ(s.is_solid(cell), soup.solid[c] != 0);
    EXPECT_EQ(s.facet_count(cell), soup.cell_begin[c + 1] - soup.cell_begin[c]);
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      ASSERT_EQ(s.cell_of(slots[f]), cell);
      // The same loop, turned.
      auto loop = s.loop(slots[f]);
      const auto expected = soup.facet(f);
      const auto start = std::find(loop.begin(), loop.end(), expected[0]);
      ASSERT_NE(start, loop.end());
      std::rotate(loop.begin(), start, loop.end());
      EXPECT_TRUE(std::equal(loop.begin(), loop.end(), expected.begin(), expected.end()));
      const std::uint32_t g = gluing.opposite[f];
      if (g == no_facet) {
        EXPECT_EQ(s.neighbour(slots[f]), Cell::none);
        EXPECT_EQ(s.opposite(slots[f]), Half_facet::none);
        EXPECT_TRUE(s.is_impassable(slots[f]));
      } else {
        EXPECT_EQ(s.opposite(slots[f]), slots[g]);
        EXPECT_EQ(s.is_impassable(slots[f]), soup.impassable[f] || soup.impassable[g]);
      }
    }
  }
}

TEST(Snapshot, HoldsWhatTheSoupSays) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto planar = world<2>(seed);
    expect_same_as_soup(planar, glue(planar));
    const auto spatial = world<3>(seed);
    expect_same_as_soup(spatial, glue(spatial));
  }
}

/// Every certain sign of a plane is the exact one; returns the share of uncertain ones.
template <int D>
double expect_planes_within_bound(const Cell_soup<D>& soup, double reach, std::uint64_t seed) {
  const Snapshot<D> s = Snapshot<D>::compile(soup, glue(soup));
  std::mt19937_64 random(seed);
  std::size_t tested = 0, uncertain = 0;
  for (std::size_t i = 0; i < 4000; ++i) {
    const Cell c = s.cell(random() % s.cell_count());
    const Cell_view<D> cell = s.view(c);
    // Near one of the cell's vertices, where signs are hardest.
    Point<D> x = cell.point(random() % cell.vertex_count());
    for (double& t : x) t += reach * (std::ldexp(static_cast<double>(random() >> 11), -52) - 1);
    Float_point<D> y;
    if (!s.frame().map(x, y)) continue;
    for (std::size_t f = 0; f < cell.facet_count(); ++f) {
      const float value = evaluate(s.blocks(c)[f / 4], y)[f % 4];
      const int exact = side(s, Snapshot<D>::half_facet(c, f), x);
      ++tested;
      if (value > plane_error)
        EXPECT_EQ(exact, 1);
      else if (value < -plane_error)
        EXPECT_EQ(exact, -1);
      else
        ++uncertain;
    }
  }
  EXPECT_GT(tested, 4000u);
  return static_cast<double>(uncertain) / static_cast<double>(tested);
}

TEST(Snapshot, PlanesKeepTheirBound) {
  Simplex_grid_options<3> options;
  options.cells = {8, 8, 8};
  options.jitter = 0.15;
  const auto tetrahedra = tetrahedral_grid(options);
  EXPECT_LT(expect_planes_within_bound(tetrahedra, 1.0, 1), 0.001);
  // Within a few bounds of the planes: many are uncertain, none is wrong.
  const double near = expect_planes_within_bound(tetrahedra, 1e-5, 2);
  EXPECT_GT(near, 0.05);
  EXPECT_LT(near, 0.95);
  expect_planes_within_bound(tetrahedra, 1e-12, 3);
  expect_planes_within_bound(world<2>(1), 1e-5, 4);
  expect_planes_within_bound(world<3>(1), 1e-5, 5);
}

TEST(Snapshot, PlanesAreNotTrustedOutsideTheirBox) {
  const auto soup = hex_grid({});
  const Snapshot<3> s = Snapshot<3>::compile(soup, glue(soup));
  Float_point<3> y;
  EXPECT_TRUE(s.frame().map({10, 10, 10}, y));
  EXPECT_FALSE(s.frame().map({1e6, 0, 0}, y));
  EXPECT_FALSE(s.frame().map({NAN, 0, 0}, y));
}

TEST(Snapshot, PlanesOfSliversAreLeftToExactSigns) {
  // Three points an ulp off a line: rounding decides the direction of the normal.
  const Point<3> p{0.1, 0.2, 0.3};
  Cell_soup<3> soup;
  soup.points = {
      p, p + Vector<3>{0.7, 0.7, 0.7}, p + Vector<3>{0.35, 0.35, std::nextafter(0.35, 1.0)}, {1, 0, 0}};
  add_tetrahedron(soup, 0, 1, 2, 3);
  const Snapshot<3> s = Snapshot<3>::compile(soup, glue(soup));
  EXPECT_GE(s.uncertified_planes(), 1u);
}

TEST(Snapshot, NeighboursInSpaceAreNeighboursInMemory) {
  Simplex_grid_options<3> options;
  options.cells = {16, 16, 16};
  const auto soup = tetrahedral_grid(options);
  const Snapshot<3> s = Snapshot<3>::compile(soup, glue(soup));
  double distance = 0, links = 0;
  for (std::size_t c = 0; c < s.cell_count(); ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const Cell next = s.neighbour(Snapshot<3>::half_facet(s.cell(c), i));
      if (next == Cell::none) continue;
      distance += std::abs(double(to_index(next)) - double(to_index(s.cell(c)))) < 64;
      ++links;
    }
  // Two thirds of all crossings stay within 4 KiB of planes.
  EXPECT_GT(distance / links, 0.66);
}

TEST(Snapshot, IsCompact) {
  Simplex_grid_options<3> options;
  options.cells = {16, 16, 16};
  const auto soup = tetrahedral_grid(options);
  const Snapshot<3> s = Snapshot<3>::compile(soup, glue(soup));
  EXPECT_LE(static_cast<double>(s.bytes()) / static_cast<double>(s.cell_count()), 150);
}

}  // namespace
}  // namespace cellwalk
