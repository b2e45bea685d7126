// SPDX-License-Identifier: LGPL-3.0-or-later
// The map that thaw() makes, against the one that was dropped: the same darts for all names, and the same
// edits afterwards.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "sample_soups.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

/// What a map says of each half-facet: the points of its loop, its other side, its cell and its marks; and of
/// each point, how many vertices it has.
template <int D>
std::vector<std::vector<std::uint32_t>> map_contents(const Map_storage<D>& storage) {
  std::vector<std::vector<std::uint32_t>> result;
  for (const Const_dart<D> d : storage.dart_of_half_facet) {
    std::vector<std::uint32_t>& of = result.emplace_back();
    if (d == Const_dart<D>{}) continue;
    const Dart_info& info = storage.map.info(d);
    for_each_dart_of_half_facet<D>(storage.map, d,
                                   [&](Const_dart<D> e) { of.push_back(storage.point_of(e)); });
    std::rotate(of.begin(), std::min_element(of.begin(), of.end()), of.end());
    if (D == 2) of.push_back(storage.point_of(storage.map.template beta<1>(d)));
    of.push_back(storage.map.template is_free<D>(d)
                     ? no_facet
                     : storage.map.info(storage.map.template beta<D>(d)).half_facet());
    of.insert(of.end(), {info.cell(), info.half_facet(), info.is_impassable(), info.is_solid()});
  }
  for (std::uint32_t p = 0; p < storage.vertex_of_point.size(); ++p)
    result.push_back({p, static_cast<std::uint32_t>(storage.vertices_of(p).size())});
  return result;
}

/// Freezes, thaws, and expects the same map and snapshot.
template <int D>
void expect_thawed(Environment<D>& environment) {
  const bool has_gaps = environment.snapshot().cell_count() != environment.snapshot().cell_slots();
  const auto before = has_gaps ? test::Snapshot_facts<D>{} : test::facts(environment.snapshot());
  const auto map_before = map_contents(environment.storage());
  const std::uint64_t epoch = environment.snapshot().epoch();
  environment.freeze();
  environment.thaw();
  ASSERT_FALSE(environment.is_frozen());
  EXPECT_EQ(environment.snapshot().epoch(), epoch) << "nothing was edited";
  if (!has_gaps) {
    EXPECT_EQ(test::facts(environment.snapshot()), before);
  }
  EXPECT_EQ(map_contents(environment.storage()), map_before);
  EXPECT_TRUE(environment.storage().map.is_valid());
  EXPECT_NO_THROW(environment.certify());
  const Map_storage<D>* const storage = &environment.storage();
  environment.thaw();
  EXPECT_EQ(&environment.storage(), storage) << "one that is not frozen keeps its map";
}

template <int D>
void expect_samples_thawed() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> environment = Environment<D>::build(soup);
    expect_thawed(environment);
    const auto expected = map_contents(environment.storage());
    Environment<D> never = Environment<D>::build(soup, {.keep_map = false});
    never.thaw();
    EXPECT_EQ(map_contents(never.storage()), expected);
  }
}

TEST(Thaw, MakesTheMapThatWasDropped2) { expect_samples_thawed<2>(); }
TEST(Thaw, MakesTheMapThatWasDropped3) { expect_samples_thawed<3>(); }

/// Facets in one place that are not glued, pinched points, and solid cells.
template <int D>
void expect_lattices_thawed() {
  std::size_t pinched = 0, solid = 0, doubled = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Lattice_world_options<D> options = mixed_lattice_world<D>(seed);
    options.slit_share = 0.1;
    Environment<D> environment =
        Environment<D>::build(lattice_world(options), {.duplicates = Duplicate_vertices::keep});
    pinched += environment.storage().pinched.size();
    const Certificate certificate = environment.certify();
    solid += certificate.solid_cells;
    std::vector<Point<D>> points(environment.snapshot().points().begin(),
                                 environment.snapshot().points().end());
    std::sort(points.begin(), points.end());
    doubled += std::adjacent_find(points.begin(), points.end()) != points.end();
    expect_thawed(environment);
  }
  EXPECT_GT(pinched, 0u);
  EXPECT_GT(solid, 0u);
  EXPECT_GT(doubled, 5u);
}

