// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes among things that are registered on borders: whether they are made, and what holds them, depends on
// the sides on which things are, and not on the cells that stand for these. Judged by the same geometry in
// other listings.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "oracle/seed.h"
#include "reshape/grids.h"
#include "reshape/listing_twins.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

struct Listing_tally {
  std::size_t worlds = 0, in_other_cells = 0, changes = 0, made = 0, held = 0;
  std::size_t slits = 0, split = 0, refused = 0;
};

/// A grid on a lattice, with tissue below, a membrane across the middle, and some other walls.
template <int D>
Cell_soup<D> walled_grid(Random& random) {
  constexpr std::uint32_t size = D == 2 ? 4 : 3;
  auto environment = test::simplex_grid<D>(size);
  const Snapshot<D>& s = environment.snapshot();
  const double walls = random.real(0, 0.1);
  for (std::size_t i = 0; i < s.cell_slots(); ++i) {
    const bool is_low = test::middle_of(s, s.cell(i))[D - 1] < 1;
    if (is_low && random.chance(0.7)) environment.fill(s.cell(i));
    for (std::size_t k = 0; k <= D; ++k)
      if (random.chance(walls)) environment.set_impassable(Snapshot<D>::half_facet(s.cell(i), k), true);
  }
  test::add_membrane<D>(environment, 2);
  return environment.soup();
}

template <int D>
Point<D> lattice_place(Random& random) {
  constexpr std::uint32_t size = D == 2 ? 4 : 3;
  Point<D> x;
  for (double& c : x) c = static_cast<double>(random.below(4 * size + 1)) / 4;
  if (random.chance(0.3))
    for (double& c : x) c = std::round(c);
  return x;
}

template <int D>
void populate(test::Listing_twins<D>& twins, Random& random) {
  for (int k = 0; k < 12 && twins.one.particles.size() < 5; ++k) twins.add_particle(lattice_place<D>(random));
  for (int k = 0; k < 12 && twins.one.bodies.size() < 3; ++k) {
    Body_soup<D> soup;
    const std::size_t n = 2 + random.below(2);
    for (std::size_t i = 0; i < n; ++i) {
      soup.points.push_back(i == 0 ? lattice_place<D>(random) : soup.points.back());
      if (i != 0)
        for (double& c : soup.points.back()) c += (static_cast<double>(random.below(5)) - 2) / 4;
    }
    for (std::uint32_t i = 1; i < n; ++i) soup.edges.push_back({i - 1, i});
    twins.add_body(soup);
  }
}

/// The same change of both; a mirrored one counts its cells otherwise.
template <int D, class Change>
void change_both(test::Listing_twins<D>& twins, Reshaping<D>& here, Reshaping<D>& there, Listing_tally& tally,
                 const Change& change) {
  const auto a = change(twins.one, here), b = change(twins.other, there);
  if (!a || !b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    return;
  }
  ++tally.changes;
  tally.made += a->is_made;
  tally.held += !a->held_by.empty();
  ASSERT_EQ(a->is_made, b->is_made) << a->reason << " | " << b->reason;
  EXPECT_EQ(a->reason, b->reason);
  EXPECT_EQ(a->held_by, b->held_by);
}

template <int D>
void change_somewhere(test::Listing_twins<D>& twins, Reshaping<D>& here, Reshaping<D>& there, Random& random,
                      Listing_tally& tally) {
  const Snapshot<D>& s = twins.one.snapshot();
  Cell cell = Cell::none;
  if (!twins.one.particles.empty() && random.chance(0.4))
    cell = twins.one.particles[random.below(twins.one.particles.size())].cell;
  else if (!twins.one.bodies.empty() && random.chance(0.6))
    cell = twins.one.bodies[random.below(twins.one.bodies.size())]->particles()[0].cell;
  while (cell == Cell::none) cell = s.cell(random.below(s.cell_slots()));
  const std::vector<std::uint32_t> points = twins.one.points_of(cell);
  const std::uint32_t u = points[random.below(D + 1)];
  std::uint32_t v = u;
  while (v == u) v = points[random.below(D + 1)];
  const auto as_change = [](const Replacement& r) { return Outcome{r.is_made, r.reason, r.held_by}; };
  const std::size_t kind = random.below(4);
  change_both(twins, here, there, tally,
              [&](test::Listed_world<D>& world, Reshaping<D>& by) -> std::optional<Outcome> {
                const auto own = world.find(points);
                if (!own) return {};
                const Half_facet facet = world.facet_off(*own, u);
                switch (kind) {
                  case 0:
                    return world.snapshot().is_impassable(facet) ? by.open(facet) : by.close(facet);
                  case 1:
                    return world.snapshot().is_solid(*own) ? by.excavate(*own) : by.fill(*own);
                  case 2:
                    return as_change(by.merge_vertices(u, v));
                  default: {
                    const Point<D>& x = world.snapshot().point(u);
                    return as_change(by.split_edge(u, v, x + 0.5 * (world.snapshot().point(v) - x)));
                  }
                }
              });
}

