// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies in an environment that is edited: none goes on as if nothing had happened.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk {
namespace {

template <int D>
Cell_soup<D> simplex_grid(std::uint32_t cells) {
  Simplex_grid_options<D> grid;
  grid.cells.fill(cells);
  if constexpr (D == 2)
    return triangle_grid(grid);
  else
    return tetrahedral_grid(grid);
}

template <int D>
Body_soup<D> simplex_body() {
  Body_soup<D> soup;
  Point<D> corner;
  for (int i = 0; i < D; ++i) corner[i] = 0.5 + 0.125 * i;
  soup.points.push_back(corner);
  for (int i = 0; i < D; ++i) {
    soup.points.push_back(corner);
    soup.points.back()[i] += 0.25;
  }
  for (std::uint32_t u = 0; u <= D; ++u)
    for (std::uint32_t v = u + 1; v <= D; ++v) soup.edges.push_back({u, v});
  if (D == 3) soup.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  return soup;
}

/// A facet between two cells that can be opened and closed.
template <int D>
Half_facet inner_facet(const Snapshot<D>& snapshot) {
  for (std::size_t k = 0;; ++k) {
    const Half_facet f = snapshot.half_facet(snapshot.cell(snapshot.cell_count() - 1), k);
    if (snapshot.neighbour(f) != Cell::none) return f;
  }
}

template <int D>
std::uint32_t point_at(const Snapshot<D>& snapshot, const Point<D>& place) {
  std::uint32_t p = 0;
  while (snapshot.point(p) != place) ++p;
  return p;
}

/// A point inside the grid, not of the first cells.
template <int D>
std::uint32_t inner_point(const Snapshot<D>& snapshot) {
  Point<D> place;
  place.fill(2);
  return point_at(snapshot, place);
}

template <int D>
Point<D> mean(const Cell_view<D>& cell) {
  Point<D> sum{};
  for (std::size_t i = 0; i < cell.vertex_count(); ++i) sum = sum + cell.point(i);
  return 1.0 / static_cast<double>(cell.vertex_count()) * sum;
}

template <class F>
std::string usage_error(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::usage) << error.what();
    return error.what();
  }
  return {};
}

template <int D>
void expect_edits_noticed() {
  Environment<D> environment = Environment<D>::build(simplex_grid<D>(4));
  const Snapshot<D>& snapshot = environment.snapshot();
  const Half_facet facet = inner_facet(snapshot);
  const std::uint32_t point = inner_point(snapshot);
  const std::vector<std::function<void()>> edits{
      [&] { environment.set_impassable(facet, true); },
      [&] {
        Point<D> place = snapshot.point(point);
        place[0] += 0.125;
        environment.move_vertex(point, place);
      },
      [&] {
        const Cell c = snapshot.cell(0);
        environment.insert_point(c, mean(snapshot.view(c)));
      },
  };
  const std::vector<std::function<void()>> no_edits{
      [&] { environment.set_impassable(facet, snapshot.is_impassable(facet)); },
      [&] { environment.move_vertex(point, snapshot.point(point)); },
      [&] {
        Point<D> far_off;
        far_off.fill(50);
        EXPECT_THROW(environment.move_vertex(point, far_off), Error);
        EXPECT_THROW(environment.insert_point(snapshot.cell(0), far_off), Error);
      },
  };
  for (std::size_t e = 0; e < edits.size(); ++e)
    for (const bool has_region : {false, true}) {
      SCOPED_TRACE(e);
      const Locator<D> before(snapshot);
      Body<D> body(snapshot, before, simplex_body<D>());
      Body_counts counts;
      Step_report<D> report;
      Body_options options, at_target;
      at_target.rule = Step_rule::reject_at_target;
      options.clearance = has_region;
      std::vector<Point<D>> targets(body.positions().begin(), body.positions().end());
      for (Point<D>& x : targets) x[0] += 0x1p-6;
      body.step(targets, options, report, counts);
      EXPECT_EQ(counts.in_region > 0, has_region);
      for (const auto& edit : no_edits) edit();
      EXPECT_NO_THROW(body.step(targets, options, report, counts));

      edits[e]();
      const std::vector<Point<D>> stood(body.positions().begin(), body.positions().end());
      const std::uint64_t moves = counts.moves;
      const std::vector<std::function<void()>> uses{
          [&] { body.step(targets, options, report, counts); },
          [&] { body.step(targets, at_target, report, counts); },
          [&] { body.move_vertex(0, targets[0], options, counts); },
          [&] { body.refresh(counts); },
          [&] { body.leave_region(counts); },
          [&] { body.validate(); },
      };
      for (std::size_t u = 0; u < uses.size(); ++u)
        EXPECT_NE(usage_error(uses[u]).find("register_again"), std::string::npos) << "use " << u;
      EXPECT_EQ(counts.moves, moves);
      EXPECT_TRUE(report.contacts.empty());
      // Opening and closing leaves locators right; what moves cells does not.
      if (e == 0)
        EXPECT_NO_THROW(before.locate(stood[0]));
      else
        EXPECT_NE(usage_error([&] { body.register_again(before); }).find("Locator"), std::string::npos);

      body.register_again(Locator<D>(snapshot));
      EXPECT_EQ(std::vector<Point<D>>(body.positions().begin(), body.positions().end()), stood);
      for (const auto& use : uses) EXPECT_NO_THROW(use());
      environment.set_impassable(facet, false);
    }
}

