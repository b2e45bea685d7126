// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets and cells that change, cuts and stitches among bodies with a radius, judged by distances of hulls in
// rationals.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <vector>

#include "edge/thick_rooms.h"
#include "kernel/rational_distance.h"
#include "reshape/operations_soak.h"
#include "reshape/thick_world.h"
#include "reshape/toggle_world.h"

namespace cellwalk::test {
namespace {

class InTheGrid : public ::testing::Test {
 protected:
  InTheGrid() : room(Environment<3>::build(stretched<3>(oracle::make_cubes(4, 4, 4), {2, 2, 2}))) {}

  Cell cell_at(const Point<3>& x) { return Locator<3>(room.snapshot()).particle_at(x)->cell; }
  std::unique_ptr<Body<3>> rod(const Point<3>& p, const Point<3>& q, double r) {
    Body_soup<3> soup;
    soup.points = {p, q};
    soup.edges = {{0, 1}};
    soup.radii = {r};
    return std::make_unique<Body<3>>(room.snapshot(), Locator<3>(room.snapshot()), soup);
  }
  /// The facet between two neighbours.
  Half_facet between(const Point<3>& x, const Point<3>& y) {
    const Cell c = cell_at(x), d = cell_at(y);
    for (std::size_t i = 0; i < room.snapshot().facet_count(c); ++i)
      if (const Half_facet f = Snapshot<3>::half_facet(c, i); room.snapshot().neighbour(f) == d) return f;
    return Half_facet::none;
  }

