// SPDX-License-Identifier: LGPL-3.0-or-later
// Named groups: through building, which splits cells and facets, and through edits.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace cellwalk {
namespace {

template <int D>
Soup_groups random_groups(const Cell_soup<D>& soup, std::uint64_t seed) {
  Random random(seed);
  Soup_groups groups{{"none", {}}};
  for (const char* name : {"a", "b"}) {
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f)
      if (random.chance(0.1)) groups[name].facets.push_back(f);
    for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
      if (random.chance(0.2)) groups[name].cells.push_back(c);
  }
  return groups;
}

/// The points of each facet named: as the soup has it, by coordinates.
template <int D>
std::set<std::vector<Point<D>>> places_of(const Cell_soup<D>& soup,
                                          const std::vector<std::uint32_t>& facets) {
  std::set<std::vector<Point<D>>> places;
  for (const std::uint32_t f : facets) {
    std::vector<Point<D>> points;
    for (const std::uint32_t v : soup.facet(f)) points.push_back(soup.points[v]);
    std::sort(points.begin(), points.end());
    places.insert(points);
  }
  return places;
}

template <int D>
std::set<std::vector<Point<D>>> places_of(const Snapshot<D>& snapshot,
                                          const std::vector<Half_facet>& facets) {
  std::set<std::vector<Point<D>>> places;
  for (const Half_facet f : facets) {
    std::vector<Point<D>> points;
    for (const std::uint32_t v : snapshot.loop(f)) points.push_back(snapshot.point(v));
    std::sort(points.begin(), points.end());
    places.insert(points);
  }
  return places;
}

template <int D>
bool is_seen_from_lower(const Snapshot<D>& snapshot, Half_facet f) {
  const Cell other = snapshot.neighbour(f);
  return other == Cell::none || snapshot.index(snapshot.cell_of(f)) < snapshot.index(other);
}

/// Without splits: the same facets and cells, and back to the same numbers.
template <int D>
void expect_kept() {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const Cell_soup<D> soup = lattice_world(mixed_lattice_world<D>(seed));
    Build_report report;
    const auto environment = Environment<D>::build(soup, {.split = false}, &report);
    const Soup_groups groups = random_groups(soup, seed);
    const Snapshot<D>& snapshot = environment.snapshot();
    const Groups<D> found = Group_places<D>(soup, groups).find(snapshot, report.origin);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_TRUE(found.at("none").facets.empty() && found.at("none").cells.empty());
    for (const auto& [name, group] : groups) {
      EXPECT_EQ(places_of(snapshot, found.at(name).facets), places_of(soup, group.facets));
      std::vector<std::uint32_t> cells;
      for (const Cell c : found.at(name).cells) cells.push_back(snapshot.index(c));
      std::sort(cells.begin(), cells.end());
      EXPECT_EQ(cells, group.cells);
      for (const Half_facet f : found.at(name).facets) EXPECT_TRUE(is_seen_from_lower(snapshot, f));
    }
    const Cell_soup<D> back = environment.soup();
    const Soup_groups numbers = soup_groups(snapshot, found);
    for (const auto& [name, group] : groups) {
      EXPECT_TRUE(std::ranges::is_sorted(numbers.at(name).facets));
      EXPECT_EQ(places_of(back, numbers.at(name).facets), places_of(soup, group.facets));
      EXPECT_EQ(numbers.at(name).cells, group.cells);
    }
    // Of these numbers, the same comes again.
    const auto again = Environment<D>::build(back, {.split = false});
    const Groups<D> once_more = Group_places<D>(back, numbers).find(again.snapshot(), {});
    for (const auto& [name, selection] : found)
      EXPECT_EQ(places_of(again.snapshot(), once_more.at(name).facets),
                places_of(snapshot, selection.facets));
  }
}

TEST(Groups, AreKeptByBuilding2) { expect_kept<2>(); }
TEST(Groups, AreKeptByBuilding3) { expect_kept<3>(); }

