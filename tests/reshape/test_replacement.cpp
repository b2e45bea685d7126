// SPDX-License-Identifier: LGPL-3.0-or-later
// Replacements of cells by hand: what lies on the facets and edges that go and come, and on the walls around.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "reshape/grids.h"
#include "reshape/replacing.h"

namespace cellwalk {
namespace {

/// A square of two triangles.
Environment<2> square() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 2, 3});
  return Environment<2>::build(std::move(soup));
}

/// Two tetrahedra on a triangle at height 0.
Environment<3> bipyramid() {
  Cell_soup<3> soup;
  soup.points = {{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, -3}, {0, 0, 3}};
  add_tetrahedron(soup, 0, 1, 2, 4);
  add_tetrahedron(soup, 1, 0, 2, 3);
  return Environment<3>::build(std::move(soup));
}

template <int D>
Half_facet facet_between(const Snapshot<D>& snapshot) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; snapshot.cell(i) != Cell::none && k <= D; ++k)
      if (const Half_facet f = Snapshot<D>::half_facet(snapshot.cell(i), k);
          snapshot.neighbour(f) != Cell::none && !snapshot.is_impassable(f))
        return f;
  return Half_facet::none;
}

/// Bodies that are validated, and particles that are looked at, after each replacement.
template <int D>
struct Things {
  explicit Things(Environment<D>& of) : environment(of), locator(of.snapshot()) {}

  void add(const std::vector<Point<D>>& points, std::vector<std::array<std::uint32_t, 3>> faces = {}) {
    Body_soup<D> soup{points, {}, std::move(faces)};
    for (std::uint32_t i = 1; i < points.size(); ++i) soup.edges.push_back({i - 1, i});
    if (points.size() == 3) soup.edges = {{0, 1}, {0, 2}, {1, 2}};
    bodies.push_back(std::make_unique<Body<D>>(environment.snapshot(), locator, soup));
    for (const Point<D>& x : points) particles.push_back(locator.particles_at(x).front());
  }
  template <class Edit>
  Replacement with(const Edit& edit) {
    Residents<D> residents;
    for (const auto& body : bodies) residents.bodies.push_back(body.get());
    residents.particles = {std::span(particles)};
    Reshaping<D> reshaping(environment, residents);
    const Replacement result = edit(reshaping);
    reshaping.finish();
    check();
    return result;
  }
  void check() {
    EXPECT_NO_THROW(environment.certify());
    const Snapshot<D>& snapshot = environment.snapshot();
    for (std::size_t b = 0; b < bodies.size(); ++b) EXPECT_NO_THROW(bodies[b]->validate()) << "body " << b;
    for (const Particle<D>& p : particles) {
      ASSERT_TRUE(snapshot.is_cell(p.cell));
      EXPECT_TRUE(in_closure(snapshot, p.cell, p.position));
      EXPECT_LT(p.aimed, snapshot.facet_count(p.cell));
    }
  }
  std::size_t chain(std::size_t body) const { return bodies[body]->chain(0).size(); }

  Environment<D>& environment;
  Locator<D> locator;
  std::vector<std::unique_ptr<Body<D>>> bodies;
  std::vector<Particle<D>> particles;
};

TEST(Replacement, FlipsTheDiagonalOfASquare) {
  Environment<2> environment = square();
  Things<2> things(environment);
  things.add({{1, 3}, {3, 1}});  // through the facet that goes, in the one that comes
  things.add({{1, 1}, {3, 3}});  // in the one that goes, through the one that comes
  things.add({{2, 1}, {2, 3}});  // through where they meet
  things.add({{3, 0.5}, {0.5, 1}, {1, 3.5}});
  things.add({{0, 0}, {0, 4}});  // in a wall, at the ends of both
  const auto flip = [&](Reshaping<2>& reshaping) {
    return reshaping.flip(facet_between<2>(environment.snapshot()));
  };
  const Replacement there = things.with(flip);
  ASSERT_TRUE(there.is_made) << there.reason;
  EXPECT_EQ(there.cells.size(), 2u);
  EXPECT_EQ(there.point, Replacement::none);
  EXPECT_EQ(things.chain(1), 1u) << "it passes the new one";
  EXPECT_EQ(things.bodies[0]->particles()[0].dimension, 1);
  ASSERT_TRUE(things.with(flip).is_made);
  EXPECT_EQ(things.chain(0), 1u);
  EXPECT_EQ(things.bodies[1]->particles()[0].dimension, 1);
}

