// SPDX-License-Identifier: LGPL-3.0-or-later
// Single moves of walls among particles and bodies, by hand: a membrane at height 2 of a grid of unit cubes.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "reshape/dimensions.h"
#include "reshape/grids.h"

namespace cellwalk {
namespace {

using test::hold;

using test::add_membrane;
using test::point_at;
using test::simplex_grid;

/// A grid with a membrane, whose middle vertex is at (2, 2, 2).
struct Room {
  explicit Room(const Build_options& options = {}) : environment(simplex_grid<3>(4, options)) {
    if (!environment.is_frozen()) add_membrane<3>(environment, 2);
    vertex = point_at<3>(environment, {2, 2, 2});
  }
  const Snapshot<3>& snapshot() const { return environment.snapshot(); }
  Particle<3> particle_at(const Point<3>& x, double side) const {
    for (const Particle<3>& p : Locator<3>(snapshot()).particles_at(x)) {
      const Cell_view<3> cell = snapshot().view(p.cell);
      for (std::size_t k = 0; k < 4; ++k)
        if ((cell.point(k)[2] - 2) * side > 0) return p;
    }
    throw Error(Error_code::outside, "no particle");
  }
  Body<3> body(const std::vector<Point<3>>& points, std::vector<std::array<std::uint32_t, 2>> edges,
               std::vector<std::array<std::uint32_t, 3>> faces = {}) const {
    return Body<3>(snapshot(), Locator<3>(snapshot()), {points, std::move(edges), std::move(faces)});
  }

  Environment<3> environment;
  std::uint32_t vertex = 0;
};

TEST(Reshaping, AWallMeetsAParticleAtAnExactTime) {
  Room room;
  // There the membrane rises three quarters as high as its vertex.
  std::vector<Particle<3>> particles{room.particle_at({2.25, 2.125, 2.25}, 1)};
  Reshaping<3> reshaping(room.environment, {{}, {particles}}, hold);
  const auto result = reshaping.move(room.vertex, {2, 2, 2.5});
  EXPECT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(result.position, (Point<3>{2, 2, 2}));
  ASSERT_TRUE(result.hit.has_value());
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(2), Ring(3)));
  EXPECT_EQ(result.hit->kind, Contact_kind::facet);
  EXPECT_EQ(result.hit->point, (Point<3>{2.25, 2.125, 2.25}));
  EXPECT_TRUE(result.hit->resident.is_particle);
  EXPECT_EQ(result.hit->resident.number, 0u);
  EXPECT_NEAR(result.hit->weights[0], 0.75, 1e-15);
  EXPECT_NEAR(result.hit->weights[0] + result.hit->weights[1] + result.hit->weights[2], 1, 1e-15);
  EXPECT_GT(result.hit->normal[2], 0.9) << "from the wall to the particle";
  EXPECT_NEAR(length(result.hit->normal), 1, 1e-12);
  // The facet is that above the membrane.
  const Snapshot<3>& snapshot = room.snapshot();
  EXPECT_TRUE(snapshot.is_impassable(result.hit->facet));
  double top = 0;
  for (const std::uint32_t v : snapshot.view(snapshot.cell_of(result.hit->facet)).vertices)
    top = std::max(top, snapshot.point(v)[2]);
  EXPECT_EQ(top, 3);
  // As far as that it may go, not to it.
  EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(reshaping.counts().hits, 1u);
}

TEST(Reshaping, AWallStopsJustBefore) {
  Room room;
  std::vector<Particle<3>> particles{room.particle_at({2.25, 2.125, 2.25}, 1)};
  Reshaping<3> reshaping(room.environment, {{}, {particles}});
  const auto result = reshaping.move(room.vertex, {2, 2, 2.5});
  EXPECT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(result.position, room.snapshot().point(room.vertex));
  EXPECT_NEAR(result.position[2], 2 + 1.0 / 3, 1e-12);
  EXPECT_LT(result.position[2], 2 + 1.0 / 3);
  const auto again = reshaping.move(room.vertex, {2, 2, 2.5});
  EXPECT_EQ(again.end, Move_end::contact);
  EXPECT_NEAR(again.position[2], 2 + 1.0 / 3, 1e-12);
  reshaping.finish();
  EXPECT_TRUE(in_closure(room.snapshot(), particles[0].cell, particles[0].position));
  EXPECT_NO_THROW(room.environment.certify());
}

