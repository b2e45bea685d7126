// SPDX-License-Identifier: LGPL-3.0-or-later
// Writes cells into the arrays of a snapshot: all of them when it is compiled, a few when it is edited.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H

#include <cellwalk/environment/snapshot.h>

#include <cstdint>
#include <mutex>
#include <vector>

#include "canonical_shape.h"

namespace cellwalk {

template <int D>
class Snapshot_compiler {
 public:
  explicit Snapshot_compiler(Snapshot<D>& snapshot) : s_(snapshot) {}

  /// Writes a canonical cell into the blocks from `block` on and the vertices from `vertex` on.
  void write_cell(const Canonical_cell& cell, std::uint32_t block, std::uint32_t vertex, std::uint32_t index,
                  bool solid);
  /// Marks a cell as removed: everything is outside of it, and walls are all round. What it holds stays in
  /// bounds.
  void remove_cell(Cell c);
  /// Where the first three vertices of a facet's loop lie on one line, turns it so that they do not, if it
  /// has three that do not.
  void turn_loops(Cell c);
  /// Recomputes the planes of a cell. Returns how many could not be certified.
  std::size_t write_planes(Cell c);
  /// How many of the planes of a cell, as they are, certify nothing. None of a cell that was just written has
  /// a plane yet: 0.
  std::size_t count_uncertified(Cell c) const;
  /// Recomputes the convex-pair bit of a facet on both sides. One thread per facet.
  void write_convex_pair(Half_facet f);
  /// Links two half-facets; wall marks both.
  void link(Half_facet f, Half_facet g, bool wall);
  void link_boundary(Half_facet f);

  static constexpr std::size_t blocks_for(std::size_t facets) { return (facets + 3) / 4; }

 private:
  /// The number of a shape, added if new. Thread-safe.
  std::uint32_t shape_number(const Cell_shape& shape);
  /// No facets, no neighbours.
  void clear_block(std::uint32_t block);

  Snapshot<D>& s_;
  std::mutex shapes_mutex_;
};

extern template class Snapshot_compiler<2>;
extern template class Snapshot_compiler<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_COMPILER_H
