// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/flatten.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <limits>

#include "map_checks.h"
#include "sample_soups.h"
#include "snapshot_checks.h"

namespace cellwalk {
namespace {

/// Expects a refusal with the code, and a message that contains the text.
template <int D>
void expect_refused(const Cell_soup<D>& soup, const Build_options& options, Error_code code,
                    const std::string& text) {
  try {
    Environment<D>::build(soup, options);
    FAIL() << "not refused: " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

template <int D>
void expect_all_samples_built() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Build_report report;
    const Environment<D> environment = Environment<D>::build(soup, {}, &report);
    EXPECT_EQ(report.cells_read, soup.cell_count());
    EXPECT_EQ(report.points_read, soup.points.size());
    EXPECT_EQ(report.unused_points + report.merged_points + report.split.cells_split, 0u);
    EXPECT_FALSE(report.flipped);
    EXPECT_TRUE(report.origin.empty());

    const test::Expected_counts<D> expected = test::count_by_sets(soup);
    EXPECT_EQ(report.certificate.cells, expected.cells);
    EXPECT_EQ(report.certificate.facets, expected.facets);
    EXPECT_EQ(report.certificate.boundary_facets, expected.boundary_facets);
    EXPECT_EQ(report.certificate.pinched_vertices, expected.pinched);
    const Map_counts counts = check_map(environment.storage());
    EXPECT_EQ(counts.vertices, expected.vertices);
    EXPECT_EQ(counts.facets, expected.facets);
    EXPECT_EQ(environment.certify().cells, expected.cells);
  }
}

TEST(Environment, IsBuiltFromEverySample2) { expect_all_samples_built<2>(); }
TEST(Environment, IsBuiltFromEverySample3) { expect_all_samples_built<3>(); }

template <int D>
void expect_same_without_map() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    const Environment<D> with_map = Environment<D>::build(soup);
    const Environment<D> frozen = Environment<D>::build(soup, {.keep_map = false});
    EXPECT_EQ(test::facts(with_map.snapshot()), test::facts(frozen.snapshot()));
    EXPECT_TRUE(frozen.is_frozen());
    EXPECT_EQ(frozen.certify().cells, soup.cell_count());
  }
}

TEST(Environment, HasTheSameSnapshotWithoutItsMap2) { expect_same_without_map<2>(); }
TEST(Environment, HasTheSameSnapshotWithoutItsMap3) { expect_same_without_map<3>(); }

template <int D>
void expect_soup_round_trip() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    const Environment<D> environment = Environment<D>::build(soup);
    const Cell_soup<D> again = environment.soup();
    EXPECT_EQ(again.points, soup.points);
    EXPECT_EQ(again.solid, soup.solid);
    const auto rebuilt = Environment<D>::build(again);
    EXPECT_EQ(test::facts(rebuilt.snapshot()), test::facts(environment.snapshot()));
  }
}

TEST(Environment, GivesItsSoupBack2) { expect_soup_round_trip<2>(); }
TEST(Environment, GivesItsSoupBack3) { expect_soup_round_trip<3>(); }

TEST(Environment, FreezingDropsTheMapOnly) {
  Environment<3> environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const auto before = test::facts(environment.snapshot());
  EXPECT_NO_THROW(environment.storage());
  environment.freeze();
  EXPECT_TRUE(environment.is_frozen());
  EXPECT_EQ(test::facts(environment.snapshot()), before);
  EXPECT_THROW(environment.storage(), Error);
  EXPECT_THROW(environment.set_impassable(Half_facet{0}, true), Error);
  EXPECT_NO_THROW(environment.move_vertex(13, {1.25, 1, 1})) << "needs no map";
  EXPECT_THROW(environment.insert_point(Cell{0}, {}), Error);
}

TEST(Environment, MovesAsAWhole) {
  Environment<3> a = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const auto before = test::facts(a.snapshot());
  Environment<3> b = std::move(a);
  EXPECT_EQ(test::facts(b.snapshot()), before);
  EXPECT_NO_THROW(b.certify());
}

TEST(Environment, DropsUnusedPoints) {
  Cell_soup<3> soup = tetrahedral_grid({.cells = {2, 2, 2}});
  const auto built = Environment<3>::build(soup);
  const auto expected = test::facts(built.snapshot());
  // Unused points before, between and behind; even in a used place, or nowhere.
  const double infinity = std::numeric_limits<double>::infinity();
  soup.points.insert(soup.points.begin() + 5, {infinity, 0, 0});
  soup.points.insert(soup.points.begin(), soup.points[3]);
  soup.points.push_back({9, 9, 9});
  for (std::uint32_t& v : soup.vertices) v += v >= 5 ? 2 : 1;
  Build_report report;
  const Environment<3> environment = Environment<3>::build(soup, {}, &report);
  EXPECT_EQ(report.unused_points, 3u);
  EXPECT_EQ(report.merged_points, 0u);
  EXPECT_EQ(test::facts(environment.snapshot()), expected);
}

