// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/generators/slits.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

/// What a world has of each degeneracy.
struct Variety {
  std::size_t tetrahedra = 0, prisms = 0, pyramids = 0, large = 0;
  std::size_t collinear = 0;     // facets with collinear vertices
  std::size_t shared_twice = 0;  // pairs of cells with several common facets
  std::size_t half_walled = 0;   // of these, pairs with both a wall and a passage
  std::size_t membranes = 0;     // inner facets that are walls between free cells
  std::size_t solid = 0;
};

Variety variety(const Cell_soup<3>& soup) {
  Variety v;
  const Gluing gluing = glue(soup);
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> contacts;
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) {
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) cell_of[f] = c;
    const auto vertices = test::vertices_of(soup, c).size();
    const auto facets = soup.cell_begin[c + 1] - soup.cell_begin[c];
    v.tetrahedra += facets == 4;
    v.prisms += vertices == 6;
    v.pyramids += vertices == 5 && facets == 5;
    v.large += vertices > 8;
    v.solid += soup.solid[c];
  }
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    v.collinear += soup.facet(f).size() > 4;
    const auto g = gluing.opposite[f];
    if (g == no_facet || g < f) continue;
    EXPECT_EQ(soup.impassable[f] || soup.solid[cell_of[g]], soup.impassable[g] || soup.solid[cell_of[f]]);
    v.membranes += soup.impassable[f] && !soup.solid[cell_of[f]] && !soup.solid[cell_of[g]];
    const auto [a, b] = std::minmax(cell_of[f], cell_of[g]);
    ++contacts[{a, b}][soup.impassable[f]];
  }
  for (const auto& [pair, count] : contacts) {
    v.shared_twice += count[0] + count[1] > 1;
    v.half_walled += count[0] > 0 && count[1] > 0;
  }
  return v;
}

TEST(LatticeWorld, MixedWorldsAreSoundAndVaried) {
  Variety sum;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto soup = lattice_world(mixed_lattice_world<3>(seed));
    test::expect_sound(soup);
    const Variety v = variety(soup);
    sum.tetrahedra += v.tetrahedra, sum.prisms += v.prisms, sum.pyramids += v.pyramids, sum.large += v.large;
    sum.collinear += v.collinear, sum.shared_twice += v.shared_twice, sum.half_walled += v.half_walled;
    sum.membranes += v.membranes, sum.solid += v.solid;
  }
  EXPECT_GT(sum.tetrahedra, 100u);
  EXPECT_GT(sum.prisms, 30u);
  EXPECT_GT(sum.pyramids, 50u);
  EXPECT_GT(sum.large, 50u);
  EXPECT_GT(sum.collinear, 50u);
  EXPECT_GT(sum.shared_twice, 30u);
  EXPECT_GT(sum.half_walled, 10u);
  EXPECT_GT(sum.membranes, 200u);
  EXPECT_GT(sum.solid, 20u);
}

TEST(LatticeWorld, MixedWorldsOfThePlaneAreSound) {
  std::size_t large = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto options = mixed_lattice_world<2>(seed);
    options.cells = {7, 5};
    const auto soup = lattice_world(options);
    test::expect_sound(soup);
    for (std::size_t c = 0; c < soup.cell_count(); ++c)
      large += soup.cell_begin[c + 1] - soup.cell_begin[c] > 4;
  }
  EXPECT_GT(large, 20u);
}

TEST(LatticeWorld, FillsTheLattice) {
  auto options = mixed_lattice_world<3>(3);
  options.cells = {5, 4, 3};
  options.removed_share = 0;
  EXPECT_EQ(test::volume(lattice_world(options)), 60);
  auto plane = mixed_lattice_world<2>(3);
  plane.removed_share = 0;
  EXPECT_EQ(test::volume(lattice_world(plane)), 16);
}

TEST(LatticeWorld, StaysPlanarUnderExactMaps) {
  for (const auto& map : {rotated<3>(), rotated<3>(0x1p-20), rotated<3>(1e6), sheared<3>(0.375),
                          scaled<3>(0.1), scaled<3>(1e-6), scaled<3>(1e6)}) {
    auto options = mixed_lattice_world<3>(5);
    options.cells = {3, 3, 3};
    options.map = map;
    test::expect_sound(lattice_world(options));
  }
  for (const auto& map : {rotated<2>(), sheared<2>(0x1p-30), scaled<2>(0.1)}) {
    auto options = mixed_lattice_world<2>(5);
    options.map = map;
    test::expect_sound(lattice_world(options));
  }
}

TEST(LatticeWorld, RefusesMapsThatRound) {
  auto options = mixed_lattice_world<3>(1);
  for (const auto& map : {rotated<3>(0.1), scaled<3>(-1), scaled<3>(0), scaled<3>(1e308)}) {
    options.map = map;
    EXPECT_THROW(lattice_world(options), Error);
  }
  options.map = scaled<3>(0.1);
  options.map.origin = {1e15, 0, 0};  // neighbouring planes would fall together
  EXPECT_THROW(lattice_world(options), Error);
}

TEST(LatticeWorld, RefusesSharesThatMakeNoSense) {
  Lattice_world_options<3> options;
  options.membrane_share = 1.5;
  EXPECT_THROW(lattice_world(options), Error);
  options.membrane_share = 0;
  options.box_share = options.star_share = 0.6;
  EXPECT_THROW(lattice_world(options), Error);
  Lattice_world_options<2> plane;
  plane.prism_share = 0.5;
  EXPECT_THROW(lattice_world(plane), Error);
}

