// SPDX-License-Identifier: LGPL-3.0-or-later
// Blades of many shapes, and tissue of many: cuts stay sound in all of them.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "oracle/seed.h"
#include "reshape/cut_judge.h"
#include "reshape/grids.h"
#include "reshape/tissue_block.h"
#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"

namespace cellwalk {
namespace {

/// Squares, of which only some are divided into triangles.
Cell_soup<2> squares_and_triangles(std::uint32_t size, std::uint64_t seed) {
  Cell_soup<2> soup;
  Random random(oracle::reseeded(seed));
  const auto point = [&](std::uint32_t i, std::uint32_t j) { return j * (size + 1) + i; };
  for (std::uint32_t j = 0; j <= size; ++j)
    for (std::uint32_t i = 0; i <= size; ++i)
      soup.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  const auto add = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) soup.add_facet({loop[k], loop[(k + 1) % loop.size()]});
    soup.end_cell();
  };
  for (std::uint32_t j = 0; j < size; ++j)
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
      if (random.chance(0.3)) {
        add({a, b, c, d});
      } else {
        add({a, b, c});
        add({a, c, d});
      }
    }
  test::fill_below(soup, 0.8 * size);
  return soup;
}

/// Cuts, and expects that all is certified, and that free space grew.
template <int D>
Cut_report sound_cut(Environment<D>& environment, const Blade<D>& by, double opening) {
  const Certificate before = environment.certify();
  Reshaping<D> reshaping(environment, {});
  const Cut_report report = reshaping.cut(by, {.opening = opening});
  reshaping.finish();
  Certificate after;
  EXPECT_NO_THROW(after = environment.certify());
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
  EXPECT_GE(after.free_volume, before.free_volume * (1 - 1e-12));
  EXPECT_EQ(after.vertices, before.vertices + report.points.size());
  return report;
}

/// Cells of other shapes hold together, with what they touch.
TEST(CutShapes, LeaveSquaresWhole) {
  std::size_t held = 0, opened = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const double lean : {0.0, 0.1, 0.5, 4.0}) {
      auto environment = Environment<2>::build(squares_and_triangles(7, seed));
      const auto squares = [&] {
        std::size_t count = 0;
        for (std::size_t i = 0; i < environment.snapshot().cell_slots(); ++i)
          if (const Cell c = environment.snapshot().cell(i); c != Cell::none)
            count += environment.snapshot().facet_count(c) == 4;
        return count;
      };
      const std::size_t before = squares();
      // Along the diagonals of squares, or steeper.
      const double down = lean == 4 ? 4 : 3.5;
      const Cut_report report =
          sound_cut<2>(environment, test::blade<2>({{3 + lean, 3 + down}, {3 - lean, 3 - down}}), 0.05);
      EXPECT_EQ(squares(), before) << seed;
      held += report.held;
      opened += report.opened;
      refused += report.refused();
    }
  EXPECT_GT(held, 8u);
  EXPECT_GT(opened, 50u);
  EXPECT_GT(refused, 15u);
}