TEST(BodyEdit, IsNoticedAtEachUse2) { expect_edits_noticed<2>(); }
TEST(BodyEdit, IsNoticedAtEachUse3) { expect_edits_noticed<3>(); }

TEST(BodyEdit, SweepsOfParticlesInACellThatIsGoneAreRefused) {
  Environment<3> environment = Environment<3>::build(simplex_grid<3>(2));
  const Snapshot<3>& snapshot = environment.snapshot();
  const Cell gone = snapshot.cell(0);
  const Point<3> middle = mean(snapshot.view(gone));
  Particle<3> stale;
  stale.position = middle;
  stale.cell = gone;
  environment.insert_point(gone, middle);
  const Particle<3> fresh = Locator<3>(snapshot).particle_at(middle + Vector<3>{0x1p-6, 0, 0}).value();
  Edge_counts counts;
  const Point<3> target = middle + Vector<3>{0, 0x1p-6, 0};
  for (const auto& [p, q] :
       std::vector<std::array<Particle<3>, 2>>{{fresh, stale}, {stale, fresh}, {stale, stale}})
    EXPECT_FALSE(usage_error([&] { sweep_edge(snapshot, p, target, q, {}, {}, counts); }).empty());
  EXPECT_FALSE(usage_error([&] { find_chain(snapshot, stale, fresh, counts.walk); }).empty());
  EXPECT_FALSE(usage_error([&] { find_chain(snapshot, fresh, stale, counts.walk); }).empty());
}

/// The wall between the cells of two points of a world of two squares or cubes.
template <int D>
Half_facet middle_facet(const Snapshot<D>& snapshot) {
  for (std::size_t k = 0;; ++k) {
    const Half_facet f = snapshot.half_facet(snapshot.cell(0), k);
    if (snapshot.neighbour(f) != Cell::none) return f;
  }
}

TEST(BodyEdit, AWallThatAppearsIsMet) {
  Environment<2> environment = Environment<2>::build(square_grid({.cells = {2, 1}}));
  const Snapshot<2>& snapshot = environment.snapshot();
  const Locator<2> locator(snapshot);
  Body<2> body(snapshot, locator, {{{0.5, 0.5}, {0.75, 0.5}}, {{0, 1}}, {}});
  Body_counts counts;
  Step_report<2> report;
  // There and back through the open facet, in a region that holds both.
  const std::vector<Point<2>> here{{0.5, 0.5}, {0.75, 0.5}}, there{{1.25, 0.5}, {1.5, 0.5}};
  body.step(there, {}, report, counts);
  body.step(here, {}, report, counts);
  EXPECT_TRUE(report.contacts.empty());
  EXPECT_GT(counts.in_region, 0u);
  environment.set_impassable(middle_facet(snapshot), true);
  body.register_again(locator);
  body.step(there, {}, report, counts);
  EXPECT_FALSE(report.contacts.empty());
  for (const Point<2>& x : body.positions()) EXPECT_LE(x[0], 1);
  EXPECT_NO_THROW(body.refresh(counts));
  EXPECT_NO_THROW(body.validate());
}

