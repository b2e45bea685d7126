// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets of grids, and bodies at them, for tests of walls that appear and vanish.
#ifndef CELLWALK_TESTS_RESHAPE_TOGGLE_CASES_H
#define CELLWALK_TESTS_RESHAPE_TOGGLE_CASES_H

#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk::test {

/// The facets on the level `height` of a unit square (2D: edge) whose lowest corner is x, seen from below.
template <int D>
std::vector<Half_facet> level_facets(const Environment<D>& environment, double height,
                                     std::array<double, 2> x) {
  const Snapshot<D>& snapshot = environment.snapshot();
  std::vector<Half_facet> result;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const auto loop = snapshot.loop(f);
      const auto lies_there = [&](std::uint32_t v) {
        const Point<D>& p = snapshot.point(v);
        for (std::size_t a = 0; a + 1 < D; ++a)
          if (p[a] < x[a] || p[a] > x[a] + 1) return false;
        return p[D - 1] == height;
      };
      const Cell_view<D> view = snapshot.view(c);
      bool is_below = false;
      for (std::size_t v = 0; v < view.vertex_count(); ++v) is_below |= view.point(v)[D - 1] < height;
      if (is_below && std::all_of(loop.begin(), loop.end(), lies_there)) result.push_back(f);
    }
  }
  return result;
}

template <int D>
Body<D> body_at(const Environment<D>& environment, std::vector<Point<D>> points, bool has_face = false) {
  Body_soup<D> soup{std::move(points), {{0, 1}}, {}};
  if (soup.points.size() == 3) soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  if (has_face) soup.faces = {{0, 1, 2}};
  return {environment.snapshot(), Locator<D>(environment.snapshot()), soup};
}

template <int D>
void expect_held(const Outcome& result, std::vector<Resident> by) {
  EXPECT_FALSE(result.is_made);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_EQ(result.held_by, by);
}

template <int D>
void expect_sound(const Environment<D>& environment, const Body<D>& body) {
  EXPECT_NO_THROW(environment.certify());
  EXPECT_NO_THROW(body.validate());
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_TOGGLE_CASES_H
