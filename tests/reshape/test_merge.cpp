// SPDX-License-Identifier: LGPL-3.0-or-later
// Points merged across a gap, with what lies beside it.
#include <cellwalk/body/body.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "grids.h"
#include "oracle/seed.h"
#include "tissue_block.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

using test::add_membrane, test::blade, test::point_at, test::simplex_grid, test::solid_parts, test::tissue;

/// The points that a cut took back, the last one first, and those that they were taken back from.
std::vector<std::array<std::uint32_t, 2>> stitches(const Cut_report& report) {
  std::vector<std::array<std::uint32_t, 2>> result;
  for (auto made = report.points.rbegin(); made != report.points.rend(); ++made)
    if (made->between[0] == made->between[1]) result.push_back({made->point, made->between[0]});
  return result;
}

template <int D>
std::size_t walls_inside_solid(const Snapshot<D>& snapshot) {
  std::size_t walls = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || !snapshot.is_solid(c)) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      walls += snapshot.neighbour(f) != Cell::none && snapshot.is_solid(snapshot.neighbour(f)) &&
               snapshot.is_impassable(f);
    }
  }
  return walls;
}

/// Cuts tissue, and sews it up again.
template <int D>
void sew(Environment<D> environment, const Blade<D>& blade) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const Certificate before = environment.certify();
  const std::size_t parts = solid_parts(snapshot).size();
  Reshaping<D> reshaping(environment, {});
  const Cut_report report = reshaping.cut(blade, {.opening = 0.05});
  const auto pairs = stitches(report);
  ASSERT_GE(pairs.size(), 4u);
  for (const auto& [point, onto] : pairs) {
    const Replacement merged = reshaping.merge_vertices(point, onto);
    ASSERT_TRUE(merged.is_made) << merged.reason;
    EXPECT_EQ(merged.point, point);
    EXPECT_FALSE(snapshot.is_point(point));
    EXPECT_TRUE(merged.held_by.empty());
  }
  reshaping.finish();
  const Certificate after = environment.certify();
  EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
  EXPECT_NEAR(after.free_volume, before.free_volume, 1e-9 * before.volume);
  EXPECT_EQ(after.vertices, before.vertices + report.points.size() - pairs.size());
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(solid_parts(snapshot).size(), parts);
  EXPECT_EQ(walls_inside_solid(snapshot), 0u) << "it heals";
}

TEST(Merge, SewsUpACutInThePlane) {
  sew<2>(tissue<2>(8, 6), blade<2>({{4.1, 7}, {4.3, 1.4}}));
  sew<2>(tissue<2>(8, 6, 0), blade<2>({{4, 7}, {4, 1.5}}));
}

TEST(Merge, SewsUpACutInSpace) {
  sew<3>(tissue<3>(5, 4), blade<3>({{2.4, 0.6, 4.6}, {2.6, 4.4, 4.6}, {2.6, 4.4, 1.6}, {2.4, 0.6, 1.6}}));
  sew<3>(tissue<3>(5, 4, 0), blade<3>({{2, 1, 5}, {2, 4, 5}, {2, 4, 1}, {2, 1, 1}}));
}

/// The free cells that have both points of a pair.
template <int D>
std::vector<Cell> gap_of(Environment<D>& environment, const std::array<std::uint32_t, 2>& pair) {
  std::vector<Cell> cells = environment.cells_around(pair[0]);
  std::erase_if(cells, [&](Cell c) {
    const auto own = environment.snapshot().view(c).vertices;
    return environment.snapshot().is_solid(c) || std::ranges::find(own, pair[1]) == own.end();
  });
  return cells;
}

TEST(Merge, IsRefusedWhileSomethingLiesInTheGap) {
  auto environment = tissue<3>(5, 4);
  const Snapshot<3>& snapshot = environment.snapshot();
  std::array<std::uint32_t, 2> pair{};
  {
    Reshaping<3> reshaping(environment, {});
    pair =
        stitches(reshaping.cut(blade<3>({{2.4, 0.6, 4.6}, {2.6, 4.4, 4.6}, {2.6, 4.4, 1.6}, {2.4, 0.6, 1.6}}),
                               {.opening = 0.05}))[0];
  }
  const Point<3> inside = test::middle_of(snapshot, gap_of(environment, pair).front());
  Particle<3> particle = *Locator<3>(snapshot).particle_at(inside);
  {
    Reshaping<3> reshaping(environment, {{}, {std::span(&particle, 1)}});
    const Replacement held = reshaping.merge_vertices(pair[0], pair[1]);
    EXPECT_FALSE(held.is_made);
    EXPECT_EQ(held.reason, "something lies in the free cells around the point");
    ASSERT_EQ(held.held_by.size(), 1u);
    EXPECT_TRUE(held.held_by[0].is_particle);
    EXPECT_TRUE(snapshot.is_point(pair[0]));
  }
  environment.certify();
  particle = *Locator<3>(snapshot).particle_at({4.5, 4.5, 4.8});
  Reshaping<3> reshaping(environment, {{}, {std::span(&particle, 1)}});
  EXPECT_TRUE(reshaping.merge_vertices(pair[0], pair[1]).is_made);
  reshaping.finish();
  environment.certify();
}

