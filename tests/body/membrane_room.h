// SPDX-License-Identifier: LGPL-3.0-or-later
// A room with membranes in a plane, and bodies that move in it vertex by vertex.
#ifndef CELLWALK_TESTS_BODY_MEMBRANE_ROOM_H
#define CELLWALK_TESTS_BODY_MEMBRANE_ROOM_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/generators/grid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cellwalk::test {

/// A room of cubes, 2 in height, with membranes where their centres are in a box.
inline Environment<3> with_membranes(const Point<3>& low, const Point<3>& high, unsigned length = 22,
                                     unsigned width = 12) {
  Grid_options<3> options;
  options.cells = {length, width, 2};
  auto environment = Environment<3>::build(hex_grid(options));
  const Snapshot<3>& snapshot = environment.snapshot();
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      const Point<3> x = centroid(snapshot, f);
      bool is_inside = snapshot.neighbour(f) != Cell::none;
      for (std::size_t j = 0; j < 3; ++j) is_inside &= low[j] < x[j] && x[j] < high[j];
      if (is_inside) environment.set_impassable(f, true);
    }
  return environment;
}

class Moving {
 public:
  Moving(const Snapshot<3>& snapshot, const std::vector<Point<3>>& points,
         const std::vector<std::array<std::uint32_t, 3>>& faces,
         const std::vector<std::array<std::uint32_t, 2>>& bare_edges = {})
      : body_(snapshot, Locator<3>(snapshot), soup(points, faces, bare_edges)) {
    options_.sweep.sweep = Sweep::faces;
  }

  std::optional<Contact<3>> move(std::uint32_t vertex, const Point<3>& target) {
    auto contact = body_.move_vertex(vertex, target, options_, counts_);
    EXPECT_NO_THROW(body_.validate());
    return contact;
  }
  /// Returns whether the first vertices came to a height.
  bool lift(double z, std::uint32_t count) {
    for (std::uint32_t v = 0; v < count; ++v) {
      Point<3> target = body_.positions()[v];
      target[2] = z;
      if (move(v, target)) return false;
    }
    return true;
  }
  bool lift(double z) { return lift(z, static_cast<std::uint32_t>(body_.vertex_count())); }
  /// Returns whether all vertices could be moved up.
  bool rise(double by) {
    for (std::uint32_t v = 0; v < body_.vertex_count(); ++v) {
      Point<3> target = body_.positions()[v];
      target[2] += by;
      if (move(v, target)) return false;
    }
    return true;
  }

  void register_again(const Snapshot<3>& snapshot) { body_.register_again(Locator<3>(snapshot)); }

  std::span<const Point<3>> positions() const { return body_.positions(); }

 private:
  static Body_soup<3> soup(const std::vector<Point<3>>& points,
                           const std::vector<std::array<std::uint32_t, 3>>& faces,
                           const std::vector<std::array<std::uint32_t, 2>>& bare_edges) {
    Body_soup<3> soup{points, bare_edges, faces};
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

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_MEMBRANE_ROOM_H