TEST(Reshaping, AParticleInAWallStaysOnItsSide) {
  for (const double side : {1.0, -1.0}) {
    Room room;
    const Point<3> x{2.25, 2.125, 2};
    std::vector<Particle<3>> particles{room.particle_at(x, side)};
    Reshaping<3> reshaping(room.environment, {{}, {particles}}, hold);
    EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2 - 0.125 * side}).end, Move_end::reached) << "it leaves";
    EXPECT_EQ(particles[0].dimension, 3);
    EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2}).end, Move_end::reached) << "it comes back";
    EXPECT_EQ(particles[0].dimension, 2);
    const auto through = reshaping.move(room.vertex, {2, 2, 2 + 0.125 * side});
    ASSERT_EQ(through.end, Move_end::contact) << "the particle lies in a facet of the swept tetrahedron";
    EXPECT_EQ(through.hit->exact_time(), Exact_time());
    EXPECT_EQ(through.hit->kind, Contact_kind::facet);
    EXPECT_EQ(reshaping.move(room.vertex, {2.125, 2, 2}).end, Move_end::reached)
        << "in its own plane, while the particle stays in its cell";
    EXPECT_EQ(particles[0].position, x);
    // On the other side, nothing of it was lost: it can leave on its own side only.
    reshaping.finish();
    Walk_counts counts;
    Particle<3> moved = particles[0];
    EXPECT_EQ(move(room.snapshot(), moved, {2.25, 2.125, 2 - 0.5 * side}, counts).status,
              Walk_status::contact);
    EXPECT_EQ(move(room.snapshot(), moved, {2.25, 2.125, 2 + 0.5 * side}, counts).status,
              Walk_status::arrived);
  }
}

TEST(Reshaping, AWallLeavesAtOnceWhatLiesInIt) {
  Room room;
  // Neither stays in its cell.
  std::vector<Particle<3>> particles{room.particle_at({2.25, 2.125, 2}, 1)};
  Body<3> above = room.body({{2.125, 2.25, 2}, {2.25, 2.5, 2}, {2.125, 2.25, 2.5}}, {{0, 1}, {0, 2}});
  Reshaping<3> reshaping(room.environment, {{&above}, {particles}}, hold);
  EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 1.25}).end, Move_end::reached);
  EXPECT_GT(reshaping.counts().left, 2u);
  EXPECT_EQ(reshaping.counts().touches, 0u);
  EXPECT_EQ(particles[0].dimension, 3);
  reshaping.finish();
  EXPECT_NO_THROW(above.validate());

  // From below it is met.
  Room other;
  std::vector<Particle<3>> below{other.particle_at({2.25, 2.125, 2}, -1)};
  Reshaping<3> blocked(other.environment, {{}, {below}}, hold);
  EXPECT_EQ(blocked.move(other.vertex, {2, 2, 1.25}).end, Move_end::contact);
}

TEST(Reshaping, AVertexMeetsAParticleExactly) {
  Room room;
  std::vector<Particle<3>> particles{room.particle_at({2, 2, 2.25}, 1)};
  Reshaping<3> reshaping(room.environment, {{}, {particles}}, hold);
  const auto result = reshaping.move(room.vertex, {2, 2, 2.5});
  ASSERT_EQ(result.end, Move_end::contact) << "the vertex would go through the particle";
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(1), Ring(2)));
  EXPECT_EQ(result.hit->kind, Contact_kind::vertex);
  EXPECT_EQ(result.hit->weights, (std::array{1.0, 0.0, 0.0}));
  EXPECT_EQ(result.hit->point, (Point<3>{2, 2, 2.25}));
  EXPECT_EQ(reshaping.counts().touches, 0u);
  EXPECT_EQ(reshaping.counts().followed, 1u);
}

TEST(Reshaping, AVertexStopsInThePlaceOfAParticle) {
  Room room;
  std::vector<Particle<3>> particles{room.particle_at({2, 2, 2.25}, 1)};
  Reshaping<3> reshaping(room.environment, {{}, {particles}});
  const auto result = reshaping.move(room.vertex, {2, 2, 2.5});
  EXPECT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(result.position, (Point<3>{2, 2, 2.25}))
      << "in the place of the particle, which stays in its cell";
}