/// Boxes, prisms, stars and simplices on lattices, some of them solid: whatever is cut, all stays certified.
template <int D>
void cut_lattices(std::size_t worlds) {
  std::size_t edges = 0, opened = 0, whole = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    oracle::World<D> world = oracle::make_world<D>(number);
    SCOPED_TRACE(world.name + " " + std::to_string(number));
    Random random(oracle::reseeded(number));
    for (auto& solid : world.soup.solid) solid = solid || random.chance(0.7);
    Point<D> low = world.soup.points[0], high = low;
    for (const Point<D>& x : world.soup.points)
      for (std::size_t k = 0; k < D; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
    auto environment = Environment<D>::build(world.soup, {.duplicates = Duplicate_vertices::keep});
    for (int turn = 0; turn < 2; ++turn) {
      std::vector<Point<D>> points(turn == 0 ? D : 2 * D - 2);
      const auto axis = static_cast<std::size_t>(random.below(D));
      const double level = random.real(0.2, 0.8);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < D; ++k) {
          double share = random.real(-0.2, 1.2);
          if (turn == 1) {  // across all
            const std::size_t corner = D == 2 ? i : (k == (axis + 1) % 3) ? i / 2 : (i + 1) / 2 % 2;
            share = k == axis ? level : corner == 0 ? -0.3 : 1.3;
          }
          if (random.chance(turn == 1 ? (number % 2 == 0) : 0.5)) share = std::round(8 * share) / 8;
          points[i][k] = low[k] + share * (high[k] - low[k]);
        }
      try {
        const Cut_report report =
            sound_cut<D>(environment, blade_along<D>(points), 0.02 * (high[0] - low[0]));
        edges += report.edges;
        opened += report.opened;
        whole += report.refused() + report.held;
      } catch (const Error& e) {
        ASSERT_EQ(e.code(), Error_code::input) << e.what();  // the points lie in line
      }
      if (testing::Test::HasFailure()) return;
    }
  }
  std::printf("%dD: %zu edges passed, %zu vertices parted, %zu edges and vertices whole\n", D, edges, opened,
              whole);
  EXPECT_GT(edges, worlds);
  EXPECT_GT(opened, worlds / 4);
  EXPECT_GT(whole, worlds / 4);
}

TEST(CutShapes, OfLatticesInThePlane) {
  cut_lattices<2>(std::max<std::size_t>(oracle::scaled_count(90), 45));
}
TEST(CutShapes, OfLatticesInSpace) { cut_lattices<3>(std::max<std::size_t>(oracle::scaled_count(60), 30)); }

/// Polylines, polygons and swept lines, small and large ones, through anything: judged in rational numbers.
template <int D>
Blade<D> some_blade(Random& random, double size, bool is_lattice) {
  const std::size_t kind = random.below(3);
  const double reach = random.chance(0.2) ? 0.3 : random.chance(0.3) ? 1.2 : 4;
  Point<D> middle;
  for (double& c : middle) c = random.real(0.2, size - 0.2);
  const auto beside = [&](const Point<D>& x) {
    Point<D> y = x;
    for (double& c : y) {
      c += random.real(-reach, reach);
      if (is_lattice) c = std::round(4 * c) / 4;
    }
    return y;
  };
  if constexpr (D == 2) {
    std::vector<Point<2>> points{beside(middle)};
    while (points.size() < 2 + 2 * kind) points.push_back(beside(points.back()));
    return blade_along<2>(points);
  } else if (kind == 0) {
    return blade_along<3>(std::vector<Point<3>>{beside(middle), beside(middle), beside(middle)});
  } else if (kind == 1) {  // a regular polygon
    const std::size_t count = 4 + random.below(4);
    const auto axis = static_cast<std::size_t>(random.below(3));
    std::vector<Point<3>> points(count, beside(middle));
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(k) / static_cast<double>(count);
      points[k][(axis + 1) % 3] += reach * std::cos(angle);
      points[k][(axis + 2) % 3] += reach * std::sin(angle);
    }
    return blade_along<3>(points);
  } else {
    std::vector<Point<3>> points{beside(middle)};
    while (points.size() < 4) points.push_back(beside(points.back()));
    Vector<3> by;
    for (double& c : by) c = is_lattice ? std::round(random.real(-2, 2)) : random.real(-2, 2);
    by[2] -= 0.5;
    return swept_blade(points, by);
  }
}

