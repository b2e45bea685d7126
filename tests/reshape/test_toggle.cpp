// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "reshape/toggle_cases.h"

namespace cellwalk {
namespace {

using test::body_at, test::expect_held, test::expect_sound, test::level_facets;

TEST(Toggle, ValveClosesOnAnEdge) {
  Environment<2> environment = test::simplex_grid<2>(2);
  Body<2> body = body_at<2>(environment, {{0.5, 0.5}, {0.5, 1.5}});
  const Half_facet f = level_facets<2>(environment, 1, {0, 0}).at(0);
  Reshaping<2> reshaping(environment, {{&body}, {}});
  const std::uint64_t epoch = environment.snapshot().epoch();
  expect_held<2>(reshaping.close(f), {{false, 0, Body_feature::edge, 0}});
  EXPECT_EQ(environment.snapshot().epoch(), epoch) << "nothing was changed";
  EXPECT_FALSE(environment.snapshot().is_impassable(f));
  reshaping.finish();
  expect_sound(environment, body);
}

TEST(Toggle, ValveClosesOnAnEdgeAtItsRim) {
  Environment<2> environment = test::simplex_grid<2>(2);
  Body<2> body = body_at<2>(environment, {{1, 0.5}, {1, 1.5}});
  Reshaping<2> reshaping(environment, {{&body}, {}});
  EXPECT_TRUE(reshaping.close(level_facets<2>(environment, 1, {0, 0}).at(0)).is_made);
  const Half_facet other = level_facets<2>(environment, 1, {1, 0}).at(0);
  expect_held<2>(reshaping.close(environment.snapshot().opposite(other)),
                 {{false, 0, Body_feature::edge, 0}});
  reshaping.finish();
  expect_sound(environment, body);
}

TEST(Toggle, VertexInTheFacetGoesToTheSideOfItsEdges) {
  Environment<2> environment = test::simplex_grid<2>(2);
  Body<2> body = body_at<2>(environment, {{0.5, 0.5}, {0.5, 1.5}});
  Body_counts counts;
  ASSERT_FALSE(body.move_vertex(0, {0.5, 1}, {}, counts));
  const Half_facet f = level_facets<2>(environment, 1, {0, 0}).at(0);
  const Snapshot<2>& snapshot = environment.snapshot();
  ASSERT_EQ(body.particles()[0].cell, snapshot.cell_of(f)) << "it came from below";
  Reshaping<2> reshaping(environment, {{&body}, {}});
  EXPECT_TRUE(reshaping.close(f).is_made);
  reshaping.finish();
  EXPECT_EQ(body.particles()[0].cell, snapshot.neighbour(f));
  expect_sound(environment, body);
  EXPECT_TRUE(body.move_vertex(0, {0.5, 0.5}, {}, counts)) << "there is a wall now";
}

TEST(Toggle, EdgeKeepsTheSideOfAMembraneBeside) {
  for (const bool is_above : {true, false}) {
    Environment<2> environment = test::simplex_grid<2>(4);
    const Snapshot<2>& snapshot = environment.snapshot();
    environment.set_impassable(level_facets<2>(environment, 2, {1, 0}).at(0), true);
    const double start = is_above ? 2.5 : 1.5;
    Body<2> body = body_at<2>(environment, {{0.5, start}, {3.5, start}});
    Body_counts counts;
    Step_report<2> report;
    body.step(std::vector<Point<2>>{{0.5, 2}, {3.5, 2}}, {}, report, counts);
    body.refresh(counts);
    ASSERT_TRUE(report.contacts.empty());
    // From the end of the membrane upwards: what is above the membrane is cut off from what is behind.
    Half_facet f = Half_facet::none;
    const std::uint32_t low = test::point_at<2>(environment, {2, 2}),
                        high = test::point_at<2>(environment, {2, 3});
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Half_facet g = Snapshot<2>::half_facet(snapshot.cell(i), k);
        if (snapshot.loop(g) == std::vector<std::uint32_t>{low, high}) f = g;
      }
    ASSERT_NE(f, Half_facet::none);
    {
      Reshaping<2> reshaping(environment, {{&body}, {}});
      const Outcome result = reshaping.close(f);
      EXPECT_EQ(result.is_made, !is_above);
      EXPECT_EQ(result.held_by.size(), is_above ? 1u : 0u) << "a chain below would be another one";
    }
    expect_sound(environment, body);
  }
}

TEST(Toggle, CellsOfAnyShape) {
  Environment<3> environment = Environment<3>::build(hex_grid({.cells = {3, 3, 3}}));
  Body<3> body = body_at<3>(environment, {{0.25, 1.5, 1.5}, {2.75, 1.5, 1.5}});
  const Snapshot<3>& snapshot = environment.snapshot();
  const Cell middle = Locator<3>(snapshot).particles_at({1.5, 1.5, 1.5}).at(0).cell;
  {
    Reshaping<3> reshaping(environment, {{&body}, {}});
    std::size_t held = 0;
    for (std::size_t k = 0; k < 6; ++k) held += !reshaping.close(Snapshot<3>::half_facet(middle, k)).is_made;
    EXPECT_EQ(held, 2u);
    expect_held<3>(reshaping.fill(middle), {{false, 0, Body_feature::edge, 0}});
  }
  expect_sound(environment, body);
  Environment<3> other = Environment<3>::build(hex_grid({.cells = {3, 3, 3}}));
  Body<3> beside = body_at<3>(other, {{0.25, 1, 1}, {2.75, 1, 1}});
  {
    Reshaping<3> reshaping(other, {{&beside}, {}});
    EXPECT_TRUE(reshaping.fill(other.snapshot().cell(13)).is_made)
        << "along an edge of the cell in the middle";
  }
  expect_sound(other, beside);
}

template <int D>
void fill_beside_a_particle() {
  Environment<D> environment = test::simplex_grid<D>(2);
  const Half_facet f = level_facets<D>(environment, 1, {0, 0}).at(0);
  const Snapshot<D>& snapshot = environment.snapshot();
  const Cell below = snapshot.cell_of(f), above = snapshot.neighbour(f);
  Point<D> x{};  // inside the facet
  for (const std::uint32_t v : snapshot.loop(f)) x = x + 0.25 * (snapshot.point(v) - Point<D>{});
  x = x + 0.25 * (D == 3 ? 1.0 : 2.0) * (snapshot.point(snapshot.loop(f)[0]) - Point<D>{});
  std::vector<Particle<D>> particles{{x, below, D - 1, 0}};
  Reshaping<D> reshaping(environment, {{}, {std::span(particles)}});
  EXPECT_TRUE(reshaping.fill(below).is_made);
  EXPECT_EQ(particles[0].cell, above);
  expect_held<D>(reshaping.fill(above), {{true, 0, Body_feature::vertex, 0}});
  EXPECT_TRUE(reshaping.fill(below).is_made) << "it is solid already";
  EXPECT_FALSE(reshaping.open(f).is_made) << "one of the cells is solid";
  EXPECT_TRUE(reshaping.excavate(below).is_made);
  EXPECT_FALSE(snapshot.is_impassable(f));
  EXPECT_TRUE(reshaping.close(f).is_made);
  EXPECT_EQ(particles[0].cell, above);
  expect_held<D>(reshaping.fill(above), {{true, 0, Body_feature::vertex, 0}});
  EXPECT_TRUE(reshaping.fill(below).is_made);
  reshaping.finish();
  EXPECT_NO_THROW(environment.certify());
}

TEST(Toggle, FilledBesideAParticle2D) { fill_beside_a_particle<2>(); }
TEST(Toggle, FilledBesideAParticle3D) { fill_beside_a_particle<3>(); }

TEST(Toggle, RegionsEndWhereAWallAppears) {
  Environment<2> environment = test::simplex_grid<2>(8);
  Body<2> body = body_at<2>(environment, {{3.5, 2.5}, {4.5, 2.5}});
  Body_counts counts;
  Step_report<2> report;
  const auto go = [&](double height) {
    body.step(std::vector<Point<2>>{{3.5, height}, {4.5, height}}, {}, report, counts);
  };
  for (const double height : {2.75, 3.0, 3.25, 3.5, 3.75}) go(height);
  EXPECT_GT(counts.in_region, 0u) << "no test at all so far";
  {
    Reshaping<2> reshaping(environment, {{&body}, {}});
    EXPECT_TRUE(reshaping.close(level_facets<2>(environment, 4, {4, 0}).at(0)).is_made);
  }
  go(4.5);
  EXPECT_FALSE(report.contacts.empty());
  expect_sound(environment, body);
}

TEST(Toggle, CertificatesAreThoseOfAnEnvironmentBuiltSo) {
  Environment<2> environment = test::simplex_grid<2>(4);
  const Snapshot<2>& snapshot = environment.snapshot();
  const Half_facet f = level_facets<2>(environment, 2, {1, 0}).at(0);
  const std::uint32_t v = test::point_at<2>(environment, {2, 2});
  Reshaping<2> reshaping(environment, {});
  ASSERT_EQ(reshaping.move(v, {2.25, 2.25}).end, Move_end::reached);
  EXPECT_TRUE(reshaping.close(f).is_made);
  EXPECT_TRUE(reshaping.fill(snapshot.cell(7)).is_made);
  ASSERT_EQ(reshaping.move(v, {2, 2}).end, Move_end::reached);
  EXPECT_TRUE(reshaping.open(f).is_made);
  EXPECT_TRUE(reshaping.excavate(snapshot.cell(7)).is_made);
  reshaping.finish();
  const Environment<2> built = test::simplex_grid<2>(4);
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    EXPECT_EQ(std::memcmp(snapshot.blocks(c), built.snapshot().blocks(c), sizeof *snapshot.blocks(c)), 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Half_facet g = Snapshot<2>::half_facet(c, k);
      EXPECT_EQ(snapshot.is_impassable(g), built.snapshot().is_impassable(g));
    }
  }
  EXPECT_NO_THROW(environment.certify());
}

