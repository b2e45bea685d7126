// SPDX-License-Identifier: LGPL-3.0-or-later
// The index of boundary facets: what it proves free, against every pair of facets in exact numbers.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/box_grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/kernel/swept_simplex.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "certify_samples.h"

namespace cellwalk {
namespace {

using detail::Boundary_index;
using detail::Box;
using detail::Box_grid;

template <int D>
std::vector<Half_facet> all_boundary_facets(const Snapshot<D>& snapshot) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (snapshot.cell(i) != Cell::none) cells.push_back(snapshot.cell(i));
  return Boundary_index<D>::facets(snapshot, cells);
}

/// True if a boundary facet at a point meets one without it on its way to a target.
template <int D>
bool runs_into_another(const Snapshot<D>& snapshot, std::uint32_t point, const Point<D>& target) {
  const std::vector<Half_facet> facets = all_boundary_facets(snapshot);
  Predicate_counts counts;
  for (const Half_facet w : facets) {
    const auto loop = snapshot.loop(w);
    if (std::find(loop.begin(), loop.end(), point) == loop.end()) continue;
    typename detail::Swept_simplex<D>::Corners still;
    std::size_t n = 0;
    for (const std::uint32_t v : loop)
      if (v != point) still[n++] = snapshot.point(v);
    const detail::Swept_simplex<D> swept(snapshot.point(point), target, still, counts);
    for (const Half_facet f : facets) {
      const auto other = snapshot.loop(f);
      if (std::find(other.begin(), other.end(), point) != other.end()) continue;
      std::vector<Point<D>> polygon;
      for (const std::uint32_t v : other) polygon.push_back(snapshot.point(v));
      if (swept.reaches(polygon, counts)) return true;
    }
  }
  return false;
}

struct Tally {
  std::size_t proved = 0, made = 0, left_open = 0, blocked = 0;
};

/// Vertices of the boundary of a few simplices move about, close to each other.
template <int D>
Tally move_about(const Cell_soup<D>& soup, std::uint64_t seed, int moves, double step) {
  Environment<D> environment = Environment<D>::build(soup);
  const Snapshot<D>& snapshot = environment.snapshot();
  Boundary_index<D> index(snapshot);
  std::vector<std::uint32_t> outer;
  for (const Half_facet f : all_boundary_facets(snapshot))
    for (const std::uint32_t v : snapshot.loop(f)) outer.push_back(v);
  std::sort(outer.begin(), outer.end());
  outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
  Random random(seed);
  Tally tally;
  for (int i = 0; i < moves; ++i) {
    const std::uint32_t v = outer[random.below(outer.size())];
    const double size = random.chance(0.8) ? step : 6 * step;
    Point<D> target = snapshot.point(v);
    for (double& x : target) x += size * random.real(-1, 1);
    const bool is_free = index.is_way_free(snapshot.points(), v, target);
    const bool meets = runs_into_another(snapshot, v, target);
    if (is_free && meets) ADD_FAILURE() << "move " << i << " of point " << v << " is not free";
    tally.blocked += meets;
    bool is_made = false;
    Cell_soup<D> moved = environment.soup();
    moved.points[v] = target;
    const std::string refusal = test::refusal_or_none(moved);
    if (is_free) {
      EXPECT_EQ(refusal.find("reaches across"), std::string::npos) << refusal;
    }
    if (refusal.empty() && !meets) {
      environment.move_vertex(v, target);
      index.follow(snapshot.points(), v);
      is_made = true;
    }
    tally.proved += is_free;
    tally.made += is_made;
    tally.left_open += is_made && !is_free;
  }
  return tally;
}

TEST(BoundaryIndex, ProvesOnlyWhatIsFree2) {
  Cell_soup<2> soup = triangle_grid({.cells = {3, 2}});
  Cell_soup<2> other = triangle_grid({.cells = {3, 2}});
  for (Point<2>& p : other.points) p = p + Vector<2>{0.4, 2.2};
  test::append(soup, other, false);
  Tally all;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Tally one = move_about<2>(soup, seed, 1'500, 0.06);
    all.proved += one.proved, all.made += one.made, all.left_open += one.left_open,
        all.blocked += one.blocked;
  }
  EXPECT_GT(all.made, 2'000u);
  EXPECT_GT(all.blocked, 80u);
  EXPECT_LT(all.left_open * 5, all.made) << "most of what is free is proved so";
}

TEST(BoundaryIndex, ProvesOnlyWhatIsFree3) {
  Cell_soup<3> soup = tetrahedral_grid({.cells = {2, 1, 1}});
  Cell_soup<3> other = tetrahedral_grid({.cells = {2, 1, 1}});
  for (Point<3>& p : other.points) p = p + Vector<3>{0.4, 0.3, 1.15};
  test::append(soup, other, false);
  Tally all;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Tally one = move_about<3>(soup, seed, 700, 0.05);
    all.proved += one.proved, all.made += one.made, all.left_open += one.left_open,
        all.blocked += one.blocked;
  }
  EXPECT_GT(all.made, 600u);
  EXPECT_GT(all.blocked, 80u);
  EXPECT_LT(all.left_open * 4, all.made) << "most of what is free is proved so";
}

/// Two triangles, of which the lower one points to the lowest side of the upper one.
Cell_soup<2> two_triangles() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {2, 0}, {1, 1}, {0, 2}, {2, 2}, {1, 4}};
  add_polygon(soup, std::array<std::uint32_t, 3>{0, 1, 2});
  add_polygon(soup, std::array<std::uint32_t, 3>{3, 4, 5});
  return soup;
}