/// A wall that stays, but turns, would sweep a vertex in a cell that stays, too.
TEST(Merge, IsRefusedForWhatLiesBesideTheGap) {
  // Points u, w, a, b, c; the cell ucb stays and becomes wcb.
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {8, 0}, {4, -8}, {4, 8}, {-8, 4}, {-8, -8}};
  const auto triangle = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, bool is_solid) {
    soup.add_facet({i, j});
    soup.add_facet({j, k});
    soup.add_facet({k, i});
    soup.end_cell(is_solid);
  };
  triangle(0, 1, 3, false);
  triangle(0, 2, 1, false);
  triangle(0, 3, 4, false);
  triangle(0, 4, 5, true);
  triangle(0, 5, 2, true);
  auto environment = Environment<2>::build(std::move(soup));
  Particle<2> particle = *Locator<2>(environment.snapshot()).particle_at({-3, 2});
  Particle<2> far = *Locator<2>(environment.snapshot()).particle_at({3, 5.5});
  for (Particle<2>* p : {&particle, &far}) {
    Reshaping<2> reshaping(environment, {{}, {std::span(p, 1)}});
    EXPECT_EQ(reshaping.merge_vertices(0, 1).held_by.size(), 1u);
  }
  Reshaping<2> reshaping(environment, {});
  EXPECT_TRUE(reshaping.merge_vertices(0, 1).is_made);
  reshaping.finish();
  environment.certify();
  EXPECT_NE(Locator<2>(environment.snapshot()).locate({-3, 2}).status, Location_status::free) << "swept";
}

TEST(Merge, IsRefusedForABodyWithFaces) {
  auto environment = tissue<3>(5, 4, 0);
  const Snapshot<3>& snapshot = environment.snapshot();
  std::vector<std::array<std::uint32_t, 2>> pairs;
  {
    Reshaping<3> reshaping(environment, {});
    pairs =
        stitches(reshaping.cut(blade<3>({{2, 1, 5}, {2, 4, 5}, {2, 4, 1}, {2, 1, 1}}), {.opening = 0.25}));
  }
  const auto pair = std::ranges::find_if(pairs, [&](const auto& x) {
    return snapshot.point(x[1]) == Point<3>{2, 2, 4};
  });
  ASSERT_NE(pair, pairs.end());
  // A triangle that hangs into the gap with one corner.
  const Point<3> inside = test::middle_of(snapshot, gap_of(environment, *pair).front());
  Body_soup<3> soup;
  soup.points = {inside, inside, inside};
  for (const std::size_t k : {1, 2}) soup.points[k][2] = 4.6;
  soup.points[1][1] -= 0.02;
  soup.points[2][1] += 0.02;
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  soup.faces = {{0, 1, 2}};
  Body<3> body(snapshot, Locator<3>(snapshot), soup);
  Body_counts counts;
  Step_report<3> report;
  body.step(soup.points, {.sweep = Sweep::faces}, report, counts);
  Reshaping<3> reshaping(environment, {{&body}, {}});
  const Replacement held = reshaping.merge_vertices((*pair)[0], (*pair)[1]);
  EXPECT_FALSE(held.is_made);
  for (const auto feature : {Body_feature::vertex, Body_feature::edge, Body_feature::face})
    EXPECT_TRUE(std::ranges::any_of(held.held_by, [&](const Resident& r) { return r.feature == feature; }));
  EXPECT_TRUE(std::ranges::is_sorted(held.held_by));
  reshaping.finish();
  environment.certify();
}

TEST(Merge, KeepsMembranes) {
  for (const bool of_the_membrane : {false, true}) {
    auto environment = simplex_grid<3>(4);
    add_membrane(environment, 2);
    const std::uint32_t low = point_at<3>(environment, {2, 2, 2}), high = point_at<3>(environment, {2, 2, 3});
    EXPECT_EQ(environment.certify().components, 2u);
    Reshaping<3> reshaping(environment, {});
    const Replacement merged =
        of_the_membrane ? reshaping.merge_vertices(low, high) : reshaping.merge_vertices(high, low);
    EXPECT_TRUE(merged.is_made) << merged.reason;
    reshaping.finish();
    EXPECT_EQ(environment.certify().components, 2u);
    const Locator<3> locator(environment.snapshot());
    Particle<3> particle = *locator.particle_at({2.1, 2.15, 3.8});
    Walk_counts counts;
    const auto met = move(environment.snapshot(), particle, Point<3>{2.1, 2.15, 0.5}, counts);
    ASSERT_EQ(met.status, Walk_status::contact);
    EXPECT_EQ(met.contact->point[2] > 2.5, of_the_membrane) << "the membrane is drawn up to the other point";
  }
}

