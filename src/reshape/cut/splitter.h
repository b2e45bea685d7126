// SPDX-License-Identifier: LGPL-3.0-or-later
// The two changes of cells that a cut is made of: an edge of solid cells that is split, and a vertex from
// which solid cells are taken back. Theory: docs/cutting.md.
#ifndef CELLWALK_RESHAPE_CUT_SPLITTER_H
#define CELLWALK_RESHAPE_CUT_SPLITTER_H

#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/reshape/move.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reshape/replace/cell_transaction.h"
#include "reshape/toggle/toggle.h"

namespace cellwalk::detail {

/// \pre of all members: no certificates of the environment are withdrawn
template <int D>
class Splitter {
 public:
  Splitter(Cell_transaction<D>& transaction, Toggle<D>& toggle)
      : transaction_(transaction), toggle_(toggle) {}

  /// Opens the groups near the cells at an edge, so that nothing that is split there can be refused for them.
  /// \throw Error(usage) for a particle that does not lie in its cell
  void open_groups(std::uint32_t u, std::uint32_t v);

  /// The behaviour of walls at an edge that is split.
  enum class Walls : std::uint8_t {
    /// Solid retreats: the point lies on the free side of no wall. No wall there parts free cells from each
    /// other, free cells meet the edge on one side only, and no body's face rests on a wall there.
    retreat,
    /// Membranes go wherever the point is: all that is registered in the free cells around can be in others,
    /// and is then, and no face lies near. From walls to solid, solid retreats.
    move_among_nothing
  };

  /// Splits an edge of walls at a point near it, or some units in the last place off that into the solid. It
  /// lies on the planes of all boundary facets at the edge, and on the free side of no wall between solid and
  /// free. Returns the new point; none if the walls would do otherwise, or a cell would be flat or inverted.
  std::optional<std::uint32_t> split_edge(std::uint32_t u, std::uint32_t v, const Point<D>& position,
                                          Walls walls);

  /// Takes solid cells back from a vertex: they get another vertex instead, and free cells fill the gap that
  /// they leave. Its facets to free cells become passable. Returns the new vertex, or why it cannot be made.
  /// \param solid joined through facets at the vertex, those between them all passable or all not
  std::optional<std::uint32_t> split_vertex(std::uint32_t vertex, std::span<const Cell> solid,
                                            const Point<D>& target, std::string& reason);

  const Snapshot<D>& snapshot() const { return transaction_.snapshot(); }

 private:
  static constexpr std::size_t corner_count = static_cast<std::size_t>(D) + 1;
  /// The number of times that the shift of a point into the solid is doubled, from one unit in the last
  /// place.
  static constexpr int most_shifts = 8;
  using Simplex = std::array<std::uint32_t, corner_count>;
  /// A facet of a simplex that lacks one of its corners.
  bool is_wall_off(Cell cell, std::uint32_t corner) const;
  std::vector<Cell> cells_at(std::uint32_t u, std::uint32_t v) const;
  bool may_move_walls(std::span<const Cell> cells, std::uint32_t u, std::uint32_t v,
                      const Point<D>& position) const;
  bool keeps_solid_off(std::span<const Cell> cells, const std::array<std::uint32_t, 2>& edge,
                       const Point<D>& position) const;
  Vector<D> into_solid(std::uint32_t u, std::uint32_t v) const;
  std::optional<std::uint32_t> split_at(std::uint32_t u, std::uint32_t v, const Point<D>& position,
                                        Walls walls);
  bool is_positive(const Simplex& cell, std::uint32_t moved, const Point<D>& position) const;

  Cell_transaction<D>& transaction_;
  Toggle<D>& toggle_;
};

extern template class Splitter<2>;
extern template class Splitter<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_CUT_SPLITTER_H
