// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact point location, for the start of a walk.
#ifndef CELLWALK_WALK_LOCATE_H
#define CELLWALK_WALK_LOCATE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/particle.h>

#include <memory>
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
  Cell cell = Cell::none;       ///< the free cell of lowest index whose closure holds the point
  std::uint16_t dimension = D;  ///< of the lowest cell of the complex it lies on: D inside, .. 0 on a vertex
  std::vector<Cell> cells;      ///< all free cells whose closure holds the point, by index
  /// Sides: classes of `cells` linked at the point (joined by passable facets that contain it). More than
  /// one: the point lies on a wall or pinch with free space on several sides, and `cell` is an arbitrary but
  /// fixed choice.
  int sides = 0;
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

  /// A particle at p, or Cell::none as its cell where p is not in free space.
  Particle<D> particle_at(const Point<D>& p) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

extern template class Locator<2>;
extern template class Locator<3>;

}  // namespace cellwalk

#endif  // CELLWALK_WALK_LOCATE_H
