// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies whose faces were swept once and are not any more: the walls that supported them hold nothing, and
// may go.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk::test {
namespace {

/// A room of tetrahedra, 4 in size, with a membrane at the height of 2.
Environment<3> with_membrane() {
  Environment<3> environment = simplex_grid<3>(4);
  add_membrane(environment, 2);
  return environment;
}

/// A triangle that rested on the membrane when it was last swept.
class Rested {
 public:
  explicit Rested(const Snapshot<3>& snapshot)
      : body(snapshot, Locator<3>(snapshot),
             {{{1.25, 1.25, 2.25}, {1.75, 1.25, 2.25}, {1.75, 1.5, 2.25}},
              {{0, 1}, {0, 2}, {1, 2}},
              {{0, 1, 2}}}) {
    move({0, 0, -0.25}, Sweep::faces);
  }
  void move(const Vector<3>& by, Sweep sweep) {
    Body_options options;
    options.sweep.sweep = sweep;
    Body_counts counts;
    for (std::uint32_t v = 0; v < 3; ++v)
      EXPECT_FALSE(body.move_vertex(v, body.positions()[v] + by, options, counts));
  }
  Body<3> body;
};

bool is_edge_of_membrane_split(Environment<3>& environment, Body<3>& body) {
  const Snapshot<3>& snapshot = environment.snapshot();
  Reshaping<3> reshaping(environment, {{&body}, {}});
  const Cell cell = body.cell_of(0);
  EXPECT_TRUE(reshaping.insert_point(cell, middle_of(snapshot, cell)).is_made)
      << "by which the body is looked up";
  return reshaping
      .split_edge(point_at<3>(environment, {1, 1, 2}), point_at<3>(environment, {2, 2, 2}), {1.5, 1.5, 2})
      .is_made;
}

TEST(UnsweptFaces, DoNotHoldTheWallsThatTheyLeft) {
  for (const bool is_swept : {false, true}) {
    auto environment = with_membrane();
    Rested face(environment.snapshot());
    face.move({2, 2, 1.5}, is_swept ? Sweep::faces : Sweep::triangle);
    EXPECT_TRUE(is_edge_of_membrane_split(environment, face.body)) << is_swept;
    EXPECT_NO_THROW(face.body.validate());
  }
  auto environment = with_membrane();
  Rested face(environment.snapshot());
  face.move({0, 0, 0.25}, Sweep::faces);
  face.move({0, 0, -0.25}, Sweep::faces);
  EXPECT_FALSE(is_edge_of_membrane_split(environment, face.body)) << "while it rests there";
}

TEST(UnsweptFaces, ForgetWallsThatAreGone) {
  auto environment = with_membrane();
  const Snapshot<3>& snapshot = environment.snapshot();
  Rested face(snapshot);
  face.move({0, 0, 0.125}, Sweep::triangle);
  Reshaping<3> reshaping(environment, {{&face.body}, {}});
  // The membrane is opened, and its vertices below the face vanish with their facets.
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      if (snapshot.neighbour(f) != Cell::none && snapshot.is_impassable(f)) reshaping.open(f);
    }
  int gone = 0;
  for (const Point<3>& x : {Point<3>{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}})
    for (const Point<3>& onto : {Point<3>{x[0], x[1], 1}, {x[0], x[1], 3}, {x[0] + 1, x[1], 2}}) {
      const std::uint32_t point = point_at(environment, x), other = point_at(environment, onto);
      const auto cells = environment.cells_around(point);
      const bool are_joined = std::ranges::any_of(cells, [&](Cell c) {
        return std::ranges::find(snapshot.view(c).vertices, other) != snapshot.view(c).vertices.end();
      });
      if (!are_joined || !reshaping.collapse(point, other).is_made) continue;
      ++gone;
      break;
    }
  EXPECT_GT(gone, 0);
  reshaping.finish();
  EXPECT_NO_THROW(face.body.validate());
  Body<3> restored = restore_body<3>(snapshot, save(face.body));
  EXPECT_TRUE(std::ranges::equal(restored.positions(), face.body.positions()));
}

}  // namespace
}  // namespace cellwalk::test