TEST(BoundaryIndex, IsNotClearOnceSomethingCameNear) {
  const Cell_soup<2> soup = two_triangles();
  const Snapshot<2> snapshot = Snapshot<2>::compile(soup, glue(soup));
  std::vector<Point<2>> points = soup.points;
  Boundary_index<2> index(snapshot);
  const Point<2> below{0, 1.875};
  ASSERT_TRUE(index.is_way_free(points, 3, points[3]));
  index.follow(points, 3);
  ASSERT_TRUE(index.is_way_free(points, 3, below)) << "in its zone";
  points[2] = {1, 2};  // into the side of the other
  index.follow(points, 2);
  EXPECT_FALSE(index.is_way_free(points, 3, below)) << "through the tip";
  EXPECT_FALSE(index.is_way_free(points, 4, {2, 1.875}));
  EXPECT_FALSE(index.is_way_free(points, 0, {-0.125, 0})) << "its facet touches another one";
  points[2] = {1, 1};
  index.follow(points, 2);
  EXPECT_TRUE(index.is_way_free(points, 3, below));
}

TEST(BoundaryIndex, FollowsAnEditThatReplacesFacets) {
  Cell_soup<2> soup = two_triangles();
  Environment<2> environment = Environment<2>::build(soup);
  const Snapshot<2>& snapshot = environment.snapshot();
  Boundary_index<2> index(snapshot);
  const Cell cell = snapshot.cell(1);
  const std::vector<Half_facet> old = Boundary_index<2>::facets(snapshot, std::array{cell});
  ASSERT_EQ(old.size(), 3u);
  const std::vector<Cell> added = environment.insert_point(cell, {1, 3});
  index.replace(snapshot, old, Boundary_index<2>::facets(snapshot, added));
  EXPECT_FALSE(index.is_way_free(snapshot.points(), 2, {1, 3})) << "into the new facets";
  EXPECT_TRUE(index.is_way_free(snapshot.points(), 2, {1, 1.5}));
  std::vector<Half_facet> met = index.meeting(snapshot.points(), {{-1, 1.5}, {3, 2.5}});
  EXPECT_EQ(met.size(), 3u);
  for (const Half_facet f : met) EXPECT_EQ(snapshot.neighbour(f), Cell::none);
}

template <int D>
void boxes_are_found() {
  Random random(5);
  Box_grid<D> grid;
  std::vector<Box<D>> boxes(300);
  const auto random_box = [&] {
    Box<D> box;
    const double size = std::ldexp(1.0, static_cast<int>(random.below(12)) - 8);
    Point<D> x;
    for (double& k : x) k = random.real(-4, 4);
    box.extend(x);
    for (double& k : x) k += random.chance(0.1) ? size : size * random.real(0, 1);
    box.extend(x);
    return box;
  };
  std::vector<bool> is_there(boxes.size(), false);
  std::size_t found_in_all = 0;
  for (int i = 0; i < 4'000; ++i) {
    const auto k = static_cast<std::uint32_t>(random.below(boxes.size()));
    if (is_there[k] && random.chance(0.2)) {
      grid.remove(k);
      is_there[k] = false;
    } else {
      boxes[k] = random_box();
      grid.set(k, boxes[k]);
      is_there[k] = true;
    }
    const Box<D> asked = random_box();
    std::vector<std::uint32_t> found, expected;
    grid.find(asked, found);
    std::sort(found.begin(), found.end());
    for (std::uint32_t j = 0; j < boxes.size(); ++j)
      if (is_there[j] && boxes[j].meets(asked)) expected.push_back(j);
    ASSERT_EQ(found, expected) << i;
    found_in_all += found.size();
  }
  EXPECT_GT(found_in_all, 1'000u);
}

TEST(BoxGrid, FindsAllBoxesThatMeet2) { boxes_are_found<2>(); }
TEST(BoxGrid, FindsAllBoxesThatMeet3) { boxes_are_found<3>(); }

TEST(BoxGrid, FindsBoxesOfAnySize) {
  Box_grid<2> grid;
  std::vector<Box<2>> boxes;
  for (const double scale : {0.0, 1e-300, 1e-20, 1.0, 1e20, 1e300, 1.7e308})
    for (const double x : {0.0, 1.0, 1e18}) {
      Box<2> box;
      box.extend(Point<2>{x - scale, x - scale});
      box.extend(Point<2>{x + scale, x + scale});
      grid.set(static_cast<std::uint32_t>(boxes.size()), box);
      boxes.push_back(box);
    }
  for (const Box<2>& asked : boxes) {
    std::vector<std::uint32_t> found, expected;
    grid.find(asked, found);
    std::sort(found.begin(), found.end());
    for (std::uint32_t j = 0; j < boxes.size(); ++j)
      if (boxes[j].meets(asked)) expected.push_back(j);
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace cellwalk