/// Two squares (cubes) that should share a facet, but have points of their own there; one is at -0 instead of
/// 0.
Cell_soup<2> torn_squares() {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, -0.0}, {2, 0}, {2, 1}, {1, 1}};
  add_polygon(soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  add_polygon(soup, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  return soup;
}

TEST(Environment, RefusesMergesOrKeepsDuplicatePoints) {
  expect_refused(torn_squares(), {}, Error_code::not_certified,
                 "points 1 and 4 lie in the same place (1, 0)");

  Build_report report;
  Environment<2> merged =
      Environment<2>::build(torn_squares(), {.duplicates = Duplicate_vertices::merge}, &report);
  EXPECT_EQ(report.merged_points, 2u);
  EXPECT_EQ(report.certificate.boundary_facets, 6u);
  EXPECT_EQ(merged.snapshot().points().size(), 6u);
  EXPECT_NO_THROW(merged.certify());

  Environment<2> kept =
      Environment<2>::build(torn_squares(), {.duplicates = Duplicate_vertices::keep}, &report);
  EXPECT_EQ(report.merged_points, 0u);
  EXPECT_EQ(report.certificate.boundary_facets, 8u);
  EXPECT_EQ(kept.snapshot().points().size(), 8u);
  EXPECT_NO_THROW(kept.certify());
}

TEST(Environment, MergingThatClosesAnEdgeIsRefused) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {1, 0}, {0, 1}};
  add_polygon(soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  expect_refused(soup, {.duplicates = Duplicate_vertices::merge}, Error_code::input, "has a vertex twice");
}

template <int D>
void expect_flipped() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Cell_soup<D> inverted;
    inverted.points = soup.points;
    for (std::size_t c = 0; c < soup.cell_count(); ++c) {
      for (std::size_t f = soup.cell_begin[c + 1]; f-- > soup.cell_begin[c];) {
        std::vector<std::uint32_t> loop(soup.facet(f).rbegin(), soup.facet(f).rend());
        inverted.add_facet(loop, soup.impassable[f]);
      }
      inverted.end_cell(soup.solid[c]);
    }
    Build_report report;
    const Environment<D> environment = Environment<D>::build(inverted, {}, &report);
    EXPECT_TRUE(report.flipped);
    const auto built = Environment<D>::build(soup);
    EXPECT_EQ(test::facts(environment.snapshot()), test::facts(built.snapshot()));
  }
}

TEST(Environment, FlipsAMeshThatIsInvertedThroughout2) { expect_flipped<2>(); }
TEST(Environment, FlipsAMeshThatIsInvertedThroughout3) { expect_flipped<3>(); }

TEST(Environment, RefusesOneInvertedCell) {
  Cell_soup<3> soup = test::pinched_tetrahedra();
  add_tetrahedron(soup, 1, 3, 2, 7);
  expect_refused(soup, {}, Error_code::not_certified, "cell");
}

TEST(Environment, SplitsCellsThatAreNotPlanarAndSaysSo) {
  Cell_soup<3> soup = hex_grid({.cells = {2, 1, 1}});
  // One corner of the facet between the two cubes leaves its plane.
  for (Point<3>& p : soup.points)
    if (p == Point<3>{1, 1, 1}) p = {1.125, 1, 1};
  Build_report report;
  const Environment<3> environment = Environment<3>::build(soup, {}, &report);
  EXPECT_EQ(report.split.cells_split, 2u);
  EXPECT_EQ(report.cells_read, 2u);
  ASSERT_EQ(report.origin.size(), environment.snapshot().cell_count());
  EXPECT_TRUE(std::is_sorted(report.origin.begin(), report.origin.end()));
  EXPECT_EQ(report.origin.back(), 1u);
  EXPECT_EQ(environment.certify().cells, report.split.cells_made);
  expect_refused(soup, {.split = false}, Error_code::not_certified, "cell 0");
}

TEST(Environment, RefusesMalformedSoups) {
  expect_refused(Cell_soup<3>(), {}, Error_code::input, "there are no cells");

  Cell_soup<3> soup = test::pinched_tetrahedra();
  soup.points[2][1] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(soup, {}, Error_code::input, "point 2 is not finite");

  soup = test::pinched_tetrahedra();
  soup.vertices[4] = 77;
  expect_refused(soup, {}, Error_code::input, "refers to point 77");

  soup = test::pinched_tetrahedra();
  soup.end_cell();  // without facets
  expect_refused(soup, {}, Error_code::not_certified, "cell 3");
}

TEST(Environment, MapTakesAtMost700BytesATetrahedron) {
  const Cell_soup<3> soup = tetrahedral_grid({.cells = {20, 20, 20}});
  const Environment<3> environment = Environment<3>::build(soup);
  const auto cells = static_cast<double>(soup.cell_count());
  EXPECT_LE(static_cast<double>(environment.storage().map.bytes()) / cells, 700);
  EXPECT_LE(static_cast<double>(environment.snapshot().bytes()) / cells, 150);
}

}  // namespace
}  // namespace cellwalk