TEST(Toggle, ChangesWithoutResidents) {
  Environment<3> environment = test::simplex_grid<3>(2);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Cell c = snapshot.cell(5), solid = snapshot.cell(6);
  const Certificate before = environment.certify();
  environment.fill(solid);
  environment.fill(c);
  EXPECT_TRUE(snapshot.is_solid(c));
  EXPECT_EQ(environment.certify().free_volume < before.free_volume, true);
  environment.excavate(c);
  for (std::size_t k = 0; k < 4; ++k) {
    const Half_facet f = Snapshot<3>::half_facet(c, k);
    const Cell other = snapshot.neighbour(f);
    EXPECT_EQ(snapshot.is_impassable(f), other == Cell::none || snapshot.is_solid(other));
  }
  environment.excavate(solid);
  EXPECT_EQ(environment.certify().free_volume, before.free_volume);
}

TEST(Toggle, WhatIsNotThereIsAnError) {
  Environment<2> environment = test::simplex_grid<2>(2);
  Body<2> body = body_at<2>(environment, {{0.5, 0.5}, {0.5, 1.5}});
  Body<2> forgotten = body;
  const Half_facet f = level_facets<2>(environment, 1, {1, 0}).at(0);
  Reshaping<2> reshaping(environment, {{&body}, {}});
  EXPECT_THROW(reshaping.open(Half_facet{12345}), Error);
  EXPECT_THROW(reshaping.close(Half_facet::none), Error);
  EXPECT_THROW(reshaping.fill(Cell{12345}), Error);
  EXPECT_THROW(reshaping.excavate(Cell::none), Error);
  const Outcome boundary = reshaping.open(level_facets<2>(environment, 2, {1, 0}).at(0));
  EXPECT_FALSE(boundary.is_made);
  EXPECT_TRUE(boundary.held_by.empty());
  EXPECT_TRUE(reshaping.close(f).is_made);
  reshaping.finish();
  EXPECT_NO_THROW(body.validate());
  EXPECT_THROW(forgotten.validate(), Error) << "it was not listed";
  EXPECT_THROW(reshaping.open(f), Error) << "after close()";
  environment.freeze();
  body = body_at<2>(environment, {{0.5, 0.5}, {0.5, 1.5}});
  Reshaping<2> frozen(environment, {{&body}, {}});
  EXPECT_THROW(frozen.open(f), Error);
  EXPECT_THROW(frozen.fill(environment.snapshot().cell(0)), Error);
}

