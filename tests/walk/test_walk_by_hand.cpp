// SPDX-License-Identifier: LGPL-3.0-or-later
// Walk and locate where the answer is known by heart: every strategy, the cells crossed, there and back.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/strategy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "oracle/squares_and_cubes.h"

namespace cellwalk {
namespace {

using oracle::make_cubes;
using oracle::make_squares;
using oracle::set_wall;
using Cells = std::vector<std::uint32_t>;

constexpr Walk_strategy strategies[] = {Walk_strategy::certified, Walk_strategy::exit_rule,
                                        Walk_strategy::predictive_simplex};

/// A walk with the indices of the cells it visited.
template <int D>
struct Way {
  Walk_result<D> result;
  Cells cells;
};

template <int D>
class Scene {
 public:
  explicit Scene(const Cell_soup<D>& soup)
      : snapshot_(Snapshot<D>::compile(soup, glue(soup))), locator_(snapshot_) {}

  const Snapshot<D>& snapshot() const { return snapshot_; }
  Location<D> locate(const Point<D>& p) const { return locator_.locate(p); }

  /// Walks with every strategy and expects the same of each.
  Way<D> walk(std::uint32_t cell, const Point<D>& from, const Point<D>& to) const {
    Way<D> first;
    for (const Walk_strategy strategy : strategies) {
      Particle<D> particle;
      particle.position = from;
      particle.cell = snapshot_.cell(cell);
      particle.dimension = locator_.locate(from).dimension;
      Walk_counts counts;
      std::vector<Cell> visited;
      Way<D> way{cellwalk::walk(snapshot_, particle, to, counts, strategy, {&visited}), {}};
      for (Cell c : visited) way.cells.push_back(snapshot_.index(c));
      EXPECT_EQ(counts.walks, 1u);
      if (strategy == strategies[0]) {
        first = way;
        continue;
      }
      EXPECT_EQ(way.result.status, first.result.status);
      EXPECT_EQ(way.result.dimension, first.result.dimension);
      EXPECT_EQ(way.result.contact.has_value(), way.result.status == Walk_status::contact);
      if (way.result.contact && first.result.contact) {
        EXPECT_EQ(way.result.contact->time, first.result.contact->time);
      }
      EXPECT_EQ(way.cells, first.cells);
    }
    return first;
  }

  void expect_there_and_back(const Cells& cells, const Point<D>& from, const Point<D>& to) const {
    const Way<D> there = walk(cells.front(), from, to), back = walk(cells.back(), to, from);
    EXPECT_EQ(there.result.status, Walk_status::arrived);
    EXPECT_EQ(there.cells, cells);
    EXPECT_EQ(back.result.status, Walk_status::arrived);
    EXPECT_EQ(back.cells, Cells(cells.rbegin(), cells.rend()));
  }

  Contact<D> contact(std::uint32_t cell, const Point<D>& from, const Point<D>& to) const {
    const Way<D> way = walk(cell, from, to);
    EXPECT_EQ(way.result.status, Walk_status::contact);
    return way.result.contact.value();
  }

