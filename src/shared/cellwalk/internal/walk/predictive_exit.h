// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's forecast of the exit of a cell. Paper: section II.
#ifndef CELLWALK_INTERNAL_WALK_PREDICTIVE_EXIT_H
#define CELLWALK_INTERNAL_WALK_PREDICTIVE_EXIT_H

#include <cellwalk/internal/walk/signs.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cellwalk::detail {

/// Turns from facet to facet across the ridge that the target b lies beyond, until it lies in the cone of the
/// facet over the start a. Crossing a ridge strictly lowers the time at which the line meets the plane, so
/// the turns end; among coplanar facets of one cell they need not, and the rule takes over after a full
/// round. None where the rule has to decide.
/// \param aimed the facet to begin with, and the one found
template <class Kernel, int D>
std::optional<Exit> predictive_exit(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b,
                                    std::uint16_t& aimed, Walk_counts& counts) {
  const std::size_t facets = cell.facet_count();
  std::size_t i = aimed < facets ? aimed : 0;
  // The cone of a facet is over the start only if the start lies strictly on its inner side.
  for (std::size_t k = 0; side<Kernel>(cell, i, a, counts) >= 0; ++k) {
    if (k == facets) return {};
    i = i + 1 == facets ? 0 : i + 1;
  }
  for (std::size_t turns = 0; turns <= 2 * facets; ++turns) {
    const auto loop = cell.loop(i);
    std::size_t beyond = loop.size();
    bool zero = false;
    for (std::size_t k = 0; k < loop.size() && beyond == loop.size(); ++k) {
      const int s = along<Kernel>(cell, i, k, a, b, counts);
      if (s < 0) beyond = k;
      zero |= s == 0;
    }
    if (beyond == loop.size()) {
      aimed = static_cast<std::uint16_t>(i);
      const int s = side<Kernel>(cell, i, b, counts);
      if (s < 0 && !zero) return Exit{Exit::arrived};
      if (s > 0) return exit_through(cell, i, Line<Kernel, D>{a, b, counts});
      return {};  // on the facet, or on the boundary of its cone: which cell is lowest?
    }
    ++counts.turns;
    const std::size_t next = facet_across(cell, i, beyond);
    if (next == facets) break;
    i = next;
  }
  return {};
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_WALK_PREDICTIVE_EXIT_H
