// SPDX-License-Identifier: LGPL-3.0-or-later
// Any change of an environment, most of them near what lies in it, and whether it was made.
#ifndef CELLWALK_TESTS_RESHAPE_RANDOM_CHANGE_H
#define CELLWALK_TESTS_RESHAPE_RANDOM_CHANGE_H

#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reshape/grids.h"
#include "reshape/toggle_world.h"

namespace cellwalk::test {

/// One change, described before it is made, so that it can be tried again.
template <int D>
struct Random_change {
  static constexpr std::array names{"open",       "close",        "excavate",     "fill",        "flip",
                                    "split_edge", "split_vertex", "remove_edge",  "collapse",    "merge",
                                    "move",       "ask",          "insert_point", "split beside"};
  std::size_t kind = 0;
  Cell cell = Cell::none;
  Half_facet facet = Half_facet::none;
  std::uint32_t u = 0, v = 0;
  Point<D> target{};

  explicit Random_change(Toggle_world<D>& world) {
    Random& random = world.random;
    const Snapshot<D>& s = world.snapshot;
    kind = random.below(names.size());
    cell = world.cell();
    // Solid cells are excavated and peeled.
    for (int tries = 0; tries < 20 && (kind == 2 || kind == 6) && !s.is_solid(cell); ++tries) {
      cell = Cell::none;
      while (cell == Cell::none) cell = s.cell(random.below(s.cell_slots()));
    }
    facet = Snapshot<D>::half_facet(cell, random.below(D + 1));
    const auto vertices = s.view(cell).vertices;
    const std::size_t first = random.below(D + 1);
    u = vertices[first];
    v = vertices[(first + 1 + random.below(D)) % (D + 1)];
    const Point<D>&x = s.point(u), &y = s.point(v);
    target = x + 0.5 * (y - x);
    if (kind == 6 || (kind == 12 && random.chance(0.7)) || random.chance(0.2)) target = middle_of(s, cell);
    if (kind == 10 || kind == 11) target = x + (0.25 * static_cast<double>(random.below(5))) * (target - x);
    if (kind == 13) target = target + 0.0625 * (middle_of(s, cell) - target);
  }

  bool make(Reshaping<D>& by) const {
    switch (kind) {
      case 0:
        return by.open(facet).is_made;
      case 1:
        return by.close(facet).is_made;
      case 2:
        return by.excavate(cell).is_made;
      case 3:
        return by.fill(cell).is_made;
      case 4:
        return by.flip(facet).is_made;
      case 6:
        return by.split_vertex(u, std::array{cell}, target).is_made;
      case 7:
        return by.remove_edge(u, v).is_made;
      case 8:
        return by.collapse(u, v).is_made;
      case 9:
        return by.merge_vertices(u, v).is_made;
      case 10:
        return by.move(u, target).end == Move_end::reached;
      case 11:
        return by.test_move(u, target).end == Move_end::reached && false;
      case 12:
        return by.insert_point(cell, target).is_made;
      default:
        return by.split_edge(u, v, target).is_made;
    }
  }
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_RANDOM_CHANGE_H