 private:
  Snapshot<D> snapshot_;
  Locator<D> locator_;
};

TEST(WalkByHand, CrossesTheSameCellsThereAndBack) {
  const Scene<2> plane(make_squares(4, 2));
  plane.expect_there_and_back({0, 1, 2, 6, 7}, {0.5, 0.5}, {3.5, 1.25});
  plane.expect_there_and_back({0, 5}, {0.5, 0.5}, {1.5, 1.5});  // through a vertex
  const Scene<3> space(make_cubes(2, 2, 2));
  space.expect_there_and_back({0, 1, 3, 7}, {0.5, 0.25, 0.125}, {1.75, 1.5, 1.25});
  space.expect_there_and_back({0, 3}, {0.5, 0.5, 0.25}, {1.5, 1.5, 0.75});  // through an edge
  space.expect_there_and_back({0, 7}, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});    // through a vertex
  space.expect_there_and_back({2, 5}, {0.5, 1.5, 0.5}, {1.5, 0.5, 1.5});
}

TEST(WalkByHand, ReportsTheWallItMeets) {
  Cell_soup<3> soup = make_cubes(2, 2, 2);
  set_wall(soup, 0, 1);
  set_wall(soup, 0, 2);
  const Scene<3> scene(soup);
  const Contact<3> facet = scene.contact(0, {0.5, 0.5, 0.5}, {1.5, 0.75, 0.5});
  EXPECT_EQ(facet.time, 0.5);
  EXPECT_EQ(facet.point, (Point<3>{1, 0.625, 0.5}));
  EXPECT_EQ(facet.normal, (Vector<3>{-1, 0, 0}));
  EXPECT_EQ(facet.kind, Contact_kind::facet);
  EXPECT_EQ(scene.snapshot().index(facet.cell), 0u);
  EXPECT_TRUE(scene.snapshot().is_impassable(facet.facet));
  EXPECT_EQ(scene.snapshot().index(scene.snapshot().neighbour(facet.facet)), 1u);
  const Contact<3> edge = scene.contact(0, {0.5, 0.5, 0.25}, {1.5, 1.5, 0.75});
  EXPECT_EQ(edge.time, 0.5);
  EXPECT_EQ(edge.kind, Contact_kind::edge);
  set_wall(soup, 0, 4);
  const Contact<3> vertex = Scene<3>(soup).contact(0, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  EXPECT_EQ(vertex.time, 0.5);
  EXPECT_EQ(vertex.point, (Point<3>{1, 1, 1}));
  EXPECT_EQ(vertex.kind, Contact_kind::vertex);
  const Contact<3> boundary = Scene<3>(soup).contact(7, {1.5, 1.5, 1.5}, {1.5, 3.5, 1.5});
  EXPECT_EQ(boundary.time, 0.25);
  EXPECT_EQ(boundary.normal, (Vector<3>{0, -1, 0}));
}

TEST(WalkByHand, TouchesWallsFreely) {
  Cell_soup<3> soup = make_cubes(2, 1, 1);
  set_wall(soup, 0, 1);
  const Scene<3> scene(soup);
  EXPECT_EQ(scene.walk(0, {0.5, 0.5, 0.5}, {1, 0.5, 0.5}).result.dimension, 2) << "up to the wall";
  EXPECT_EQ(scene.walk(0, {0.5, 0.5, 0.5}, {1, 1, 0.5}).result.dimension, 1) << "into its rim";
  EXPECT_EQ(scene.walk(0, {0.5, 0.5, 0.5}, {1, 1, 1}).result.dimension, 0) << "into its corner";
  scene.expect_there_and_back({0}, {1, 0.25, 0.25}, {1, 0.75, 0.5});
  scene.expect_there_and_back({1}, {1, 0, 0}, {1, 1, 1});
  EXPECT_EQ(scene.contact(1, {1, 0.5, 0.5}, {0.5, 0.5, 0.5}).time, 0)
      << "from the other side of the membrane";
  EXPECT_EQ(scene.contact(0, {1, 1, 1}, {1.5, 1.5, 1.5}).time, 0) << "out of the corner";
  EXPECT_EQ(scene.walk(1, {1, 0.5, 0.5}, {1, 0.5, 0.5}).cells, Cells{1}) << "no motion at all";
}

TEST(WalkByHand, PassesARimOnAFixedSide) {
  Cell_soup<2> soup = make_squares(2, 2);
  set_wall(soup, 0, 2);
  const Scene<2> scene(soup);
  EXPECT_EQ(scene.walk(2, {0.25, 1}, {1.75, 1}).result.status, Walk_status::arrived);
  const Way<2> onto = scene.walk(1, {1.75, 1}, {0.25, 1});
  EXPECT_EQ(onto.result.status, Walk_status::arrived);
  ASSERT_EQ(onto.cells.size(), 2u);
  EXPECT_TRUE(onto.cells.back() == 0 || onto.cells.back() == 2);
  EXPECT_EQ(scene.walk(1, {1.75, 1}, {0.25, 1}).cells, onto.cells);
}

TEST(WalkByHand, MeetsPinchedVerticesAsWalls) {
  // Squares 1 and 2 of 2 x 2 are left out: 0 and 3 meet in one vertex only.
  Cell_soup<2> soup;
  const Cell_soup<2> all = make_squares(2, 2);
  soup.points = all.points;
  for (const std::uint32_t c : {0u, 3u}) {
    for (std::size_t f = all.cell_begin[c]; f < all.cell_begin[c + 1]; ++f) soup.add_facet(all.facet(f));
    soup.end_cell();
  }
  const Scene<2> scene(soup);
  const Contact<2> contact = scene.contact(0, {0.5, 0.5}, {1.5, 1.5});
  EXPECT_EQ(contact.time, 0.5);
  EXPECT_EQ(contact.kind, Contact_kind::vertex);
  const Location<2> pinch = scene.locate({1, 1});
  EXPECT_EQ(pinch.cells.size(), 2u);
  EXPECT_EQ(pinch.sides.size(), 2);
  EXPECT_EQ(pinch.dimension, 0);
}

TEST(WalkByHand, PassesAVertexInTheMiddleOfAnEdge) {
  // A square cell whose upper edge is cut by two vertices on it, below three cells.
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {0, 1}, {0, 2}, {1, 2}, {2, 2}, {3, 2}};
  add_polygon(soup, std::array<std::uint32_t, 6>{0, 1, 2, 3, 4, 5});
  add_polygon(soup, std::array<std::uint32_t, 4>{5, 4, 7, 6});
  add_polygon(soup, std::array<std::uint32_t, 4>{4, 3, 8, 7});
  add_polygon(soup, std::array<std::uint32_t, 4>{3, 2, 9, 8});
  const Scene<2> scene(soup);
  scene.expect_there_and_back({0, 2}, {1.5, 0.5}, {1.5, 1.5});
  scene.expect_there_and_back({0, 2}, {0.5, 0.5}, {1.5, 1.5});
  scene.expect_there_and_back({0, 1}, {1.5, 0.5}, {0.5, 1.5});
  EXPECT_EQ(scene.walk(0, {1.5, 0.5}, {1, 1}).result.dimension, 0);
  EXPECT_EQ(scene.walk(0, {1.5, 0.5}, {1.5, 1}).result.dimension, 1);
}

TEST(WalkByHand, KeepsExactInBadPositions) {
  const Scene<3> scene(make_cubes(3, 3, 3));
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(scene.walk(13, {1.5, 1.5, 1.5}, {above, 1.5, 1.5}).cells, Cells{13});
  EXPECT_EQ(scene.walk(13, {1.5, 1.5, 1.5}, {below, 1.5, 1.5}).cells, (Cells{13, 12}));
  EXPECT_EQ(scene.walk(13, {above, above, above}, {below, below, below}).cells, (Cells{13, 0}));
  EXPECT_EQ(scene.walk(0, {tiny, 0.5, 0.5}, {0, 0.5, 0.5}).result.dimension, 2);
  const Contact<3> far = scene.contact(0, {0, 0.5, 0.5}, {-1e300, 0.5, 0.5});
  EXPECT_EQ(far.time, 0);
  EXPECT_NEAR(scene.contact(13, {1.5, 1.5, 1.5}, {1e6, 1.5, 1.5}).time, 1.5 / (1e6 - 1.5), 1e-21);
}

TEST(LocateByHand, KnowsSolidOutsideAndDisconnectedSpace) {
  Cell_soup<2> soup = make_squares(5, 1);
  soup.solid[2] = 1;
  set_wall(soup, 1, 2);
  set_wall(soup, 2, 3);
  for (std::size_t f = soup.cell_begin[2]; f < soup.cell_begin[3]; ++f) soup.impassable[f] = 1;
  const Scene<2> scene(soup);
  EXPECT_EQ(scene.locate({2.5, 0.5}).status, Location_status::solid);
  EXPECT_EQ(scene.locate({2.5, 1}).status, Location_status::solid);
  EXPECT_EQ(scene.locate({2.5, 2}).status, Location_status::outside);
  EXPECT_EQ(scene.locate({-0x1p-1074, 0.5}).status, Location_status::outside);
  const Location<2> left = scene.locate({2, 0.5}), right = scene.locate({3, 1});
  EXPECT_EQ(scene.snapshot().index(left.cell), 1u);
  EXPECT_EQ(left.sides.size(), 1);
  EXPECT_EQ(left.dimension, 1);
  EXPECT_EQ(scene.snapshot().index(right.cell), 3u);
  EXPECT_EQ(right.dimension, 0);
  const Location<2> between = scene.locate({1, 0.5});
  EXPECT_EQ(between.cells.size(), 2u);
  EXPECT_EQ(between.sides.size(), 1);
}

// Rounded signs put a vertex outside of its own cells. A motion that ends where it starts then looks for
// another cell along a line that is none: it ends all the same, in some cell.
TEST(WalkByHand, RoundedMotionsMayEndWhereTheyStart) {
  Cell_soup<3> soup = make_cubes(2, 2, 2);
  for (Point<3>& p : soup.points)
    p = {0.9 * p[0] + 0.1 * p[1], 0.7 * p[1] - 0.2 * p[2], 1.1 * p[2] + 0.3 * p[0]};
  const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
  std::size_t searches = 0;
  for (std::size_t c = 0; c < snapshot.cell_count(); ++c)
    for (std::size_t v = 0; v < 8; ++v) {
      const Point<3> place = snapshot.view(snapshot.cell(c)).point(v);
      Walk_counts counts;
      const auto result = walk<Float>(snapshot, Particle<3>{place, snapshot.cell(c), 0}, place, counts);
      searches += counts.star_searches;
      EXPECT_LT(snapshot.index(result.cell), snapshot.cell_count());
    }
  EXPECT_GT(searches, 10u);
}

}  // namespace
}  // namespace cellwalk