/// Facets and cells of split cells are in the groups with all of their parts.
TEST(Groups, KeepThePartsOfWhatIsSplit) {
  Cell_soup<3> soup = hex_grid({.cells = {2, 2, 1}});
  soup.points.insert(soup.points.begin(), {9, 9, 9});  // is dropped
  for (std::uint32_t& v : soup.vertices) ++v;
  Soup_groups groups;
  groups["cell"].cells = {1};
  // One side of the facet between the first two cells, and a facet of the boundary.
  for (std::uint32_t f = 0; f < 6; ++f) {
    const auto all_at = [&](std::size_t axis, double x) {
      return std::ranges::all_of(soup.facet(f), [&](std::uint32_t v) { return soup.points[v][axis] == x; });
    };
    if (all_at(0, 1)) groups["between"].facets.push_back(f);
    if (all_at(2, 1)) groups["top"].facets.push_back(f);
  }
  Build_report report;
  const auto environment = Environment<3>::build(soup, {.simplicial = true}, &report);
  const Snapshot<3>& snapshot = environment.snapshot();
  ASSERT_GT(snapshot.cell_count(), 20u);
  const Groups<3> found = Group_places<3>(soup, groups).find(snapshot, report.origin);
  double volume = 0;
  for (const Cell c : found.at("cell").cells) {
    const Cell_view<3> view = snapshot.view(c);
    const Point<3>& o = view.point(0);
    volume += std::abs(dot(view.point(1) - o, cross(view.point(2) - o, view.point(3) - o))) / 6;
    EXPECT_GT(centroid(snapshot, c)[0], 1);
  }
  EXPECT_DOUBLE_EQ(volume, 1);
  ASSERT_EQ(found.at("between").facets.size(), 2u);
  for (const Half_facet f : found.at("between").facets) EXPECT_EQ(centroid(snapshot, f)[0], 1);
  ASSERT_EQ(found.at("top").facets.size(), 2u);
  for (const Half_facet f : found.at("top").facets) {
    EXPECT_EQ(centroid(snapshot, f)[2], 1);
    EXPECT_LT(centroid(snapshot, f)[0], 1);
    EXPECT_EQ(snapshot.neighbour(f), Cell::none);
  }
}

/// A facet that is no plane is split into triangles, and a thin tetrahedron may lie on it: what is inside of
/// the cell belongs to no facet, though all its points are points of that one.
TEST(Groups, HaveNoFacetsInsideACell) {
  std::size_t inside = 0;  // with points of one facet only
  for (std::uint64_t seed = 1; seed < 25; ++seed) {
    Cell_soup<3> soup = hex_grid({.cells = {2, 2, 2}});
    Random random(seed);
    for (Point<3>& x : soup.points)
      for (double& coordinate : x) coordinate += random.real(-0.4, 0.4);
    Soup_groups groups;
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f) groups["facets"].facets.push_back(f);
    Build_report report;
    const auto environment = Environment<3>::build(soup, {}, &report);
    const Snapshot<3>& snapshot = environment.snapshot();
    const Groups<3> found = Group_places<3>(soup, groups).find(snapshot, report.origin);
    const auto has_all = [&](std::uint32_t f, const std::vector<std::uint32_t>& loop) {
      return std::ranges::all_of(loop, [&](std::uint32_t v) {
        return std::ranges::any_of(soup.facet(f),
                                   [&](std::uint32_t w) { return soup.points[w] == snapshot.point(v); });
      });
    };
    std::vector<Half_facet> expected;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
        const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
        const Cell other = snapshot.neighbour(f);
        const std::uint32_t origin = report.origin[i];
        if (other != Cell::none && report.origin[snapshot.index(other)] == origin) {
          for (std::uint32_t g = soup.cell_begin[origin]; g < soup.cell_begin[origin + 1]; ++g)
            inside += has_all(g, snapshot.loop(f));
        } else if (other == Cell::none || i < snapshot.index(other)) {
          expected.push_back(f);
        }
      }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found.at("facets").facets, expected) << seed;
  }
  EXPECT_GT(inside, 20u);
}