TEST(Merge, RefusesWhatIsNoGap) {
  auto environment = tissue<2>(4, 2, 0);
  const auto at = [&](double x, double y) { return point_at<2>(environment, {x, y}); };
  Reshaping<2> reshaping(environment, {});
  EXPECT_EQ(reshaping.merge_vertices(at(2, 1), at(3, 1)).reason, "a solid cell has both points");
  EXPECT_EQ(reshaping.merge_vertices(at(2, 3), at(2, 1)).reason, "no free cell has both points");
  EXPECT_EQ(reshaping.merge_vertices(at(0, 3), at(1, 3)).reason, "the boundary has the point");
  EXPECT_EQ(reshaping.merge_vertices(at(2, 3), at(2, 3) + 1).is_made, true);
  EXPECT_THROW(reshaping.merge_vertices(at(1, 3), at(1, 3)), Error);
  EXPECT_THROW(reshaping.merge_vertices(1000, at(1, 3)), Error);
  EXPECT_THROW(reshaping.merge_vertices(at(1, 3), 1000), Error);
  reshaping.finish();
  EXPECT_THROW(reshaping.merge_vertices(at(1, 3), at(2, 2)), Error);
  auto frozen = simplex_grid<2>(3, {.keep_map = false});
  Reshaping<2> of_frozen(frozen, {});
  EXPECT_THROW(of_frozen.merge_vertices(5, 6), Error);
}

TEST(Merge, RefusesFlatCells) {
  auto environment = tissue<2>(4, 2, 0);
  Reshaping<2> reshaping(environment, {});
  // One step further, a point would pass over cells that stay.
  const std::uint32_t u = point_at<2>(environment, {1, 3}), onto = point_at<2>(environment, {2, 3});
  ASSERT_TRUE(reshaping.merge_vertices(u, onto).is_made);
  std::size_t flat = 0;
  for (const double x : {0, 3, 4})
    for (const double y : {2, 4}) {
      const Replacement merged = reshaping.merge_vertices(onto, point_at<2>(environment, {x, y}));
      if (merged.is_made) break;
      flat += merged.reason == "a cell would be flat or inverted";
      EXPECT_TRUE(merged.cells.empty());
    }
  EXPECT_GT(flat, 0u);
  reshaping.finish();
  environment.certify();
}

/// Pairs of points merged at random in tissue that was cut, among bodies: after each, all is certified.
template <int D>
void merge_at_random(std::uint64_t seed, std::size_t& made, std::size_t& held) {
  constexpr std::uint32_t size = D == 2 ? 9 : 5;
  auto environment = tissue<D>(size, 0.6 * size, seed % 2 == 0 ? 0 : 0.15, seed);
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(oracle::reseeded(seed));
  std::vector<Particle<D>> particles;
  const auto scatter = [&] {
    particles.clear();
    const Locator<D> locator(snapshot);
    while (particles.size() < 12) {
      Point<D> x;
      for (double& c : x) c = random.real(0, size);
      x[0] = random.real(0.4, 0.6) * size;
      if (const auto p = locator.particle_at(x)) particles.push_back(*p);
    }
  };
  Point<D> high, low;
  high.fill(0.3 * size);
  low = high;
  high[0] = low[0] = 0.5 * size + random.real(-0.3, 0.3);
  high[D - 1] = 0.8 * size;
  low[D - 1] = 0.2 * size;
  std::vector<Point<D>> corners{high, low};
  if constexpr (D == 3) {
    corners.push_back(low);
    corners.back()[1] = 0.8 * size;
    corners.push_back(high);
    corners.back()[1] = 0.8 * size;
  }
  std::vector<std::array<std::uint32_t, 2>> pairs;
  {
    Reshaping<D> reshaping(environment, {});
    pairs = stitches(reshaping.cut(blade_along<D>(corners), {.opening = 0.2}));
  }
  while (!pairs.empty()) {
    scatter();
    const std::size_t k = random.below(pairs.size());
    Reshaping<D> reshaping(environment, {{}, {particles}});
    const Replacement merged = reshaping.merge_vertices(pairs[k][0], pairs[k][1]);
    reshaping.finish();
    made += merged.is_made;
    held += !merged.held_by.empty();
    if (merged.held_by.empty()) pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(k));
    ASSERT_NO_THROW(environment.certify()) << "seed " << seed;
    const Locator<D> locator(snapshot);
    for (const Particle<D>& p : particles)
      ASSERT_NE(locator.locate(p.position).status, Location_status::solid);
  }
}

template <int D>
void merge_many(std::size_t worlds) {
  std::size_t made = 0, held = 0;
  for (std::uint64_t seed = 0; seed < worlds && !testing::Test::HasFailure(); ++seed)
    merge_at_random<D>(seed, made, held);
  std::printf("%dD: %zu pairs of points merged, %zu held\n", D, made, held);
  EXPECT_GT(made, worlds);
  EXPECT_GT(held, 0u);
}

TEST(MergeSoak, InThePlane) { merge_many<2>(std::max<std::size_t>(oracle::scaled_count(20), 6)); }
TEST(MergeSoak, InSpace) { merge_many<3>(std::max<std::size_t>(oracle::scaled_count(8), 4)); }

}  // namespace
}  // namespace cellwalk
