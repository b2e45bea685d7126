// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

namespace cellwalk {
namespace {

/// Expects glue to throw with the code, and a message that contains the text.
template <int D>
void expect_refused(const Cell_soup<D>& soup, Error_code code, const std::string& text) {
  try {
    glue(soup);
    FAIL() << "not refused: " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

Cell_soup<3> two_tetrahedra() {
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  add_tetrahedron(soup, 0, 1, 2, 3);
  add_tetrahedron(soup, 1, 4, 2, 3);
  return soup;
}

TEST(Gluing, MatchesTheTwoSidesOfAFacet) {
  const Gluing gluing = glue(two_tetrahedra());
  const std::vector<std::uint32_t> expected{no_facet, no_facet, 7, no_facet, no_facet, no_facet, no_facet, 2};
  EXPECT_EQ(gluing.opposite, expected);
}

TEST(Gluing, MatchesEdgesOfPolygons) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  add_polygon(soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  add_polygon(soup, std::array<std::uint32_t, 4>{1, 4, 5, 2});
  const Gluing gluing = glue(soup);
  EXPECT_EQ(gluing.opposite[1], 7u);
  EXPECT_EQ(gluing.opposite[7], 1u);
  EXPECT_EQ(std::count(gluing.opposite.begin(), gluing.opposite.end(), no_facet), 6);
}

TEST(Gluing, TellsPolygonsApartThatShareThreeVertices) {
  // Two pentagons and two quadrangles, all with lowest vertices 0 and 1 and highest vertex 9.
  Cell_soup<3> soup;
  soup.points.resize(10);
  for (const bool reversed : {false, true})
    for (std::vector<std::uint32_t> loop :
         {std::vector<std::uint32_t>{0, 1, 9, 3}, {0, 1, 9, 4, 5}, {0, 1, 9, 6}}) {
      if (reversed) std::reverse(loop.begin(), loop.end());
      soup.add_facet(loop);
      soup.end_cell();
    }
  EXPECT_EQ(glue(soup).opposite, (std::vector<std::uint32_t>{3, 4, 5, 0, 1, 2}));
}

TEST(Gluing, IsTheSameForAnyRotationOfTheLoops) {
  const std::vector<std::uint32_t> loop{4, 7, 2, 5, 1};
  for (std::size_t shift = 0; shift < loop.size(); ++shift) {
    Cell_soup<3> soup;
    soup.points.resize(8);
    soup.add_facet(loop);
    soup.end_cell();
    std::vector<std::uint32_t> other(loop.rbegin(), loop.rend());
    std::rotate(other.begin(), other.begin() + shift, other.end());
    soup.add_facet(other);
    soup.end_cell();
    EXPECT_EQ(glue(soup).opposite, (std::vector<std::uint32_t>{1, 0}));
  }
}

TEST(Gluing, RefusesAnIndexOutOfRange) {
  Cell_soup<3> soup = two_tetrahedra();
  soup.points.pop_back();
  expect_refused(soup, Error_code::input, "facet 0 of cell 1 refers to point 4, but there are only 4");
}

TEST(Gluing, RefusesShortLoopsAndRepeatedVertices) {
  Cell_soup<3> soup = two_tetrahedra();
  soup.add_facet({0, 1});
  soup.end_cell();
  expect_refused(soup, Error_code::input, "facet 0 of cell 2 has 2 vertices");

  soup = two_tetrahedra();
  soup.add_facet({0, 1, 0});
  soup.end_cell();
  expect_refused(soup, Error_code::input, "facet 0 of cell 2 has a vertex twice");

  Cell_soup<3> round;
  std::vector<std::uint32_t> loop(40);
  for (std::uint32_t i = 0; i < 40; ++i) loop[i] = i;
  loop[39] = 7;
  round.points.resize(40);
  round.add_facet(loop);
  round.end_cell();
  expect_refused(round, Error_code::input, "has a vertex twice");

  Cell_soup<2> flat;
  flat.points.resize(3);
  flat.add_facet({0, 1, 2});
  flat.end_cell();
  expect_refused(flat, Error_code::input, "an edge has 2");
}

TEST(Gluing, RefusesArraysThatDisagree) {
  Cell_soup<3> soup = two_tetrahedra();
  soup.solid.pop_back();
  expect_refused(soup, Error_code::input, "do not agree in length");
  soup = two_tetrahedra();
  soup.add_facet({0, 1, 2});  // a cell that was never ended
  expect_refused(soup, Error_code::input, "do not agree in length");
}

TEST(Gluing, RefusesThreeCellsOnOneFacet) {
  Cell_soup<3> soup = two_tetrahedra();
  soup.points.push_back({2, 2, 2});
  add_tetrahedron(soup, 1, 5, 2, 3);
  expect_refused(soup, Error_code::not_certified, "at most two cells may share a facet");
}

TEST(Gluing, RefusesTwoCellsOnTheSameSide) {
  Cell_soup<3> soup = two_tetrahedra();
  add_tetrahedron(soup, 0, 1, 2, 4);
  expect_refused(soup, Error_code::not_certified,
                 "facet 0 of cell 0 and facet 0 of cell 2 lie on the same side");
}

TEST(Gluing, RefusesTheSameVerticesInDifferentOrder) {
  Cell_soup<3> soup;
  soup.points.resize(4);
  soup.add_facet({0, 1, 2, 3});
  soup.end_cell();
  soup.add_facet({0, 2, 1, 3});
  soup.end_cell();
  expect_refused(soup, Error_code::not_certified, "different cyclic order");
}

TEST(Gluing, RefusesACellThatTouchesItself) {
  Cell_soup<3> soup;
  soup.points.resize(3);
  soup.add_facet({0, 1, 2});
  soup.add_facet({2, 1, 0});
  soup.end_cell();
  expect_refused(soup, Error_code::not_certified, "a cell cannot touch itself");
}

TEST(Gluing, NamesTheFirstOfSeveralErrors) {
  Cell_soup<3> soup;
  for (std::uint32_t c = 0; c < 5000; ++c) {
    for (int i = 0; i < 4; ++i) soup.points.push_back({});
    add_tetrahedron(soup, 4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3);
  }
  Cell_soup<3> malformed = soup;
  for (std::size_t v = 12 * 1234; v < malformed.vertices.size(); v += 3) malformed.vertices[v] = 1u << 30;
  expect_refused(malformed, Error_code::input, "facet 0 of cell 1234 refers");
  for (std::uint32_t c = 1000; c < 5000; ++c) add_tetrahedron(soup, 4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3);
  expect_refused(soup, Error_code::not_certified, "facet 0 of cell 1000 and facet 0 of cell 5000");
}

}  // namespace
}  // namespace cellwalk
