// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells that are boxes of different sizes: their facets have corners in the middle of their sides.
#ifndef CELLWALK_TESTS_BODY_REGISTRATION_BOX_CELLS_H
#define CELLWALK_TESTS_BODY_REGISTRATION_BOX_CELLS_H

#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace cellwalk::test {

/// From low to high in each coordinate.
struct Box_cell {
  Point<3> low, high;
};

/// \param boxes which together are a box
/// \param is_wall of a facet, by its low and high corner
inline Cell_soup<3> box_cells(const std::vector<Box_cell>& boxes,
                              const std::function<bool(Box_cell)>& is_wall) {
  // The parts of the sides of boxes that lie in two of them, or in one.
  struct Rectangle {
    std::size_t box, axis;
    bool is_high;
    Box_cell at;
  };
  std::vector<Rectangle> rectangles;
  std::map<Point<3>, std::uint32_t> number;
  Cell_soup<3> soup;
  const auto add = [&](std::size_t box, std::size_t axis, bool is_high, const Box_cell& at) {
    rectangles.push_back({box, axis, is_high, at});
    for (int corner = 0; corner < 4; ++corner) {
      Point<3> x = at.low;
      if (corner & 1) x[(axis + 1) % 3] = at.high[(axis + 1) % 3];
      if (corner & 2) x[(axis + 2) % 3] = at.high[(axis + 2) % 3];
      if (number.try_emplace(x, static_cast<std::uint32_t>(soup.points.size())).second)
        soup.points.push_back(x);
    }
  };
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool is_high : {false, true}) {
        const Box_cell& box = boxes[b];
        const double plane = is_high ? box.high[axis] : box.low[axis];
        bool is_outer = true;
        for (const Box_cell& other : boxes) {
          Box_cell common;
          bool meets = (is_high ? other.low : other.high)[axis] == plane;
          for (std::size_t k = 0; k < 3; ++k) {
            common.low[k] = k == axis ? plane : std::max(box.low[k], other.low[k]);
            common.high[k] = k == axis ? plane : std::min(box.high[k], other.high[k]);
            meets = meets && (k == axis || common.low[k] < common.high[k]);
          }
          if (!meets) continue;
          is_outer = false;
          add(b, axis, is_high, common);
        }
        if (!is_outer) continue;
        Box_cell side = box;
        side.low[axis] = side.high[axis] = plane;
        add(b, axis, is_high, side);
      }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    for (const Rectangle& of : rectangles) {
      if (of.box != b) continue;
      // Counterclockwise seen from the high side: along both axes, and back.
      const std::size_t u = (of.axis + 1) % 3, v = (of.axis + 2) % 3;
      std::array<std::vector<Point<3>>, 4> sides;
      for (const Point<3>& x : soup.points) {
        bool is_in = true;
        for (std::size_t k = 0; k < 3; ++k) is_in = is_in && of.at.low[k] <= x[k] && x[k] <= of.at.high[k];
        if (!is_in) continue;
        if (x[v] == of.at.low[v] && x[u] != of.at.high[u]) sides[0].push_back(x);
        if (x[u] == of.at.high[u] && x[v] != of.at.high[v]) sides[1].push_back(x);
        if (x[v] == of.at.high[v] && x[u] != of.at.low[u]) sides[2].push_back(x);
        if (x[u] == of.at.low[u] && x[v] != of.at.low[v]) sides[3].push_back(x);
      }
      std::vector<std::uint32_t> loop;
      for (std::size_t k = 0; k < 4; ++k) {
        std::ranges::sort(sides[k]);
        if (k >= 2) std::ranges::reverse(sides[k]);
        for (const Point<3>& x : sides[k]) loop.push_back(number.at(x));
      }
      if (!of.is_high) std::ranges::reverse(loop);
      soup.add_facet(loop, is_wall(of.at));
    }
    soup.end_cell();
  }
  return soup;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_REGISTRATION_BOX_CELLS_H