TEST(Reshaping, AnEdgeIsMetByAnEdge) {
  Room room;
  Body<3> body = room.body({{2.5, 1.5, 2.125}, {2.5, 2.25, 2.3125}}, {{0, 1}});
  Reshaping<3> reshaping(room.environment, {{&body}, {}}, hold);
  const auto result = reshaping.move(room.vertex, {2, 2, 2.75});
  ASSERT_EQ(result.end, Move_end::contact);
  // The edge from the vertex to (3, 2, 2) passes below it, half as high as the vertex.
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(2), Ring(3)));
  EXPECT_EQ(result.hit->kind, Contact_kind::edge);
  EXPECT_EQ(result.hit->resident.feature, Body_feature::edge);
  EXPECT_FALSE(result.hit->resident.is_particle);
  EXPECT_EQ(result.hit->point, (Point<3>{2.5, 2, 2.25}));
  EXPECT_GT(result.hit->normal[2], 0.5);
  EXPECT_NEAR(dot(result.hit->normal, Vector<3>{0, 0.75, 0.1875}), 0, 1e-12) << "perpendicular to both";
  EXPECT_NEAR(dot(result.hit->normal, Vector<3>{1, 0, -0.5}), 0, 1e-12);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
}

TEST(Reshaping, AFaceIsMetByTheVertexThatMoves) {
  Room room;
  Body<3> body = room.body({{1.25, 1.125, 2.25}, {3.5, 1.25, 2.25}, {1.125, 3.5, 2.25}},
                           {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}});
  Reshaping<3> reshaping(room.environment, {{&body}, {}}, hold);
  const auto result = reshaping.move(room.vertex, {2, 2, 2.5});
  ASSERT_EQ(result.end, Move_end::contact);
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(1), Ring(2)));
  EXPECT_EQ(result.hit->kind, Contact_kind::vertex);
  EXPECT_EQ(result.hit->resident.feature, Body_feature::face);
  EXPECT_EQ(result.hit->normal, (Vector<3>{0, 0, 1}));
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
}

TEST(Reshaping, EdgesOfNoLengthGoOn) {
  for (const Point<3>& x : {Point<3>{2, 2, 3}, {2.25, 2.25, 2.75}, {2.5, 2, 2.5}, {2.25, 2.125, 2.25}}) {
    Room room;
    Body<3> body = room.body({x, x, {2.5, 2.25, 3.5}}, {{0, 1}, {1, 2}});
    {
      Reshaping<3> reshaping(room.environment, {{&body}, {}}, hold);
      const std::uint32_t inner = point_at<3>(room.environment, {2, 2, 3});
      for (const Point<3>& target : {Point<3>{2.25, 2.125, 3}, {1.75, 2, 2.75}, {2, 2, 3}, {2, 2.25, 3.25}})
        EXPECT_EQ(reshaping.move(inner, target).end, Move_end::reached) << "no wall is at it";
    }
    EXPECT_NO_THROW(body.validate());
  }
}

TEST(Reshaping, BodiesThatAreNotListedGoOnNoMore) {
  Room room;
  Body<3> listed = room.body({{1, 1, 3}, {1.5, 1, 3}}, {{0, 1}}), other = listed;
  {
    Reshaping<3> reshaping(room.environment, {{&listed}, {}});
    EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2.25}).end, Move_end::reached);
    EXPECT_THROW(listed.validate(), Error) << "not before it is closed";
  }
  EXPECT_NO_THROW(listed.validate());
  EXPECT_THROW(other.validate(), Error);
  Body_counts counts;
  EXPECT_THROW(other.move_vertex(0, {1, 1, 3.25}, {}, counts), Error);
  EXPECT_FALSE(listed.move_vertex(0, {1, 1, 3.25}, {}, counts).has_value());
  EXPECT_THROW(Reshaping<3>(room.environment, {{&other}, {}}), Error)
      << "it has to be registered again first";
  other.register_again(Locator<3>(room.snapshot()));
  EXPECT_NO_THROW(Reshaping<3>(room.environment, {{&other}, {}}));
}

TEST(Reshaping, AWallThatEntersARegionIsMet) {
  Room room;
  // It lies above all cells around the vertex.
  Body<3> body = room.body({{2.0625, 2.03125, 3.125}, {2.5, 2.25, 3.125}}, {{0, 1}});
  Body_counts counts;
  Step_report<3> report;
  // Small steps, so that a region about the body is free of walls, down to the membrane.
  std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
  for (int i = 0; i < 8; ++i) {
    for (Point<3>& x : targets) x[2] -= 1.0 / 128;
    body.step(targets, {}, report, counts);
  }
  ASSERT_GT(counts.regions, 0u);
  ASSERT_GT(counts.in_region, 0u);
  {
    Reshaping<3> reshaping(room.environment, {{&body}, {}}, hold);
    EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2.96875}).end, Move_end::reached);
    EXPECT_EQ(reshaping.counts().opened, 1u) << "for its region";
  }
  for (Point<3>& x : targets) x[2] = 2.8125;
  body.step(targets, {}, report, counts);
  EXPECT_FALSE(report.contacts.empty()) << "the membrane is higher there";
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

