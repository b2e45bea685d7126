// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/flatten.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include "environment/map_checks.h"
#include "environment/sample_soups.h"

namespace cellwalk {
namespace {

/// The walls a map must have: marked on either side, on the boundary, between solid and free.
template <int D>
std::vector<std::uint8_t> walls(const Cell_soup<D>& soup, const Gluing& gluing) {
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) cell_of[f] = c;
  std::vector<std::uint8_t> result;
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t g = gluing.opposite[f];
    result.push_back(g == no_facet || soup.impassable[f] || soup.impassable[g] ||
                     soup.solid[cell_of[f]] != soup.solid[cell_of[g]]);
  }
  return result;
}

template <int D>
void expect_equal(const Cell_soup<D>& a, const Cell_soup<D>& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.cell_begin, b.cell_begin);
  EXPECT_EQ(a.facet_begin, b.facet_begin);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.impassable, b.impassable);
  EXPECT_EQ(a.solid, b.solid);
}

template <int D>
void expect_built_and_flattened() {
  std::size_t pinched = 0, membranes = 0;
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    const Gluing gluing = glue(soup);
    const auto storage = build_map(soup, gluing);
    test::expect_map_of(*storage, soup);
    pinched += storage->pinched.size();

    const Flat_cells<D> flat = flatten(*storage);
    Cell_soup<D> expected = soup;
    expected.impassable = walls(soup, gluing);
    for (std::size_t f = 0; f < soup.facet_count(); ++f)
      membranes += expected.impassable[f] && gluing.opposite[f] != no_facet;
    expect_equal(flat.soup, expected);
    EXPECT_EQ(flat.gluing.opposite, gluing.opposite);
    EXPECT_EQ(flat.darts, storage->dart_of_half_facet);
  }
  EXPECT_GE(pinched, 10u);
  EXPECT_GT(membranes, 100u);
}

TEST(Map, IsValidAndFlattensToItsSoup2) { expect_built_and_flattened<2>(); }
TEST(Map, IsValidAndFlattensToItsSoup3) { expect_built_and_flattened<3>(); }

template <int D>
void expect_renumbering_kept() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    const auto storage = build_map(soup, glue(soup));
    const Flat_cells<D> before = flatten(*storage);
    // Numbers with gaps, as blocks of a snapshot leave them; their order is kept.
    std::vector<Half_facet> numbers;
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f) numbers.push_back(Half_facet{3 * f + 1});
    assign_half_facets<D>(*storage, before.darts, numbers, 3 * soup.facet_count() + 5);
    test::expect_map_of(*storage, soup);
    const Flat_cells<D> after = flatten(*storage);
    expect_equal(after.soup, before.soup);
    EXPECT_EQ(after.gluing.opposite, before.gluing.opposite);
  }
}

TEST(Map, KeepsItsCellsWhenHalfFacetsAreRenumbered2) { expect_renumbering_kept<2>(); }
TEST(Map, KeepsItsCellsWhenHalfFacetsAreRenumbered3) { expect_renumbering_kept<3>(); }

TEST(Map, GivesAPinchedPointSeveralVertices) {
  const Cell_soup<3> soup = test::pinched_tetrahedra();
  const auto storage = build_map(soup, glue(soup));
  EXPECT_EQ(storage->pinched.size(), 3u);
  for (std::uint32_t p = 0; p < soup.points.size(); ++p) {
    const auto vertices = storage->vertices_of(p);
    EXPECT_EQ(vertices.size(), p == 0 || p == 4 || p == 6 ? 2u : 1u) << p;
    for (const auto v : vertices) EXPECT_EQ(storage->map.info_of_attribute<0>(v), p);
  }
}

template <int D>
void expect_refused(const Cell_soup<D>& soup, const std::string& text) {
  try {
    build_map(soup, glue(soup));
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(Map, RefusesCellsThatAreNotClosed) {
  // A tetrahedron without its last facet, and one with a facet of another cell instead.
  Cell_soup<3> open;
  open.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  add_tetrahedron(open, 0, 1, 2, 3);
  open.add_facet({2, 1, 3});
  open.add_facet({1, 2, 4});
  open.add_facet({1, 4, 3});
  Cell_soup<3> foreign = open;
  open.end_cell();
  expect_refused(open, "cell 1 is not closed");
  foreign.add_facet({2, 0, 4});
  foreign.end_cell();
  expect_refused(foreign, "cell 1 is not closed");

  Cell_soup<2> unchained;
  unchained.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  add_polygon(unchained, std::array<std::uint32_t, 3>{0, 1, 3});
  unchained.add_facet({1, 2});
  unchained.add_facet({3, 1});
  unchained.add_facet({2, 3});
  unchained.end_cell();
  expect_refused(unchained, "cell 1 is not closed: edge 0");
}

/// check_map must notice a map that was changed behind its back.
template <class Damage>
void expect_damage_noticed(const Damage& damage) {
  const Cell_soup<3> soup = tetrahedral_grid({.cells = {2, 2, 2}});
  const auto storage = build_map(soup, glue(soup));
  ASSERT_NO_THROW(check_map(*storage));
  std::uint32_t f = 0;
  while (storage->map.is_free<3>(storage->dart_of_half_facet[f])) ++f;
  damage(*storage, storage->dart_of_half_facet[f]);
  try {
    check_map(*storage);
    FAIL() << "not noticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::other);
  }
}

TEST(Map, CheckNoticesDamage) {
  expect_damage_noticed([](auto& s, auto d) { s.map.template unlink_beta<3>(d); });
  expect_damage_noticed([](auto& s, auto d) { s.map.template unlink_beta<2>(d); });
  expect_damage_noticed([](auto& s, auto d) { s.map.template unlink_beta<1>(d); });
  expect_damage_noticed([](auto& s, auto d) { s.map.info(d).set_cell(7); });
  expect_damage_noticed(
      [](auto& s, auto d) { s.map.info(d).set_impassable(!s.map.info(d).is_impassable()); });
  expect_damage_noticed([](auto& s, auto d) { s.map.info(d).set_half_facet(0); });
  expect_damage_noticed([](auto& s, auto d) {
    s.map.template set_dart_attribute<0>(d, s.map.create_vertex_attribute(s.map.point(d)));
  });
  expect_damage_noticed([](auto& s, auto d) { s.map.template info<0>(d) = 1000; });
  expect_damage_noticed([](auto& s, auto) { s.map.create_dart(); });
  // A twisted facet: each link is an involution, but the edges do not run against each other.
  expect_damage_noticed([](auto& s, auto d) {
    auto e = s.map.template beta<3>(d), next = s.map.template beta<1>(d),
         other = s.map.template beta<3>(next);
    s.map.template basic_link_beta_for_involution<3>(d, other);
    s.map.template basic_link_beta_for_involution<3>(next, e);
  });
}

}  // namespace
}  // namespace cellwalk
