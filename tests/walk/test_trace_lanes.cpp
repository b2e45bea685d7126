// SPDX-License-Identifier: LGPL-3.0-or-later
// The lengths that lanes compute, by the arithmetic of each kind of processor, against those that are rounded
// exactly; and that an error bound that is too small for the question leaves it open.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/walk/trace.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "walk/lane_measures.h"
#include "walk/trace/block_walk.h"
#include "walk/trace/lane_kinds.h"
#include "walk/trace/lane_planes.h"

namespace cellwalk {
namespace {

class TraceLanes : public testing::Test {
 protected:
  TraceLanes() : snapshot_(make_snapshot()), locator_(snapshot_), planes_(detail::lane_planes(snapshot_)) {}

  static Snapshot<3> make_snapshot() {
    Simplex_grid_options<3> options;
    options.cells = Grid_options<3>::filled(6);
    options.jitter = 0.12;
    const Cell_soup<3> soup = tetrahedral_grid(options);
    return Snapshot<3>::compile(soup, glue(soup));
  }

  Point<3> any_point() {
    Point<3> p;
    for (double& x : p) x = random_.real(0.5, 5.5);
    return p;
  }

  Random random_{3};
  const Snapshot<3> snapshot_;
  const Locator<3> locator_;
  const detail::Lane_planes planes_;
};

TEST_F(TraceLanes, AreRoundedToNearestByEveryKindOfProcessor) {
  const double error = detail::lane_error * planes_.size;
  std::size_t motions = 0, pieces = 0;
  while (motions < 2000) {
    const auto particle = locator_.particle_at(any_point());
    const Point<3> to = any_point();
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    std::vector<Cell_exit> exits;
    Walk_counts counts;
    Walk_options options{&visited, &crossed};
    options.exits = &exits;
    if (walk(snapshot_, *particle, to, counts, options).contact) continue;
    const std::vector<double> exact =
        lengths_of_pieces(snapshot_, particle->position, to, exits, visited.size());
    std::vector<unsigned> met;
    for (const Half_facet f : crossed) met.push_back(to_index(f));
    for (const detail::Lane_kind& kind : detail::lane_kinds()) {
      const Measured measured(particle->position, to, planes_, met, error, kind.functions);
      ASSERT_TRUE(measured.is_certain) << kind.name;
      ASSERT_EQ(measured.length, exact) << kind.name;
    }
    ++motions;
    pieces += exact.size();
  }
  EXPECT_GT(pieces, 10 * motions);
}

TEST_F(TraceLanes, AreRoundedToNearestIfTheyRunAlmostAlongAFacet) {
  const double error = detail::lane_error * planes_.size;
  for (const double slope : {0x1p-20, 0x1p-28, 0x1p-30}) {
    std::size_t certain = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const Cell cell = snapshot_.cell(random_.below(snapshot_.cell_count()));
      const Half_facet facet = Snapshot<3>::half_facet(cell, random_.below(4));
      const auto loop = snapshot_.loop(facet);
      Point<3> middle{};
      for (const std::uint32_t p : loop) middle = middle + (1.0 / 3) * snapshot_.point(p);
      const Vector<3> off = detail::inner_normal(snapshot_.view(cell), snapshot_.facet_of(facet));
      const auto near = [&](const Point<3>& corner, double distance) {
        return corner + random_.real(0, 0.2) * (middle - corner) + distance * off;
      };
      const Point<3> from = near(snapshot_.point(loop[0]), random_.real(0.5, 1) * slope),
                     to = near(snapshot_.point(loop[1]), random_.real(-1, -0.5) * slope);
      const std::vector<Cell_exit> exits{{facet}};
      const std::vector<double> exact = lengths_of_pieces(snapshot_, from, to, exits, 2);
      for (const detail::Lane_kind& kind : detail::lane_kinds()) {
        const Measured measured(from, to, planes_, {to_index(facet)}, error, kind.functions);
        certain += measured.is_certain;
        if (measured.is_certain) {
          ASSERT_EQ(measured.length, exact) << kind.name << ", " << slope;
        }
      }
    }
    EXPECT_GT(certain, 200 * detail::lane_kinds().size()) << slope;
  }
}

TEST_F(TraceLanes, WalkAsExactWalksIfPlanesDecide) {
  std::vector<Particle<3>> particles;
  std::vector<Point<3>> targets;
  while (particles.size() < detail::rows_of_block) {
    const bool is_at_vertex = particles.size() % 4 == 0, leaves = particles.size() % 2 == 0;
    const std::size_t corner = random_.below(snapshot_.points().size());
    particles.push_back(
        locator_.particle_at(is_at_vertex ? snapshot_.point(static_cast<std::uint32_t>(corner)) : any_point())
            .value());
    targets.push_back(leaves ? 3.0 * any_point() - Vector<3>{6, 6, 6} : any_point());
    if (particles.size() % 8 != 1) continue;  // some through the inside of the cell of a vertex
    const Point<3> from = particles.back().position;
    Vector<3> inwards{};
    for (const std::uint32_t p : snapshot_.view(particles.back().cell).vertices)
      inwards = inwards + (snapshot_.point(p) - from);
    targets.back() = from + inwards;
  }
  for (const detail::Lane_kind& kind : detail::lane_kinds()) {
    detail::Block_walk<3> walks(snapshot_, planes_, kind.functions);
    walks.run(particles, targets);
    std::size_t arrived = 0, blocked = 0, from_vertices = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const detail::Lane_row& row = walks.row(i);
      if (row.verdict == detail::Lane_verdict::undecided) continue;
      std::vector<Half_facet> crossed;
      Walk_counts counts;
      const Walk_result<3> result = walk(snapshot_, particles[i], targets[i], counts, {nullptr, &crossed});
      if (result.contact) crossed.push_back(result.contact->facet);
      ASSERT_EQ(row.verdict == detail::Lane_verdict::blocked, result.contact.has_value()) << kind.name;
      ASSERT_EQ(row.cell, to_index(result.cell)) << kind.name;
      ASSERT_EQ(walks.count_of_met(row), crossed.size()) << kind.name;
      for (std::size_t k = 0; k < crossed.size(); ++k)
        ASSERT_EQ(walks.met(row)[k * detail::lane_slots], to_index(crossed[k]));
      ++(result.contact ? blocked : arrived);
      from_vertices += particles[i].dimension == 0;
    }
    EXPECT_GT(arrived, 100u) << kind.name;
    EXPECT_GT(blocked, 40u) << kind.name;
    EXPECT_GT(from_vertices, 10u) << kind.name;
  }
}