template <int D>
Blade<D> some_blade(Random& random, test::Listing listing) {
  const double x = static_cast<double>(4 + random.below(8)) / 4 + (random.chance(0.5) ? 0.1 : 0);
  const double y = x + (static_cast<double>(random.below(5)) - 2) / 4;
  std::vector<Point<D>> points;
  if constexpr (D == 2)
    points = {{x, 3.5}, {y, random.chance(0.5) ? 1.5 : 0.25}};
  else
    points = {{x, -1, 2.5}, {x, 4, 2.5}, {x, 4, 0.5}, {x, random.chance(0.5) ? -1.0 : 1.5, 0.5}};
  for (Point<D>& p : points) p = test::listed<D>(p, listing);
  // What was in front of it is so in the mirror.
  if (listing == test::Listing::mirrored) std::reverse(points.begin(), points.end());
  return blade_along<D>(points);
}

template <int D>
void cut_both(Reshaping<D>& here, Reshaping<D>& there, test::Listing listing, Random& random,
              Listing_tally& tally) {
  const Random before = random;
  const Cut_report a = here.cut(some_blade<D>(random, test::Listing::other_order), {.opening = 0.125});
  random = before;
  const Cut_report b = there.cut(some_blade<D>(random, listing), {.opening = 0.125});
  tally.slits += a.slit;
  tally.split += a.split;
  tally.refused += a.refused();
  EXPECT_EQ(a.edges, b.edges);
  ASSERT_EQ(a.split, b.split);
  ASSERT_EQ(a.slit, b.slit);
  EXPECT_EQ(a.snapped, b.snapped);
  EXPECT_EQ(a.facets, b.facets);
  EXPECT_EQ(a.opened, b.opened);
  EXPECT_EQ(a.held, b.held);
}

template <int D>
void compare(test::Listing listing, std::size_t worlds) {
  Listing_tally tally;
  for (std::uint64_t number = 0; number < std::max(oracle::scaled_count(worlds), worlds / 2); ++number) {
    SCOPED_TRACE("world " + std::to_string(number));
    Random random(oracle::reseeded(number));
    test::Listing_twins<D> twins(walled_grid<D>(random), listing, number + 1);
    populate(twins, random);
    ++tally.worlds;
    tally.in_other_cells += twins.in_other_cells;
    Reshaping<D> here(twins.one.environment, twins.one.residents());
    Reshaping<D> there(twins.other.environment, twins.other.residents());
    // Where things may go on on several sides, the one that they take depends on the order, and is not that
    // in the mirror. Later changes meet other things there, so that only the first one tells.
    if (number % 3 == 0)
      ASSERT_NO_FATAL_FAILURE(cut_both<D>(here, there, listing, random, tally));
    else
      ASSERT_NO_FATAL_FAILURE(change_somewhere(twins, here, there, random, tally));
    here.finish();
    there.finish();
    for (const auto& body : twins.one.bodies) ASSERT_NO_THROW(body->validate());
    for (const auto& body : twins.other.bodies) ASSERT_NO_THROW(body->validate());
  }
  std::printf(
      "%dD: %zu worlds, %zu vertices in other cells; %zu changes, %zu made, %zu held; %zu edges split, %zu "
      "refused, %zu facets slit\n",
      D, tally.worlds, tally.in_other_cells, tally.changes, tally.made, tally.held, tally.split,
      tally.refused, tally.slits);
  // These are counts of what the worlds of a seed happen to have; one world in three is cut.
  if (listing == test::Listing::other_order) {
    EXPECT_GT(tally.in_other_cells, tally.worlds);
  }
  EXPECT_GT(tally.made, tally.changes / 4);
  EXPECT_GE(tally.held, D == 2 ? tally.changes / 10 : 1);  // in space, few are held
  EXPECT_GT(tally.slits, D == 2 ? tally.worlds / 4 : 3 * tally.worlds);
  EXPECT_GT(tally.refused, tally.worlds / 10);
}

TEST(Listings, InAnotherOrder2D) { compare<2>(test::Listing::other_order, 400); }
TEST(Listings, InAnotherOrder3D) { compare<3>(test::Listing::other_order, 90); }
TEST(Listings, Mirrored2D) { compare<2>(test::Listing::mirrored, 300); }
TEST(Listings, Mirrored3D) { compare<3>(test::Listing::mirrored, 90); }

}  // namespace
}  // namespace cellwalk