TEST(Reshaping, WhatIsFarAwayKeepsItsRegion) {
  Room room;
  Body<3> body = room.body({{0.5, 0.25, 0.5}, {0.75, 0.25, 0.5}}, {{0, 1}});
  Reshaping<3> reshaping(room.environment, {{&body}, {}});
  EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(reshaping.counts().opened, 0u);
}

TEST(Reshaping, FrozenEnvironmentsMove) {
  Room room({.keep_map = false});
  std::vector<Particle<3>> particles{room.particle_at({2.25, 2.125, 2.25}, 1)};
  const Cell before = particles[0].cell;
  {
    Reshaping<3> reshaping(room.environment, {{}, {particles}});
    EXPECT_EQ(reshaping.move(room.vertex, {2.5, 2.25, 2.5}).end, Move_end::reached) << "no wall there";
  }
  EXPECT_NE(particles[0].cell, before);
  EXPECT_TRUE(in_closure(room.snapshot(), particles[0].cell, particles[0].position));
  EXPECT_NO_THROW(room.environment.certify());
}

TEST(Reshaping, CellsAndTheBoundaryForbidMoves) {
  Room room;
  Reshaping<3> reshaping(room.environment, {});
  const auto flat = reshaping.move(room.vertex, {2, 2, 4});
  EXPECT_EQ(flat.end, Move_end::cell);
  EXPECT_EQ(flat.share, 0.5);
  EXPECT_NE(flat.cell, Cell::none);
  EXPECT_EQ(flat.position, (Point<3>{2, 2, 2}));
  EXPECT_EQ(reshaping.move(room.vertex, {2, 2, 2}).end, Move_end::reached) << "where it is";
  EXPECT_EQ(reshaping.counts().made, 0u);
}

TEST(Reshaping, ErrorsChangeNothing) {
  Room room;
  std::vector<Particle<3>> particles{room.particle_at({2.25, 2.125, 2.25}, 1)};
  Reshaping<3> reshaping(room.environment, {{}, {particles}});
  EXPECT_THROW(reshaping.move(999, {2, 2, 2}), Error);
  EXPECT_THROW(reshaping.move(room.vertex, {2, 2, std::nan("")}), Error);
  particles[0].position[2] = 2.9;
  particles[0].position[0] = 0.1;
  EXPECT_THROW(reshaping.move(room.vertex, {2, 2, 2.125}), Error) << "not in its cell";
  EXPECT_EQ(room.snapshot().point(room.vertex), (Point<3>{2, 2, 2}));
  reshaping.finish();
  EXPECT_THROW(reshaping.move(room.vertex, {2, 2, 2.125}), Error);

  Room other;
  Body<3> body = other.body({{1, 1, 3}}, {});
  EXPECT_THROW(Reshaping<3>(room.environment, {{&body}, {}}), Error);

  Environment<3> hexes = Environment<3>::build(hex_grid({.cells = {2, 2, 2}}));
  Reshaping<3> of_hexes(hexes, {});
  EXPECT_THROW(of_hexes.move(13, {1.125, 1, 1}), Error);
  Environment<3> simplices = Environment<3>::build(hex_grid({.cells = {2, 2, 2}}), {.simplicial = true});
  EXPECT_EQ(Reshaping<3>(simplices, {}).move(13, {1.125, 1, 1}).end, Move_end::reached);
}

TEST(Reshaping, TheSameInThePlane) {
  Environment<2> environment = simplex_grid<2>(4);
  add_membrane<2>(environment, 2);
  const std::uint32_t vertex = point_at<2>(environment, {2, 2});
  const Locator<2> locator(environment.snapshot());
  Body<2> body(environment.snapshot(), locator, {{{1.25, 2.5}, {2.5, 2.25}}, {{0, 1}}, {}});
  std::vector<Particle<2>> particles = locator.particles_at({2.5, 2.25});
  Reshaping<2> reshaping(environment, {{&body}, {particles}}, hold);
  const auto result = reshaping.move(vertex, {2, 2.75});
  ASSERT_EQ(result.end, Move_end::contact);
  // The edge is at 2.35 above the vertex, its end at the place of the particle.
  EXPECT_EQ(to_fraction(result.hit->exact_time()), Fraction(Ring(7), Ring(15)));
  EXPECT_EQ(result.hit->kind, Contact_kind::vertex);
  EXPECT_EQ(result.hit->resident.feature, Body_feature::edge);
  EXPECT_EQ(reshaping.move(vertex, {2, 2.25}).end, Move_end::reached);
  EXPECT_EQ(reshaping.move(vertex, {2, 1.5}).end, Move_end::reached);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
}

}  // namespace
}  // namespace cellwalk