TEST_F(TraceLanes, LeaveLengthsOpenThatTheirErrorsDoNotRound) {
  const auto particle = locator_.particle_at({1.03, 1.02, 1.01});
  const Point<3> to{5.1, 4.9, 4.2};
  std::vector<Half_facet> crossed;
  Walk_counts counts;
  ASSERT_EQ(walk(snapshot_, *particle, to, counts, {nullptr, &crossed}).status, Walk_status::arrived);
  std::vector<unsigned> met;
  for (const Half_facet f : crossed) met.push_back(to_index(f));
  ASSERT_GT(met.size(), 8u);
  detail::Lane_planes unknown = planes_;
  unknown.planes[met[5]] = {};
  const double error = detail::lane_error * planes_.size;
  for (const detail::Lane_kind& kind : detail::lane_kinds()) {
    EXPECT_TRUE(Measured(particle->position, to, planes_, met, error, kind.functions).is_certain);
    EXPECT_FALSE(Measured(particle->position, to, planes_, met, 0x1p-50, kind.functions).is_certain)
        << kind.name;
    EXPECT_FALSE(Measured(particle->position, to, unknown, met, error, kind.functions).is_certain)
        << kind.name;
    EXPECT_FALSE(Measured(to, to, planes_, {}, error, kind.functions).is_certain) << kind.name;
    std::vector<unsigned> swapped = met;
    std::swap(swapped[3], swapped[4]);  // a piece of negative length
    EXPECT_FALSE(Measured(particle->position, to, planes_, swapped, error, kind.functions).is_certain)
        << kind.name;
  }
}

/// A tetrahedron at the origin with a needle for its third facet, moved and scaled.
Snapshot<3> needle(double height, double scale, double offset) {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {2, height, 0}, {1, 1, 1}};
  for (Point<3>& p : soup.points)
    for (double& x : p) x = scale * (x + offset);
  for (const auto& facet :
       std::vector<std::vector<std::uint32_t>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    soup.add_facet(facet);
  soup.end_cell();
  return Snapshot<3>::compile(soup, glue(soup));
}

std::size_t known_planes(const detail::Lane_planes& planes) {
  return static_cast<std::size_t>(
      std::count_if(planes.planes.begin(), planes.planes.end(), [](const auto& plane) {
        return std::any_of(plane.high, plane.high + 3, [](double x) { return x != 0; });
      }));
}

TEST(LanePlanes, AreUnknownIfEachCornerIsThin) {
  EXPECT_EQ(known_planes(detail::lane_planes(needle(1, 1, 0))), 4u);
  EXPECT_EQ(known_planes(detail::lane_planes(needle(0x1p-4, 1, 0))), 4u);
  for (const double height : {0x1p-8, 0x1p-20})
    EXPECT_EQ(known_planes(detail::lane_planes(needle(height, 1, 0))), 3u) << height;
}

TEST(LanePlanes, AreUnknownIfTermsOverflowOrUnderflow) {
  for (const int power : {-100, 100})
    EXPECT_EQ(known_planes(detail::lane_planes(needle(1, std::ldexp(1, power), 0))), 4u);
  for (const int power : {-1000, -160, 160, 1000})
    EXPECT_EQ(known_planes(detail::lane_planes(needle(1, std::ldexp(1, power), 0))), 0u) << power;
  // Facets of usual sizes, far from the origin.
  EXPECT_EQ(known_planes(detail::lane_planes(needle(1, 0x1p120, 0x1p40))), 0u);
}

TEST(LanePlanes, SizeBoundsCoordinates) {
  for (const double offset : {0.0, 0x1p20, -0x1p40}) {
    const Snapshot<3> snapshot = needle(1, 1, offset);
    const double size = detail::lane_planes(snapshot).size;
    for (const Point<3>& p : snapshot.points())
      for (const double x : p) EXPECT_GE(size, std::abs(x));
  }
}

}  // namespace
}  // namespace cellwalk