TEST(Replacement, FlipsAFacetOfABipyramid) {
  Environment<3> environment = bipyramid();
  Things<3> things(environment);
  things.add({{0.25, 0.25, -1}, {0.25, 0.25, 1}});  // through the facet that goes
  things.add({{0, 0, -1}, {0, 0, 1}});              // in the edge that comes
  things.add({{1, 0, 0}, {-1, 1, 0}});              // in the facet that goes
  things.add({{1, 0, 0}, {-1, 0, 0}});              // in it, and through the edge that comes
  things.add({{1, 0.25, 0.5}, {-2, 0.5, 0.25}, {-1, -1, -0.5}}, {{0, 1, 2}});
  things.add({{0.75, 0.75, 0.75}, {-0.75, 1.5, 0.75}, {0, 0.75, 1.5}}, {{0, 1, 2}});  // on a wall
  const auto rest = [&](std::uint32_t k) {
    const Snapshot<3>& snapshot = environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      for (std::size_t f = 0; c != Cell::none && f < 4; ++f) {
        auto loop = snapshot.loop(Snapshot<3>::half_facet(c, f));
        std::sort(loop.begin(), loop.end());
        if (loop == std::vector<std::uint32_t>{0, 1, k}) return Snapshot<3>::half_facet(c, f);
      }
    }
    return Half_facet::none;
  };
  const Replacement there =
      things.with([&](Reshaping<3>& r) { return r.flip(facet_between<3>(environment.snapshot())); });
  ASSERT_TRUE(there.is_made) << there.reason;
  EXPECT_EQ(there.cells.size(), 3u);
  EXPECT_EQ(things.chain(0), 0u) << "both ends in the cell on the side of its y";
  EXPECT_EQ(things.bodies[1]->particles()[0].dimension, 1);
  EXPECT_TRUE(environment.snapshot().is_cell(environment.snapshot().cell_of(rest(4))));
  // A face that rests on the wall cannot pass it, and may leave it.
  Body<3>& resting = *things.bodies[5];
  Step_report<3> report;
  Body_counts counts;
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  std::vector<Point<3>> inwards(resting.positions().begin(), resting.positions().end());
  for (Point<3>& x : inwards) x = x - Vector<3>{0.125, 0.25, 0.125};
  resting.step(inwards, options, report, counts);
  EXPECT_TRUE(report.contacts.empty());
  const Replacement back = things.with([](Reshaping<3>& r) { return r.remove_edge(3, 4); });
  ASSERT_TRUE(back.is_made) << back.reason;
  EXPECT_EQ(back.cells.size(), 2u);
  EXPECT_EQ(things.chain(0), 1u);
}

template <int D>
void insert_and_collapse(Environment<D> environment, const Point<D>& x, const Point<D>& y) {
  Things<D> things(environment);
  things.add({x, y});
  const auto before = environment.certify();
  const std::size_t points = environment.snapshot().points().size();
  for (int k = 0; k < 3; ++k) {
    const Cell at_x = things.bodies[0]->particles()[0].cell;
    const Replacement in = things.with([&](Reshaping<D>& r) { return r.insert_point(at_x, x); });
    ASSERT_TRUE(in.is_made) << in.reason;
    EXPECT_EQ(in.point, points) << "the index of the one removed is reused";
    EXPECT_EQ(in.cells.size(), D + 1u);
    EXPECT_EQ(things.bodies[0]->particles()[0].dimension, 0);
    const std::uint32_t onto = environment.snapshot().view(in.cells[0]).point_index(0) == in.point
                                   ? environment.snapshot().view(in.cells[0]).point_index(1)
                                   : environment.snapshot().view(in.cells[0]).point_index(0);
    const Replacement out = things.with([&](Reshaping<D>& r) { return r.collapse(in.point, onto); });
    ASSERT_TRUE(out.is_made) << out.reason;
    EXPECT_EQ(out.point, in.point);
    EXPECT_EQ(out.cells.size(), 1u);
    EXPECT_FALSE(environment.snapshot().is_point(in.point));
    EXPECT_THROW(environment.cells_around(in.point), Error);
    EXPECT_EQ(environment.certify().cells, before.cells);
    EXPECT_EQ(environment.certify().vertices, before.vertices);
    EXPECT_EQ(environment.certify().volume, before.volume);
    EXPECT_EQ(things.bodies[0]->particles()[0].dimension, D);
    // A point without cells does not matter to whoever builds the environment anew.
    EXPECT_EQ(Environment<D>::build(environment.soup()).certify().vertices, before.vertices);
  }
  EXPECT_EQ(environment.snapshot().points().size(), points + 1);
}

