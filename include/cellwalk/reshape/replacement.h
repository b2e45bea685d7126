// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells of an environment that are replaced by others over the same region, among bodies and particles.
// Theory: docs/cutting.md, replacing cells.
#ifndef CELLWALK_RESHAPE_REPLACEMENT_H
#define CELLWALK_RESHAPE_REPLACEMENT_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/reshape/move.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cellwalk {

/// The outcome of a replacement of cells by others that cover the same region.
struct Replacement : Outcome {
  static constexpr std::uint32_t none = 0xffffffffu;

  std::vector<Cell> cells;  ///< the new ones
  /// The point inserted, or the one removed, whose index later points may get; `none` for flips.
  std::uint32_t point = none;
};

/// The cells that Reshaping::relax() looks at, and the operations that it may try. The quality of a
/// tetrahedron of volume V is 6 sqrt(2) V / l^3, l being the root mean square of its edges; the quality of a
/// triangle of area A is 4 sqrt(3) A / (sum of squares of its edges). It is 1 if regular, 0 if flat.
struct Relax_options {
  double good_enough = 0.3;  ///< cells of at least this quality are left alone
  int most_rounds = 4;       ///< through all cells that are not good enough
  /// The largest number of operations.
  std::uint32_t most_operations = 1000;
  bool smooth = true, flip = true, split = true, collapse = true;
  /// Edges longer than this are split, shorter ones collapsed, in units of the mean of all edges around the
  /// points, measured at the start.
  double longest = 2, shortest = 0.4;
  /// Points that stay: they are not moved, and not removed, so that they keep their indices.
  std::vector<std::uint32_t> keep{};
};

/// The outcome of Reshaping::relax().
struct Relax_report {
  std::uint32_t smoothed = 0, flipped = 0, edges_removed = 0, split = 0, collapsed = 0;
  std::uint32_t tried = 0;   ///< cells that were not good enough
  std::uint32_t rounds = 0;  ///< made
  /// The least quality of the cells around the points, before and after.
  double least_before = 0, least_after = 0;

  std::uint32_t operations() const { return smoothed + flipped + edges_removed + split + collapsed; }
};

}  // namespace cellwalk

#endif  // CELLWALK_RESHAPE_REPLACEMENT_H