template <int D>
void cut_by_many_shapes(std::size_t count) {
  std::size_t split = 0, snapped = 0, opened = 0, rim = 0;
  for (std::uint64_t number = 0; number < count; ++number) {
    SCOPED_TRACE("cut " + std::to_string(number));
    Random random(oracle::reseeded(number));
    const bool is_lattice = number % 2 == 0;
    constexpr std::uint32_t size = D == 2 ? 6 : 3;
    auto environment = test::tissue<D>(size, random.real(0.5, 1) * size, is_lattice ? 0 : 0.15, number);
    const test::Cut_judge<D> judge(environment.snapshot());
    Reshaping<D> reshaping(environment, {});
    Cut_report report;
    try {
      report =
          reshaping.cut(some_blade<D>(random, size, is_lattice),
                        {.opening = random.chance(0.5) ? 0.02 : 1.0, .snap = random.chance(0.8) ? 0.125 : 0});
    } catch (const Error& e) {
      ASSERT_EQ(e.code(), Error_code::input) << e.what();  // points in line
      continue;
    }
    reshaping.finish();
    ASSERT_NO_THROW(environment.certify());
    split += report.split;
    snapped += report.snapped;
    opened += report.opened;
    rim += report.rim;
    const test::Cut_findings found = judge.changes();
    EXPECT_TRUE(found.has_same_volume);
    EXPECT_EQ(found.flat, 0u);
    EXPECT_EQ(found.entered, 0u);
    EXPECT_EQ(found.unmarked, 0u);
    EXPECT_GE(found.gap_cells, report.opened);
    if (testing::Test::HasFailure()) return;
  }
  std::printf("%dD: %zu cuts, %zu edges split, %zu snapped, %zu vertices parted, %zu at rims\n", D, count,
              split, snapped, opened, rim);
  EXPECT_GT(split, count);
  EXPECT_GT(snapped, count / 4);
  EXPECT_GT(opened, count / 8);
  EXPECT_GT(rim, count / 4);
}

TEST(CutShapes, OfManyBladesInThePlane) {
  cut_by_many_shapes<2>(std::max<std::size_t>(oracle::scaled_count(60), 20));
}
TEST(CutShapes, OfManyBladesInSpace) {
  cut_by_many_shapes<3>(std::max<std::size_t>(oracle::scaled_count(24), 8));
}

/// A blade that bends around a triangle, through all of its corners: that lies behind the blade, whichever
/// side is its front, and so keeps its corners.
TEST(CutShapes, PutCellsThatTheyPassAllAroundBehind) {
  int found = 0;
  for (const bool is_reversed : {false, true}) {
    auto environment = test::tissue<2>(6, 5, 0);
    const Snapshot<2>& snapshot = environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell_view<2> view = snapshot.view(snapshot.cell(i));
      const std::set<Point<2>> corners{view.point(0), view.point(1), view.point(2)};
      // The right angle at (3, 2), one leg upwards.
      if (!corners.contains({3, 2}) || !corners.contains({3, 3})) continue;
      const Point<2> end = corners.contains({4, 2}) ? Point<2>{4, 2} : Point<2>{2, 2};
      if (!corners.contains(end)) continue;
      ++found;
      const std::set<std::uint32_t> before(view.vertices.begin(), view.vertices.end());
      const Point<2> middle = test::middle_of(snapshot, snapshot.cell(i));
      std::vector<Point<2>> points{{3, 7}, {3, 2}, end};
      if (is_reversed) std::reverse(points.begin(), points.end());
      const Cut_report report = sound_cut<2>(environment, test::blade<2>(points), 0.05);
      EXPECT_EQ(report.split, 0u);
      EXPECT_GT(report.opened, 2u);
      std::set<std::uint32_t> now;
      for (std::size_t k = 0; k < snapshot.cell_slots(); ++k)
        if (const Cell c = snapshot.cell(k); in_closure(snapshot, c, middle))
          now.insert(snapshot.view(c).vertices.begin(), snapshot.view(c).vertices.end());
      EXPECT_EQ(now, before) << is_reversed;
      break;
    }
  }
  EXPECT_EQ(found, 2);
}