TEST(Replacement, RemovesThePointThatItInserted) {
  insert_and_collapse<2>(square(), {3, 1}, {1, 3});
  insert_and_collapse<3>(bipyramid(), {0, 0, 1}, {0, 0, -1});
}

TEST(Replacement, SplitsAnInnerEdge) {
  Environment<3> environment = bipyramid();
  Things<3> things(environment);
  things.add({{0, 0, -1}, {0, 0, 1}});
  things.add({{1, 0, 0}, {-1, 0, 0}});
  ASSERT_TRUE(
      things.with([&](Reshaping<3>& r) { return r.flip(facet_between<3>(environment.snapshot())); }).is_made);
  // Beside the edge: the new point lies off it.
  const Replacement split = things.with([](Reshaping<3>& r) { return r.split_edge(3, 4, {0.25, 0, 0}); });
  ASSERT_TRUE(split.is_made) << split.reason;
  EXPECT_EQ(split.cells.size(), 6u);
  EXPECT_EQ(environment.cells_around(split.point).size(), 6u);
  EXPECT_FALSE(things.with([](Reshaping<3>& r) { return r.split_edge(0, 1, {0, 1.5, 0}); }).is_made);
  Environment<2> plane = square();
  Things<2> flat(plane);
  flat.add({{1, 3}, {3, 1}});
  flat.add({{1, 1}, {3, 3}});
  EXPECT_EQ(flat.with([](Reshaping<2>& r) { return r.split_edge(0, 2, {2, 2.5}); }).cells.size(), 4u);
}

TEST(Replacement, SaysWhyNot) {
  Environment<3> environment = bipyramid();
  Things<3> things(environment);
  things.add({{0, 0, -1}, {0, 0, 1}});
  const Snapshot<3>& snapshot = environment.snapshot();
  const auto cells = [&] { return snapshot.cell_count(); };
  const auto wall = [&] {
    for (std::size_t k = 0;; ++k)
      if (snapshot.is_impassable(Snapshot<3>::half_facet(snapshot.cell(0), k)))
        return Snapshot<3>::half_facet(snapshot.cell(0), k);
  };
  EXPECT_EQ(things.with([&](auto& r) { return r.flip(wall()); }).reason, "the facet is a wall");
  EXPECT_EQ(things.with([&](auto& r) { return r.remove_edge(0, 1); }).reason,
            "a wall or the boundary has the edge");
  EXPECT_EQ(things.with([&](auto& r) { return r.collapse(0, 1); }).reason,
            "a wall or the boundary has the point");
  EXPECT_EQ(things.with([&](auto& r) {
                    return r.insert_point(snapshot.cell(0), {0, 0, 0});
                  })
                .reason,
            "the point does not lie strictly inside the cell");
  EXPECT_EQ(cells(), 2u);
  ASSERT_TRUE(things.with([&](auto& r) { return r.flip(facet_between<3>(snapshot)); }).is_made);
  EXPECT_EQ(things.with([&](auto& r) {
                    return r.split_edge(3, 4, {9, 0, 0});
                  })
                .reason,
            "a cell would be flat or inverted");
  const auto code = [&](const auto& edit) {
    try {
      things.with([&](auto& r) { return edit(r); });
    } catch (const Error& error) {
      return error.code();
    }
    return Error_code::other;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code([&](auto& r) { return r.insert_point(Cell::none, {}); }), Error_code::usage);
  EXPECT_EQ(code([&](auto& r) { return r.insert_point(snapshot.cell(0), {nan, 0, 0}); }), Error_code::input);
  EXPECT_EQ(code([&](auto& r) { return r.flip(Half_facet::none); }), Error_code::usage);
  EXPECT_EQ(code([&](auto& r) { return r.remove_edge(3, 3); }), Error_code::usage);
  EXPECT_EQ(code([&](auto& r) { return r.collapse(99, 0); }), Error_code::usage);
  EXPECT_EQ(code([&](auto& r) {
              r.finish();
              return r.flip(facet_between<3>(snapshot));
            }),
            Error_code::usage);
  environment.freeze();
  EXPECT_EQ(code([&](auto& r) { return r.flip(facet_between<3>(snapshot)); }), Error_code::usage);
  EXPECT_EQ(things.bodies[0]->particles().size(), 2u);
}

