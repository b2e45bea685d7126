// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that become walls or passable, and cells that become solid or free, for a layer that keeps their
// residents. Theory: docs/cutting.md.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_WALL_EDITOR_H
#define CELLWALK_INTERNAL_ENVIRONMENT_WALL_EDITOR_H

#include <cellwalk/environment/environment.h>

#include <functional>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// Changes of an environment that leave its geometry alone, in map and snapshot. Names of cells and facets
/// are kept. Each change raises the epoch. Each change is atomic: an error leaves everything unchanged.
template <int D>
class Wall_editor {
 public:
  /// \pre no certificates of the environment are withdrawn while this changes anything
  explicit Wall_editor(Environment<D>& environment) : environment_(environment) {}

  const Snapshot<D>& snapshot() const { return *environment_.snapshot_; }

  /// \throw Error(usage) if the environment is frozen, or has no such facet
  void check(Half_facet facet) const;
  /// \throw Error(usage) if the environment is frozen, or has no such cell
  void check(Cell cell) const;

  /// Makes a facet a wall or passable.
  /// \pre check() accepts it; it does not lie on the boundary, and to be passable, does not part a solid cell
  ///      from a free one
  void set_wall(Half_facet facet, bool wall) { environment_.set_impassable(facet, wall); }

  /// The facets of a cell that are passable and lead to solid (free) cells.
  std::vector<Half_facet> passages(Cell cell, bool to_solid) const;

  /// Makes a free cell solid, and those passages walls.
  /// \param passages passages(cell, false)
  void fill(Cell cell, std::span<const Half_facet> passages);
  /// Makes a solid cell free: its facets to free cells become passable, those to solid ones walls.
  void excavate(Cell cell);
  /// Calls a function while passable facets are walls, and a free cell is solid, in the snapshot only; then
  /// all is as it was, and no epoch has risen.
  /// \param filled that cell, or none
  void with_walls(std::span<const Half_facet> walls, Cell filled, const std::function<void()>& use);

 private:
  void change(Cell turned, std::span<const Half_facet> closed, std::span<const Half_facet> opened);

  Environment<D>& environment_;
};

extern template class Wall_editor<2>;
extern template class Wall_editor<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_WALL_EDITOR_H
