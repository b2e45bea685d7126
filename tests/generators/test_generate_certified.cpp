// SPDX-License-Identifier: LGPL-3.0-or-later
// Every generated world becomes an environment as it is: certified, nothing split, with the counts it should
// have.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/room.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/generators/lattice_world.h>

#include <gtest/gtest.h>

#include "environment/soup_checks.h"

namespace cellwalk {
namespace {

/// Builds an environment and checks that nothing had to be changed for it.
template <int D>
Certificate certificate_of(const Cell_soup<D>& soup,
                           Duplicate_vertices duplicates = Duplicate_vertices::refuse) {
  Build_options options;
  options.duplicates = duplicates;
  options.split = false;
  Build_report report;
  const auto environment = Environment<D>::build(soup, options, &report);
  EXPECT_EQ(environment.snapshot().cell_count(), soup.cell_count());
  EXPECT_EQ(report.unused_points, 0u);
  EXPECT_FALSE(report.flipped);
  EXPECT_NEAR(report.certificate.volume, test::volume(soup), 1e-9 * test::volume(soup));
  return report.certificate;
}

TEST(GeneratedEnvironment, GridsAreCertified) {
  for (const auto& map : {Lattice_map<3>{}, sheared<3>(), rotated<3>(0.25), scaled<3>(0.1)}) {
    Grid_options<3> options;
    options.cells = {7, 6, 5};
    options.solid_share = 0.1;
    options.map = map;
    const auto c = certificate_of(hex_grid(options));
    EXPECT_EQ(c.solid_cells, 21u);
    EXPECT_EQ(c.components, 1u);
    EXPECT_EQ(c.boundary_facets, 2u * (42 + 35 + 30));
    EXPECT_EQ(c.pinched_vertices, 0u);
    EXPECT_EQ(c.membranes, 0u);
  }
  Grid_options<2> squares;
  squares.solid_share = 0.1;
  squares.map = rotated<2>();
  EXPECT_EQ(certificate_of(square_grid(squares)).solid_cells, 10u);
}

TEST(GeneratedEnvironment, SimplexGridsAreCertified) {
  Simplex_grid_options<3> options;
  options.cells = {6, 6, 6};
  options.jitter = 0.15;
  const auto c = certificate_of(tetrahedral_grid(options));
  EXPECT_EQ(c.cells, 1296u);
  EXPECT_EQ(c.walls, c.boundary_facets);
  Simplex_grid_options<2> plane;
  plane.jitter = 0.15;
  EXPECT_EQ(certificate_of(triangle_grid(plane)).cells, 200u);
}

TEST(GeneratedEnvironment, LatticeWorldsAreCertified) {
  std::size_t membranes = 0, pinched = 0, components = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto options = mixed_lattice_world<3>(seed);
    options.map = seed % 3 == 0 ? rotated<3>() : seed % 3 == 1 ? scaled<3>(1e-6) : sheared<3>(1e6);
    const auto c = certificate_of(lattice_world(options));
    membranes += c.membranes, pinched += c.pinched_vertices, components += c.components;
    certificate_of(lattice_world(mixed_lattice_world<2>(seed)));
  }
  EXPECT_GT(membranes, 200u);
  EXPECT_GT(pinched, 5u);
  EXPECT_GT(components, 24u);
}

template <int D>
void expect_slits_are_certified() {
  std::size_t walls = 0, walls_of_whole = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    auto options = mixed_lattice_world<D>(seed);
    options.map = seed % 3 == 0 ? rotated<D>() : seed % 3 == 1 ? scaled<D>(1e-6) : sheared<D>(1e6);
    walls_of_whole += certificate_of(lattice_world(options)).walls;
    options.slit_share = 0.02 * static_cast<double>(1 + seed % 5);
    walls += certificate_of(lattice_world(options), Duplicate_vertices::keep).walls;
  }
  EXPECT_GT(walls, walls_of_whole + 80);
}

TEST(GeneratedEnvironment, SlitsAreCertified2) { expect_slits_are_certified<2>(); }
TEST(GeneratedEnvironment, SlitsAreCertified3) { expect_slits_are_certified<3>(); }

TEST(GeneratedEnvironment, VesselsAreCertified) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Vessel_options options;
    options.seed = seed;
    options.generations = 2;
    const auto c = certificate_of(branching_vessel(options));
    EXPECT_EQ(c.components, 1u);
    EXPECT_EQ(c.walls, c.boundary_facets);
    EXPECT_EQ(c.pinched_vertices, 0u);
    options.tissue = 0.5;
    const auto in_tissue = certificate_of(branching_vessel(options));
    EXPECT_EQ(in_tissue.cells - in_tissue.solid_cells, c.cells);
    EXPECT_EQ(in_tissue.walls - in_tissue.boundary_facets, c.walls);
    EXPECT_EQ(in_tissue.membranes, 0u);
    EXPECT_NEAR(in_tissue.free_volume, c.volume, 1e-6) << "cuts are rounded";
  }
  EXPECT_EQ(certificate_of(bulging_tube({})).components, 1u);
}

TEST(GeneratedEnvironment, RoomsAreCertified) {
  for (bool keep : {false, true}) {
    Room_options options;
    options.keep_obstacles = keep;
    const auto c = certificate_of(room_2d(options));
    EXPECT_EQ(c.components, 1u);
    EXPECT_GT(c.membranes, 30u);
    EXPECT_EQ(c.solid_cells > 0, keep);
  }
}

}  // namespace
}  // namespace cellwalk