/// What edits replace leaves its groups, also if its names are given to others.
TEST(Groups, LastAsLongAsTheirCells) {
  auto environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  Groups<3> groups;
  for (std::size_t i = 0; i < 8; ++i) {
    const Cell cell = snapshot.cell(i);
    groups["cells"].cells.push_back(cell);
    for (std::size_t k = 0; k < 4; ++k)
      if (const Half_facet f = Snapshot<3>::half_facet(cell, k); is_seen_from_lower(snapshot, f))
        groups["facets"].facets.push_back(f);
  }
  const Lasting_groups<3> lasting(snapshot, groups);
  const auto places = places_of(snapshot, groups["facets"].facets);
  const auto count = [&] {
    const Groups<3> now = lasting.now(snapshot);
    for (const Half_facet f : now.at("facets").facets) EXPECT_TRUE(is_seen_from_lower(snapshot, f));
    EXPECT_EQ(places_of(snapshot, now.at("facets").facets), places);
    return std::pair(now.at("cells").cells.size(), now.at("facets").facets.size());
  };
  EXPECT_EQ(lasting.names(), (std::vector<std::string>{"cells", "facets"}));
  const auto all = count();
  EXPECT_EQ(all, std::pair(groups["cells"].cells.size(), groups["facets"].facets.size()));
  std::size_t boundary_facets = 0;
  const Cell replaced = snapshot.cell(3);
  for (std::size_t k = 0; k < 4; ++k)
    boundary_facets += snapshot.neighbour(Snapshot<3>::half_facet(replaced, k)) == Cell::none;
  int reused = 0;
  for (int round = 0; round < 4; ++round) {  // names of cells that are gone are used again
    const Cell cell = snapshot.cell(3);
    environment.insert_point(cell, centroid(snapshot, cell));
    const auto left = count();
    EXPECT_EQ(left.first + 1, all.first);
    EXPECT_EQ(left.second, all.second) << "other cells have the facets of those that were replaced";
    reused += snapshot.is_cell(replaced);
  }
  EXPECT_EQ(reused, 2);
  EXPECT_GT(boundary_facets, 0u) << "of the cell that was replaced";
  const Groups<3> now = lasting.now(snapshot);
  for (const Cell c : now.at("cells").cells) EXPECT_NE(snapshot.index(c), 3u);
}

/// A cell with fewer facets may get the names of one that is gone: the last of these are then no facets.
TEST(Groups, OutlastNamesOfMoreFacets) {
  auto environment = Environment<3>::build(hex_grid({.cells = {3, 1, 1}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  const Cell first = snapshot.cell(0);
  Groups<3> groups;
  for (std::size_t k = 0; k < 6; ++k) groups["facets"].facets.push_back(Snapshot<3>::half_facet(first, k));
  const Lasting_groups<3> lasting(snapshot, groups);
  const auto places = places_of(snapshot, groups["facets"].facets);
  for (std::size_t i = 0; i < 3; ++i) {
    environment.insert_point(snapshot.cell(i), centroid(snapshot, snapshot.cell(i)));
    EXPECT_EQ(places_of(snapshot, lasting.now(snapshot).at("facets").facets), places);
    EXPECT_EQ(lasting.now(snapshot).at("facets").facets.size(), 6u);
  }
  ASSERT_TRUE(snapshot.is_cell(first)) << "the name is that of another cell";
  EXPECT_EQ(snapshot.facet_count(first), 5u);
}

/// A cell that comes may have a lower number than one that stays: then facets between them change their side.
TEST(Groups, SeeFacetsFromTheLowerCellAgain) {
  auto environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  const std::size_t last = snapshot.cell_count() - 1;
  Groups<3> groups;
  for (std::size_t k = 0; k < 4; ++k) {
    const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(last), k);
    if (snapshot.neighbour(f) != Cell::none) groups["facets"].facets.push_back(snapshot.opposite(f));
  }
  const Lasting_groups<3> lasting(snapshot, groups);
  const auto places = places_of(snapshot, groups["facets"].facets);
  const Cell_soup<3> none;
  for (const std::size_t i : {0, 1, 2})  // numbers that are free then
    detail::Cell_patcher<3>(environment)
        .replace(std::array{snapshot.cell(i)}, none, detail::glue_patch(none));
  environment.insert_point(snapshot.cell(last), centroid(snapshot, snapshot.cell(last)));
  const Groups<3> now = lasting.now(snapshot);
  EXPECT_EQ(places_of(snapshot, now.at("facets").facets), places);
  EXPECT_NE(now.at("facets").facets, groups["facets"].facets);
  for (const Half_facet f : now.at("facets").facets) EXPECT_TRUE(is_seen_from_lower(snapshot, f));
}

TEST(Groups, OfNumbersThatAreNotThereAreRefused) {
  const Cell_soup<3> soup = hex_grid({.cells = {1, 1, 1}});
  const auto refused = [&](const Soup_group& group) {
    try {
      Group_places<3>(soup, {{"g", group}});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refused({{6}, {}}), "group g names facet 6 of 6");
  EXPECT_EQ(refused({{}, {1}}), "group g names cell 1 of 1");
  EXPECT_EQ(refused({{5}, {0}}), "accepted");
}

}  // namespace
}  // namespace cellwalk