/// A particle on a wall of the patch, on either side of a membrane, stays there.
TEST(Replacement, KeepsSidesOfAMembrane) {
  Environment<3> environment = test::simplex_grid<3>(4);
  test::add_membrane<3>(environment, 2);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Point<3> x{2.25, 2.125, 2};
  std::vector<Particle<3>> particles = Locator<3>(snapshot).particles_at(x);
  ASSERT_EQ(particles.size(), 2u);
  const auto is_above = [&](const Particle<3>& p) {
    double top = 0;
    for (const std::uint32_t v : snapshot.view(p.cell).vertices) top = std::max(top, snapshot.point(v)[2]);
    return top > 2;
  };
  const std::array<bool, 2> above{is_above(particles[0]), is_above(particles[1])};
  ASSERT_NE(above[0], above[1]);
  Reshaping<3> reshaping(environment, {{}, {particles}});
  test::Replacement_tally tally;
  Random random(1);
  int renamed = 0;
  for (int k = 0; k < 400; ++k) {
    const std::array<Cell, 2> before{particles[0].cell, particles[1].cell};
    test::replace_at(reshaping, snapshot, before[random.below(2)], random, 500, tally);
    for (std::size_t i = 0; i < 2; ++i) renamed += particles[i].cell != before[i];
  }
  reshaping.finish();
  EXPECT_GT(renamed, 40);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(is_above(particles[k]), above[k]);
  EXPECT_NO_THROW(environment.certify());
}

/// An edge of a membrane is split where it is, if nothing lies beside it.
template <int D>
void split_a_membrane() {
  Environment<D> environment = test::simplex_grid<D>(4);
  test::add_membrane<D>(environment, 2);
  const Snapshot<D>& snapshot = environment.snapshot();
  Point<D> u, v, middle, far;
  u.fill(2);
  v.fill(2);
  u[0] = 1;
  middle = v;
  middle[0] = 1.5;
  far.fill(0.75);
  std::vector<Particle<D>> particles = Locator<D>(snapshot).particles_at(middle);
  ASSERT_EQ(particles.size(), 2u);
  const std::uint32_t from = test::point_at<D>(environment, u), to = test::point_at<D>(environment, v);
  const Certificate before = environment.certify();
  Reshaping<D> busy(environment, {{}, {particles}});
  EXPECT_EQ(busy.split_edge(from, to, middle).reason,
            "a wall has the edge, and something lies in the cells around it");
  busy.finish();
  EXPECT_EQ(environment.certify().cells, before.cells);
  std::vector<Particle<D>> aside = Locator<D>(snapshot).particles_at(far);
  Reshaping<D> reshaping(environment, {{}, {aside}});
  Point<D> off = middle;
  off[1] += 0x1p-40;
  EXPECT_EQ(reshaping.split_edge(from, to, off).reason,
            "a wall has the edge, and the position is not exactly on it");
  EXPECT_FALSE(reshaping.split_edge(from, to, v).is_made);
  const Replacement split = reshaping.split_edge(from, to, middle);
  ASSERT_TRUE(split.is_made) << split.reason;
  EXPECT_EQ(split.cells.size(), D == 2 ? 4u : 12u);
  reshaping.finish();
  const Certificate after = environment.certify();
  EXPECT_EQ(after.membranes, before.membranes + (D == 2 ? 1 : 2));
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.volume, before.volume);
  EXPECT_EQ(Locator<D>(snapshot).particles_at(middle).size(), 2u);
}

TEST(Replacement, SplitsAnEdgeOfAMembrane) {
  split_a_membrane<2>();
  split_a_membrane<3>();
}

}  // namespace
}  // namespace cellwalk