TEST(LatticeWorld, RemovedCellsPinchVertices) {
  // Two squares of a 2 x 2 lattice on the diagonal touch at one vertex; some seed leaves just them.
  Lattice_world_options<2> options;
  options.cells = {2, 2};
  options.removed_share = 0.5;
  bool found = false;
  for (options.seed = 1; options.seed < 200 && !found; ++options.seed) {
    const auto soup = lattice_world(options);
    found = soup.cell_count() == 2 && soup.points.size() == 7;
    if (found) {
      EXPECT_EQ(test::count_facets(soup).boundary, 8u);
    }
  }
  EXPECT_TRUE(found);
}

/// What a world has of slits: facets of the boundary that another one lies on, by pairs of half-facets of
/// which some open part is the same.
template <int D>
struct Slits {
  std::size_t duplicates = 0;       // vertices
  std::size_t cut = 0;              // slits of one facet, cut about a point inside
  std::size_t beside_passages = 0;  // cells on both sides of a slit that share a passable facet in its plane
};

template <int D>
Slits<D> slits_of(const Cell_soup<D>& whole, const Cell_soup<D>& soup) {
  Slits<D> slits;
  std::map<Point<D>, int> vertices, vertices_of_whole;
  for (const Point<D>& p : whole.points) ++vertices_of_whole[p];
  for (const Point<D>& p : soup.points) ++vertices[p];
  for (const auto& [p, n] : vertices)
    if (vertices_of_whole.contains(p))
      slits.duplicates += n > 1;
    else
      ++slits.cut;
  // Pairs of cells that were joined by a facet and are not any more, and still are by another one in the same
  // plane.
  const Gluing before = glue(whole), after = glue(soup);
  const auto cells = [](const Cell_soup<D>& s) {
    std::vector<std::uint32_t> cell_of;
    for (std::uint32_t c = 0; c < s.cell_count(); ++c)
      cell_of.insert(cell_of.end(), s.cell_begin[c + 1] - s.cell_begin[c], c);
    return cell_of;
  };
  const auto before_cells = cells(whole), after_cells = cells(soup);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> shared;
  for (std::uint32_t f = 0; f < whole.facet_count(); ++f)
    if (before.opposite[f] != no_facet) ++shared[{before_cells[f], before_cells[before.opposite[f]]}][0];
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f)
    if (after.opposite[f] != no_facet && !soup.impassable[f])
      ++shared[{after_cells[f], after_cells[after.opposite[f]]}][1];
  for (const auto& [pair, n] : shared) slits.beside_passages += n[1] > 0 && n[1] < n[0];
  return slits;
}

template <int D>
void expect_slits() {
  Slits<D> sum;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    auto options = mixed_lattice_world<D>(seed);
    if (D == 2) options.cells = Grid_options<D>::filled(7);
    if (seed % 3 == 0) options.map = rotated<D>();
    const auto whole = lattice_world(options);
    options.slit_share = D == 2 ? 0.2 : 0.08;
    const auto soup = lattice_world(options);
    test::expect_sound(soup);
    EXPECT_EQ(soup.cell_count(), whole.cell_count());
    EXPECT_EQ(test::volume(soup), test::volume(whole)) << "cells are what they were";
    EXPECT_GT(test::count_facets(soup).boundary, test::count_facets(whole).boundary);
    const auto slits = slits_of(whole, soup);
    sum.duplicates += slits.duplicates, sum.cut += slits.cut, sum.beside_passages += slits.beside_passages;
  }
  EXPECT_GT(sum.duplicates, 200u);
  EXPECT_GT(sum.cut, D == 2 ? 10u : 100u);
  EXPECT_GT(sum.beside_passages, 20u) << "a slit in the plane of a passable facet of the same cells";
}

TEST(LatticeWorld, SlitsPartCells2) { expect_slits<2>(); }
TEST(LatticeWorld, SlitsPartCells3) { expect_slits<3>(); }

/// Two rows of squares, parted along the first two of three edges between them.
TEST(LatticeWorld, ASlitDuplicatesTheVerticesInsideIt) {
  Lattice_world_options<2> options;
  options.cells = {3, 2};
  Cell_soup<2> soup = lattice_world(options);
  std::vector<std::uint8_t> is_slit(soup.facet_count());
  const auto mark = [&](std::size_t cell) { is_slit[soup.cell_begin[cell] + 2] = 1; };  // its upper side
  mark(1);
  Cell_soup<2> inner = soup;
  open_slits<2>(inner, is_slit);
  EXPECT_EQ(inner.points.size() - soup.points.size(), 1u) << "both ends lie in free space: one side is cut";
  EXPECT_EQ(inner.facet_count(), soup.facet_count() + 1);
  EXPECT_EQ(inner.points.back(), (Point<2>{1.5, 1}));
  mark(0);
  open_slits<2>(soup, is_slit);
  EXPECT_EQ(soup.points.size(), 12u + 2u) << "the one inside, and the one on the boundary";
  EXPECT_EQ(test::count_facets(soup).boundary, 10u + 4u);
}

TEST(LatticeWorld, IsReproducible) {
  EXPECT_EQ(test::hash(lattice_world(mixed_lattice_world<3>(42))), 8299020171311380009u);
  EXPECT_EQ(test::hash(lattice_world(mixed_lattice_world<2>(42))), 12166790843910174389u);
  EXPECT_NE(test::hash(lattice_world(mixed_lattice_world<2>(42))),
            test::hash(lattice_world(mixed_lattice_world<2>(43))));
}

}  // namespace
}  // namespace cellwalk