TEST(BodyEdit, AWallThatAppearsInABodyIsRefusedUntilItGoes) {
  Environment<2> environment = Environment<2>::build(square_grid({.cells = {2, 1}}));
  const Snapshot<2>& snapshot = environment.snapshot();
  const Locator<2> locator(snapshot);
  Body<2> body(snapshot, locator, {{{0.75, 0.5}, {1.25, 0.5}}, {{0, 1}}, {}});
  Body_counts counts;
  environment.set_impassable(middle_facet(snapshot), true);
  for (int i = 0; i < 2; ++i) {
    try {
      body.register_again(locator);
      ADD_FAILURE() << "registered across a wall";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::outside);
    }
    EXPECT_FALSE(usage_error([&] { body.refresh(counts); }).empty());
    EXPECT_EQ(body.positions()[1], (Point<2>{1.25, 0.5}));
  }
  environment.set_impassable(middle_facet(snapshot), false);
  EXPECT_FALSE(usage_error([&] { body.refresh(counts); }).empty()) << "another epoch, if the same walls";
  body.register_again(locator);
  EXPECT_NO_THROW(body.validate());
}

/// A vertex of the boundary may be moved out of the box in which single precision is used.
TEST(BodyEdit, AWallMovedFarOutIsMet) {
  for (const auto& [vertices, foot] :
       std::vector<std::pair<std::uint32_t, double>>{{1, 1.96875}, {1, 3}, {40, 1.96875}, {40, 3}}) {
    SCOPED_TRACE(testing::Message() << vertices << " vertices, foot of the wall at " << foot);
    Cell_soup<2> square = square_grid({.cells = {1, 1}});
    for (Point<2>& x : square.points) x = 1.96875 * x;
    Environment<2> environment = Environment<2>::build(square);
    const Snapshot<2>& snapshot = environment.snapshot();
    for (const auto& [from, to] : {std::array<Point<2>, 2>{{{1.96875, 1.96875}, {4, 1.96875}}},
                                   std::array<Point<2>, 2>{{{1.96875, 0}, {foot, 0}}}})
      environment.move_vertex(point_at(snapshot, from), to);
    Body_soup<2> soup;
    for (std::uint32_t v = 0; v < vertices; ++v) soup.points.push_back({3.25 + 0x1p-8 * v, 1.75});
    const Locator<2> locator(snapshot);
    Body<2> body(snapshot, locator, soup);
    Body_counts counts;
    Step_report<2> report;
    for (int k = 0; k < 50; ++k) {
      std::vector<Point<2>> targets(body.positions().begin(), body.positions().end());
      for (Point<2>& x : targets) x[0] += 0x1p-6;
      body.step(targets, {}, report, counts);
    }
    EXPECT_GE(report.contacts.size(), vertices);
    for (const Point<2>& x : body.positions()) EXPECT_TRUE(locator.particle_at(x)) << x[0];
  }
}

TEST(BodyEdit, AVertexInAWallKeepsItsSide) {
  // A membrane between two squares, and two bodies that stand in it, one from each side. Some corner of the
  // world is moved.
  Environment<2> environment = Environment<2>::build(square_grid({.cells = {2, 1}}));
  const Snapshot<2>& snapshot = environment.snapshot();
  environment.set_impassable(middle_facet(snapshot), true);
  for (const double side : {-1.0, 1.0}) {
    SCOPED_TRACE(side);
    const Locator<2> locator(snapshot);
    Body<2> body(snapshot, locator, {{{1 + 0.25 * side, 0.5}}, {}, {}});
    Body_counts counts;
    ASSERT_FALSE(body.move_vertex(0, {1, 0.5}, {}, counts)) << "into the wall";
    const Cell own = body.particles()[0].cell;
    environment.move_vertex(0, {-0.5 - 0.25 * side, -0.5});
    body.register_again(Locator<2>(snapshot));
    EXPECT_EQ(body.particles()[0].cell, own);
    EXPECT_TRUE(body.move_vertex(0, {1 - 0.25 * side, 0.5}, {}, counts)) << "through it";
    EXPECT_FALSE(body.move_vertex(0, {1 + 0.25 * side, 0.5}, {}, counts)) << "off it";
  }
}

}  // namespace
}  // namespace cellwalk
