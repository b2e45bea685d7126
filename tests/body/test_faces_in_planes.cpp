// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces and edges that move in the plane of walls: what they need at all times, not at the end alone.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/generators/grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace cellwalk::test {
namespace {

/// A room of 22 x 12 x 2 cubes with membranes at half its height.
Environment<3> with_membranes(const Point<3>& low, const Point<3>& high) {
  Grid_options<3> options;
  options.cells = {22, 12, 2};
  auto environment = Environment<3>::build(hex_grid(options));
  const Snapshot<3>& snapshot = environment.snapshot();
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      const Point<3> x = mean_of(snapshot, f);
      bool is_inside = snapshot.neighbour(f) != Cell::none;
      for (std::size_t j = 0; j < 3; ++j) is_inside &= low[j] < x[j] && x[j] < high[j];
      if (is_inside) environment.set_impassable(f, true);
    }
  return environment;
}

class Moving {
 public:
  Moving(const Snapshot<3>& snapshot, const std::vector<Point<3>>& points,
         const std::vector<std::array<std::uint32_t, 3>>& faces)
      : body_(snapshot, Locator<3>(snapshot), soup(points, faces)) {
    options_.sweep.sweep = Sweep::faces;
  }

  std::optional<Contact<3>> move(std::uint32_t vertex, const Point<3>& target) {
    auto contact = body_.move_vertex(vertex, target, options_, counts_);
    EXPECT_NO_THROW(body_.validate());
    return contact;
  }
  /// Returns whether all vertices came to a height.
  bool lift(double z) {
    for (std::uint32_t v = 0; v < body_.vertex_count(); ++v) {
      Point<3> target = body_.positions()[v];
      target[2] = z;
      if (move(v, target)) return false;
    }
    return true;
  }

 private:
  static Body_soup<3> soup(const std::vector<Point<3>>& points,
                           const std::vector<std::array<std::uint32_t, 3>>& faces) {
    Body_soup<3> soup{points, {}, faces};
    for (const auto& face : faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t u = face[k], v = face[(k + 1) % 3];
        soup.edges.push_back({std::min(u, v), std::max(u, v)});
      }
    std::sort(soup.edges.begin(), soup.edges.end());
    soup.edges.erase(std::unique(soup.edges.begin(), soup.edges.end()), soup.edges.end());
    return soup;
  }

  Body<3> body_;
  Body_options options_;
  Body_counts counts_;
};

TEST(FacesInPlanes, StayOnTheirSideOfWallsThatAreJoined) {
  const auto environment = with_membranes({8.9, 4.9, 0.9}, {20.1, 6.1, 1.1});
  int arrived = 0;
  for (const double z : {0.5, 1.5})
    for (const int steps : {1, 2, 20}) {
      SCOPED_TRACE(z);
      Moving face(environment.snapshot(), {{21, 11, z}, {11, 1, z}, {21, 1, z}}, {{0, 1, 2}});
      ASSERT_TRUE(face.lift(1)) << "onto the membranes";
      // It leaves those on which it rests, and comes to others beside them.
      bool is_free = true;
      for (int k = 1; k <= steps && is_free; ++k) is_free = !face.move(0, {21 - 20. * k / steps, 11, 1});
      arrived += is_free;
      EXPECT_FALSE(face.lift(2 - z)) << "through them";
      EXPECT_TRUE(face.lift(z)) << "off them";
    }
  EXPECT_GE(arrived, 3) << "no side is blocked by nothing";
}

/// A tetrahedron whose edge 01 moves in the plane z = 1, and heights of its other corners.
struct Wedge {
  Wedge(const Snapshot<3>& snapshot, double one, double other)
      : body(snapshot, {{4, 11, 1}, {10.5, 1, 1}, {2, 6, one}, {2, 6, other}},
             {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}) {}
  Moving body;
};

TEST(FacesInPlanes, NothingComesBetweenFacesThatShareAnEdge) {
  const auto environment = with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1});
  const auto contact = Wedge(environment.snapshot(), 1.75, 0.25).body.move(0, {18, 11, 1});
  ASSERT_TRUE(contact);
  // The edge meets the corner (10, 5) first, when its moving end is at x = 9.25.
  EXPECT_EQ(contact->time, Exact_time(0.375));
  EXPECT_EQ(contact->point, (Point<3>{10, 5, 1}));
  EXPECT_EQ(contact->kind, Contact_kind::vertex);
  EXPECT_EQ(contact->body, Body_feature::edge);
  EXPECT_EQ(contact->feature, 0u);
  EXPECT_LT(contact->normal[0], -0.9) << "against the motion";
  EXPECT_EQ(contact->normal[2], 0);
  // In parts as in one.
  Wedge slow(environment.snapshot(), 1.75, 0.25);
  EXPECT_FALSE(slow.body.move(0, {9, 11, 1}));
  EXPECT_TRUE(slow.body.move(0, {9.5, 11, 1}));
}

TEST(FacesInPlanes, FacesOnOneSideOfAWallAreFree) {
  const auto environment = with_membranes({9.9, 4.9, 0.9}, {11.1, 6.1, 1.1});
  for (const auto& [one, other] : {std::pair{1.75, 1.25}, {0.25, 0.75}})
    EXPECT_FALSE(Wedge(environment.snapshot(), one, other).body.move(0, {18, 11, 1}));
  // The membrane is beside the way of the edge, or behind its end.
  for (const auto& [low, high] : {std::pair{Point<3>{16.9, 4.9, 0.9}, Point<3>{18.1, 6.1, 1.1}},
                                  {Point<3>{4.9, 0.9, 0.9}, Point<3>{6.1, 2.1, 1.1}}}) {
    const auto other = with_membranes(low, high);
    EXPECT_FALSE(Wedge(other.snapshot(), 1.75, 0.25).body.move(0, {18, 11, 1}));
  }
}

}  // namespace
}  // namespace cellwalk::test