  Environment<3> room;
};

TEST_F(InTheGrid, AFacetClosesAtTheRadius) {  // case 51
  const Half_facet f = between({3, 3, 3}, {5, 3, 3});
  const auto at = rod({3, 3, 3}, {3, 3, 3.5}, 1);
  {
    Reshaping<3> reshaping(room, {{at.get()}, {}});
    EXPECT_TRUE(reshaping.close(f).is_made);
    EXPECT_TRUE(reshaping.open(f).is_made);
  }
  EXPECT_NO_THROW(at->validate());
  const auto thicker = rod({3, 3, 3}, {3, 3, 3.5}, 1 + 0x1p-52);
  Reshaping<3> reshaping(room, {{thicker.get()}, {}});
  const Outcome outcome = reshaping.close(f);
  EXPECT_FALSE(outcome.is_made);
  EXPECT_EQ(outcome.reason, "something is nearer to the facet than its radius");
  EXPECT_EQ(outcome.held_by, (std::vector<Resident>{{false, 0, Body_feature::edge, 0}}));
  EXPECT_EQ(outcome.distance, 1);
}

// All edges of the face are farther from the facet.
TEST_F(InTheGrid, AFacetClosesBesideAFace) {
  Body_soup<3> soup;
  soup.points = {{3.5, 0.6, 0.6}, {3.5, 7.4, 0.6}, {3.5, 3, 7.4}};
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  soup.faces = {{0, 1, 2}};
  soup.radii = {0.52};
  Body<3> body(room.snapshot(), Locator<3>(room.snapshot()), soup);
  Reshaping<3> reshaping(room, {{&body}, {}});
  const Half_facet f = between({3, 3, 3}, {5, 3, 3});
  EXPECT_EQ(reshaping.close(f).held_by, (std::vector<Resident>{{false, 0, Body_feature::face, 0}}));
}

TEST_F(InTheGrid, ACellIsFilledAround) {  // case 52
  const auto inside = rod({3, 3, 3}, {3, 3, 3.25}, 0.125);
  Reshaping<3> reshaping(room, {{inside.get()}, {}});
  const Outcome outcome = reshaping.fill(cell_at({3, 3, 3}));
  EXPECT_FALSE(outcome.is_made);
  EXPECT_EQ(outcome.distance, 0);
  EXPECT_TRUE(reshaping.fill(cell_at({5, 3, 3})).is_made);
}

TEST_F(InTheGrid, ACellFarFromItsFacetsIsFilled) {
  const auto beside = rod({5, 3, 3}, {5, 3, 3.25}, 1.125);
  Reshaping<3> reshaping(room, {{beside.get()}, {}});
  const Outcome outcome = reshaping.fill(cell_at({3, 3, 3}));
  EXPECT_EQ(outcome.reason, "something is nearer to the cell than its radius");
  EXPECT_EQ(outcome.held_by.size(), 1u);
  EXPECT_EQ(outcome.distance, 1);
  EXPECT_TRUE(reshaping.fill(cell_at({1, 3, 3})).is_made);
}

// A wall vertex leaves the frame of the planes, and the list of walls of a vertex is made before finish()
// makes another frame.
TEST(ThickChanges, ListsOutliveFrames) {
  Cell_soup<2> soup;
  soup.points = {{-3, -0.5}, {0, -0.5}, {3, -0.5}, {3, 0.5}, {-3, 0.5}};
  for (const auto& [a, b, c] : {std::array<std::uint32_t, 3>{0, 1, 4}, {1, 3, 4}, {1, 2, 3}}) {
    soup.add_facet({a, b});
    soup.add_facet({b, c});
    soup.add_facet({c, a});
    soup.end_cell();
  }
  auto channel = Environment<2>::build(soup, {.simplicial = true});
  Body<2> body(channel, {{{-0.25, 0}}, {}, {}, {0.5}});
  Reshaping<2> reshaping(channel, {{&body}, {}}, {.at_contact = At_contact::push});
  const auto number_of = [&](const Point<2>& x) {
    const auto points = channel.snapshot().points();
    return static_cast<std::uint32_t>(std::ranges::find(points, x) - points.begin());
  };
  EXPECT_EQ(reshaping.move(number_of({3, 0.5}), {60, 0.5}).end, Move_end::reached);
  EXPECT_EQ(reshaping.move(number_of({0, -0.5}), {0, 0.2}).end, Move_end::contact);
  reshaping.finish();
  Step_report<2> report;
  Body_counts counts;
  Body_options options;
  options.clearance = false;
  body.step(std::vector<Point<2>>{{-0.25, 0.25}}, options, report, counts);
  EXPECT_EQ(report.contacts.size(), 1u);
  EXPECT_NO_THROW(body.validate());
}

struct Toggled {
  int made = 0, held = 0, inside = 0, missed = 0, false_holds = 0, wrong_holders = 0, too_near = 0;
  int wrong() const { return missed + false_holds + wrong_holders + too_near; }
};

/// The residents that are nearer than their radius to a hull.
template <int D>
std::vector<Resident> nearer_to(const Toggle_world<D>& world, const Hull<D>& hull) {
  std::vector<Resident> result;
  for (std::uint32_t b = 0; b < world.bodies.size(); ++b)
    for (const Thick_part<D>& part : thick_parts(*world.bodies[b]))
      if (!root_is_at_least(shortest_vector<D>(to_hull<D>(part.corners), hull).square, part.radius))
        result.push_back({false, b, part.feature, part.number});
  return result;
}

template <int D>
void judge_shrinking(const Toggle_world<D>& world, const Hull<D>& hull, Toggled& tally, const auto& change) {
  const std::vector<Resident> expected = nearer_to<D>(world, hull);
  const Outcome outcome = change();
  (outcome.is_made ? tally.made : tally.held) += 1;
  tally.missed += outcome.is_made && !expected.empty();
  tally.false_holds += !outcome.is_made && expected.empty();
  // Vertices may be named as well.
  std::vector<Resident> parts;
  std::ranges::copy_if(outcome.held_by, std::back_inserter(parts),
                       [](const Resident& r) { return r.feature != Body_feature::vertex; });
  tally.wrong_holders += !outcome.is_made && parts != expected;
}

template <int D>
void expect_changes_right(bool generic, std::size_t worlds) {
  Toggled tally;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Toggle_world<D> world(number, generic);
    world.populate(0, 6);
    give_radii<D>(world, 0.1);
    if (world.bodies.empty()) continue;
    const Snapshot<D>& s = world.snapshot;
    {
      Reshaping<D> reshaping(world.environment, world.residents());
      for (int i = 0; i < 30; ++i) {
        const Cell c = world.cell();
        const Half_facet f = Snapshot<D>::half_facet(c, world.random.below(s.facet_count(c)));
        if (s.is_solid(c)) {
          const bool is_made = reshaping.excavate(c).is_made;
          EXPECT_TRUE(is_made);
        } else if (s.is_impassable(f)) {
          reshaping.open(f);
        } else if (world.random.chance(0.5)) {
          std::vector<Point<D>> corners;
          for (const std::uint32_t p : s.loop(f)) corners.push_back(s.point(p));
          judge_shrinking<D>(world, to_hull<D>(corners), tally, [&] { return reshaping.close(f); });
        } else {
          std::vector<Point<D>> corners;
          for (const std::uint32_t p : s.view(c).vertices) corners.push_back(s.point(p));
          const int held = tally.held;
          judge_shrinking<D>(world, to_hull<D>(corners), tally, [&] { return reshaping.fill(c); });
          tally.inside += tally.held != held;
        }
      }
    }
    tally.too_near += count_too_near<D>(world);
    EXPECT_EQ(tally.wrong(), 0) << "world " << number;
    if (testing::Test::HasFailure()) break;
  }
  std::printf("%dD: %d made, %d held (%d cells); missed %d, false %d, holders %d, too near %d\n", D,
              tally.made, tally.held, tally.inside, tally.missed, tally.false_holds, tally.wrong_holders,
              tally.too_near);
  if (oracle::is_shortened()) return;
  EXPECT_GT(tally.made, static_cast<int>(worlds) / 2);
  EXPECT_GT(tally.held, static_cast<int>(worlds));
  EXPECT_GT(tally.inside, static_cast<int>(worlds) / 2);
}

TEST(ThickChanges, AppearAmongBodies2D) {
  expect_changes_right<2>(true, some_worlds(40));
  expect_changes_right<2>(false, some_worlds(60));
}
TEST(ThickChanges, AppearAmongBodies3D) {
  expect_changes_right<3>(true, some_worlds(20));
  expect_changes_right<3>(false, some_worlds(30));
}

/// Cuts of tissue and membranes, stitches, and replacements of cells.
template <int D>
void expect_cuts_right(std::size_t worlds) {
  int slit = 0, opened = 0, merged = 0, held = 0, replaced = 0, too_near = 0;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Operations_world<D> world(number, number % 2 == 0);
    give_radii<D>(world, 0.3);
    if (world.bodies.empty()) continue;
    const Snapshot<D>& s = world.snapshot;
    std::vector<std::array<std::uint32_t, 2>> stitches;
    for (int phase = 0; phase < 2; ++phase) {
      Reshaping<D> reshaping(world.environment, world.residents());
      for (int k = 0; k < 10; ++k) {
        const std::size_t kind = world.random.below(3);
        if (kind == 0 && s.cell_count() < 400) {
          std::vector<Point<D>> points(D, middle_of(s, world.cell()));
          for (Point<D>& x : points)
            for (double& c : x) c += world.random.real(-1.5, 1.5);
          const Cut_report report = reshaping.cut(
              blade_along<D>(points), {.opening = std::ldexp(0.02, static_cast<int>(world.random.below(6)))});
          slit += static_cast<int>(report.slit);
          opened += static_cast<int>(report.opened);
          for (const Cut_point& made : report.points)
            if (made.between[0] == made.between[1]) stitches.push_back({made.point, made.between[0]});
        } else if (kind == 1) {
          std::array<std::uint32_t, 2> pair{};
          const auto vertices = s.view(world.cell()).vertices;
          for (std::uint32_t& p : pair) p = vertices[world.random.below(vertices.size())];
          if (!stitches.empty() && world.random.chance(0.5)) {
            pair = stitches.back();
            stitches.pop_back();
          }
          if (pair[0] == pair[1] || !s.is_point(pair[0]) || !s.is_point(pair[1])) continue;
          const Replacement result = reshaping.merge_vertices(pair[0], pair[1]);
          merged += result.is_made;
          held += !result.held_by.empty();
        } else {
          replaced +=
              replace(reshaping, some_replacement<D>(s, world.cell(), world.random, s.cell_count() < 400))
                  .is_made;
        }
      }
      reshaping.finish();
      too_near += count_too_near<D>(world);
      EXPECT_EQ(too_near, 0) << "world " << number;
      if (testing::Test::HasFailure()) return;
    }
  }
  std::printf("%dD: %d facets slit, %d vertices parted, %d merged, %d merges held, %d replacements\n", D,
              slit, opened, merged, held, replaced);
  if (oracle::is_shortened()) return;
  EXPECT_GT(slit, static_cast<int>(worlds) / 10);
  EXPECT_GT(opened, static_cast<int>(worlds) / 20);
  EXPECT_GT(merged, static_cast<int>(worlds) / 20);
  EXPECT_GT(held, static_cast<int>(worlds) / 10);
  EXPECT_GT(replaced, static_cast<int>(worlds) / 4);
}

TEST(ThickChanges, AreCutAndSewn2D) { expect_cuts_right<2>(some_worlds(300)); }
TEST(ThickChanges, AreCutAndSewn3D) { expect_cuts_right<3>(some_worlds(200)); }

}  // namespace
}  // namespace cellwalk::test