/// Cubes around a vertical edge in the middle, numbered around it. Those that are left out are in no cell.
Environment<3> cubes_around_an_edge(const std::vector<bool>& is_there, const std::vector<bool>& is_solid) {
  Simplex_grid_options<3> options;
  options.cells = {2, 2, 1};
  const Cell_soup<3> whole = tetrahedral_grid(options);
  Cell_soup<3> soup;
  soup.points = whole.points;
  for (std::size_t c = 0; c < whole.cell_count(); ++c) {
    Point<3> sum{};
    std::size_t count = 0;
    for (std::size_t f = whole.cell_begin[c]; f < whole.cell_begin[c + 1]; ++f)
      for (const std::uint32_t p : whole.facet(f)) {
        sum = sum + whole.points[p];
        ++count;
      }
    const Point<3> middle = (1 / static_cast<double>(count)) * sum;
    const std::size_t cube = middle[1] < 1 ? middle[0] > 1 : 3 - (middle[0] > 1);
    if (!is_there[cube]) continue;
    for (std::size_t f = whole.cell_begin[c]; f < whole.cell_begin[c + 1]; ++f)
      soup.add_facet(whole.facet(f));
    soup.end_cell(is_solid[cube]);
  }
  return Environment<3>::build(std::move(soup));
}

/// An edge of the boundary that is pinched: cells lie at it in two corners. It stays whole.
TEST(CutShapes, LeavePinchedEdgesOfTheBoundaryWhole) {
  for (const bool is_solid : {true, false}) {
    auto environment = cubes_around_an_edge({true, false, true, false}, {is_solid, false, is_solid, false});
    const Certificate before = environment.certify();
    ASSERT_EQ(before.pinched_vertices, 2u);
    const std::uint32_t u = test::point_at<3>(environment, {1, 1, 0}),
                        v = test::point_at<3>(environment, {1, 1, 1});
    Reshaping<3> reshaping(environment, {});
    const Replacement split = reshaping.split_edge(u, v, {1, 1, 0.5});
    EXPECT_FALSE(split.is_made);
    EXPECT_EQ(split.reason, "the boundary has the edge");
    EXPECT_FALSE(reshaping.remove_edge(u, v).is_made);
    EXPECT_FALSE(reshaping.collapse(u, v).is_made);
    const Cut_report report =
        reshaping.cut(test::blade<3>({{-1, -1, 0.4}, {3, -1, 0.4}, {3, 3, 0.4}, {-1, 3, 0.4}}));
    reshaping.finish();
    Certificate after;
    ASSERT_NO_THROW(after = environment.certify());
    EXPECT_NEAR(after.volume, before.volume, 1e-12);
    EXPECT_EQ(after.pinched_vertices, 2u);
    EXPECT_EQ(report.split > 0, is_solid);
    EXPECT_EQ(report.refused(), is_solid ? 1u : 0u) << "the edge that is pinched";
  }
}

/// An edge with free space in two corners: what lies on it stays in its own.
TEST(CutShapes, LeaveEdgesBetweenTwoFreeCornersWhole) {
  auto environment = cubes_around_an_edge({true, true, true, true}, {true, false, true, false});
  const Snapshot<3>& snapshot = environment.snapshot();
  auto particles = Locator<3>(snapshot).particles_at({1, 1, 0.25});
  ASSERT_EQ(particles.size(), 2u);
  const auto corner = [&](const Particle<3>& p) { return test::middle_of(snapshot, p.cell)[0] > 1; };
  const std::vector<bool> before{corner(particles[0]), corner(particles[1])};
  EXPECT_NE(before[0], before[1]);
  Reshaping<3> reshaping(environment, {{}, {std::span(particles)}});
  const Cut_report report =
      reshaping.cut(test::blade<3>({{-1, -1, 0.4}, {3, -1, 0.4}, {3, 3, 0.4}, {-1, 3, 0.4}}));
  reshaping.finish();
  EXPECT_NO_THROW(environment.certify());
  EXPECT_GT(report.split, 10u);
  EXPECT_EQ(report.refused(), 1u);
  EXPECT_EQ(corner(particles[0]), before[0]);
  EXPECT_EQ(corner(particles[1]), before[1]);
}

}  // namespace
}  // namespace cellwalk