/// An edge along a facet, in one cell at a time: once the cell is filled, it is in the one behind, and later
/// changes find it there.
template <int D>
void fill_behind_edges() {
  const Environment<D> pattern = test::simplex_grid<D>(2);
  int changed = 0;
  for (std::size_t i = 0; i < pattern.snapshot().cell_slots(); ++i)
    for (std::size_t k = 0; k <= D; ++k)
      for (std::size_t corner = 0; corner < D; ++corner) {
        Environment<D> environment = test::simplex_grid<D>(2);
        const Snapshot<D>& snapshot = environment.snapshot();
        const Cell cell = snapshot.cell(i);
        const Half_facet f = Snapshot<D>::half_facet(cell, k);
        if (snapshot.is_impassable(f)) continue;
        const auto loop = snapshot.loop(f);
        const Point<D>&a = snapshot.point(loop[corner]), &b = snapshot.point(loop[(corner + 1) % D]);
        const Point<D> inside = test::middle_of(snapshot, cell);
        Body<D> body = body_at<D>(environment, {inside, inside + 0.25 * (b - inside)});
        Body_counts counts;
        ASSERT_FALSE(body.move_vertex(0, a, {}, counts));
        ASSERT_FALSE(body.move_vertex(1, a + 0.5 * (b - a), {}, counts));
        ASSERT_EQ(body.particles()[0].cell, cell);
        ASSERT_TRUE(body.chain(0).empty());
        Reshaping<D> reshaping(environment, {{&body}, {}});
        ASSERT_TRUE(reshaping.fill(cell).is_made);
        const Cell now = body.particles()[0].cell;
        ASSERT_NE(now, cell);
        changed += body.chain(0).empty();
        ASSERT_TRUE(reshaping.insert_point(now, test::middle_of(snapshot, now)).is_made);
        reshaping.finish();
        expect_sound(environment, body);
      }
  EXPECT_GT(changed, 5);
}

TEST(Toggle, EdgesInOneCellAreFoundInTheNextInThePlane) { fill_behind_edges<2>(); }
TEST(Toggle, EdgesInOneCellAreFoundInTheNextInSpace) { fill_behind_edges<3>(); }

}  // namespace
}  // namespace cellwalk