TEST(Thaw, KeepsSlitsAndPinchedPoints2) { expect_lattices_thawed<2>(); }
TEST(Thaw, KeepsSlitsAndPinchedPoints3) { expect_lattices_thawed<3>(); }

/// An edit drawn at random; what was refused says so.
template <int D>
std::string make_random_edit(Environment<D>& environment, Random& random) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const Cell cell = snapshot.cell(random.below(snapshot.cell_slots()));
  const auto kind = random.below(5);
  const Half_facet facet = Snapshot<D>::half_facet(cell, random.below(snapshot.facet_count(cell)));
  Vector<D> sum{};
  const Cell_view<D> view = snapshot.view(cell);
  for (std::size_t v = 0; v < view.vertex_count(); ++v) sum = sum + (view.point(v) - Point<D>{});
  const Point<D> middle = Point<D>{} + (1.0 / static_cast<double>(view.vertex_count())) * sum;
  const auto point = view.point_index(0);
  try {
    if (kind == 0) environment.set_impassable(facet, !snapshot.is_impassable(facet));
    if (kind == 1) environment.insert_point(cell, middle);
    if (kind == 2) environment.fill(cell);
    if (kind == 3) environment.excavate(cell);
    if (kind == 4)
      environment.move_vertex(point, snapshot.point(point) + 0.0625 * (middle - snapshot.point(point)));
  } catch (const Error& error) {
    return error.what();
  }
  return std::to_string(kind);
}

/// Two environments with the same edits, of which one is frozen and thawed between them.
template <int D>
void expect_same_edits() {
  std::size_t made = 0;
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> kept = Environment<D>::build(soup), thawed = Environment<D>::build(soup);
    Random random(40 + D), same_random(40 + D);
    for (int round = 0; round < 24; ++round) {
      if (round % 4 == 0) thawed.freeze();
      if (round % 4 == 1) thawed.thaw();
      if (round % 4 == 0) {  // vertices move without the map
        const auto point = kept.snapshot().view(kept.snapshot().cell(0)).point_index(0);
        Point<D> target = kept.snapshot().point(point);
        target[0] += 0x1p-10;
        for (Environment<D>* environment : {&kept, &thawed}) {
          try {
            environment->move_vertex(point, target);
          } catch (const Error&) {
            EXPECT_NE(environment->snapshot().point(point), target);
          }
        }
        continue;
      }
      const std::string done = make_random_edit(kept, random);
      EXPECT_EQ(make_random_edit(thawed, same_random), done);
      made += done.size() == 1;
      ASSERT_EQ(test::facts(thawed.snapshot()), test::facts(kept.snapshot()));
      ASSERT_EQ(map_contents(thawed.storage()), map_contents(kept.storage()));
    }
    EXPECT_NO_THROW(thawed.certify());
  }
  EXPECT_GT(made, 40u);
}

TEST(Thaw, TheSameEditsFollow2) { expect_same_edits<2>(); }
TEST(Thaw, TheSameEditsFollow3) { expect_same_edits<3>(); }

/// Indices of cells, names of half-facets and points that are not in use.
TEST(Thaw, LeavesGapsThatEditsLeft) {
  Environment<3> environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  const std::vector<Cell> star = environment.cells_around(0);
  const Cell_soup<3> none;
  std::vector<Cell> removed = star;
  removed.push_back(snapshot.cell(20));
  std::sort(removed.begin(), removed.end());
  removed.erase(std::unique(removed.begin(), removed.end()), removed.end());
  for (const Cell cell : removed)
    detail::Cell_patcher<3>(environment).replace(std::array{cell}, none, detail::glue_patch(none));
  ASSERT_LT(snapshot.cell_count(), snapshot.cell_slots());
  environment.insert_point(snapshot.cell(40), [&] {
    Vector<3> sum{};
    for (std::size_t v = 0; v < 4; ++v) sum = sum + (snapshot.view(snapshot.cell(40)).point(v) - Point<3>{});
    return Point<3>{} + 0.25 * sum;
  }());
  expect_thawed(environment);
}

TEST(Thaw, AnEnvironmentThatIsFrozenSaysSo) {
  Environment<3> environment =
      Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}), {.keep_map = false});
  try {
    environment.set_impassable(Half_facet{0}, true);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("thaw()"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cellwalk
