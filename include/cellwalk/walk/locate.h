// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact point location, for the start of a walk.
#ifndef CELLWALK_WALK_LOCATE_H
#define CELLWALK_WALK_LOCATE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/particle.h>

#include <memory>
#include <optional>
#include <vector>

namespace cellwalk {

enum class Location_status {
  free,    ///< in the closure of a free cell
  solid,   ///< only in closures of solid cells
  outside  ///< in no cell
};

/// Where a point lies.
template <int D>
struct Location {
  Location_status status = Location_status::outside;
  Cell cell = Cell::none;  ///< a free cell whose closure holds the point: the first one of the first side
  std::uint16_t dimension = D;  ///< of the lowest cell of the complex it lies on: D inside, .. 0 on a vertex
  std::vector<Cell>
      cells;  ///< all free cells whose closure holds the point, side by side, each side by index
  std::vector<int> side_of_cell;  ///< for each of them, the number of its side
  /// A particle for each side, in its first cell. Sides are classes of cells linked at the point (joined by passable facets
  /// that contain it). More than one: the point lies on a wall or pinch with free space on several sides. The first side is that
  /// on which the point lies once it is displaced, see displaced_side(), where that is free; then they are in the order of
  /// their least corners. So the order does not depend on how cells are numbered.
  std::vector<Particle<D>> sides;
};

/// An R-tree over the cells' boxes, and exact signs. Refers to the snapshot, which must outlive it. Facets may be opened and
/// closed; after other edits a new one must be made.
template <int D>
class Locator {
 public:
  /// Cost: about 0.5 us a cell.
  explicit Locator(const Snapshot<D>& snapshot);
  ~Locator();
  Locator(Locator&&) noexcept;
  Locator& operator=(Locator&&) noexcept;

  /// \pre p is finite. Exact in every position; correct in disconnected free space.
  /// \throw Error(usage) if points were moved or cells replaced since it was made
  /// Cost: about 1 us (logarithmic in the number of cells).
  Location<D> locate(const Point<D>& p) const;

  /// A particle at p, on the first side of the walls there. None where p is not in free space.
  std::optional<Particle<D>> particle_at(const Point<D>& p) const;

  /// A particle for each side of the walls at p, in order. None where p is not in free space.
  std::vector<Particle<D>> particles_at(const Point<D>& p) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

extern template class Locator<2>;
extern template class Locator<3>;

}  // namespace cellwalk

#endif  // CELLWALK_WALK_LOCATE_H
