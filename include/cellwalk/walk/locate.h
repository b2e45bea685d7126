// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles, and exact point location for the start of their walks.
#ifndef CELLWALK_WALK_LOCATE_H
#define CELLWALK_WALK_LOCATE_H

#include <cellwalk/environment/snapshot.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cellwalk {

/// Position, cell, dimension of the lowest cell that contains it, and the facet it aims at (a half-facet
/// identifies the aimed-at dart; with the position it spans the predictive simplex). Invariant I1: the
/// position lies in the closure of the cell.
template <int D>
struct Particle {
  Point<D> position;
  Cell cell = Cell::none;
  std::uint16_t dimension = D;  ///< D: interior of the cell .. 0: on a vertex
  std::uint16_t aimed = 0;      ///< the facet of the cell at which it aims
};

/// True if a point lies in the closure of a cell, by exact predicates: invariant I1 of a particle. False if
/// the cell does not exist (any more), or a coordinate is not finite.
template <int D>
bool in_closure(const Snapshot<D>& snapshot, Cell cell, const Point<D>& point);

enum class Location_status {
  free,    ///< in the closure of a free cell
  solid,   ///< only in closures of solid cells
  outside  ///< in no cell
};

/// The location of a point.
template <int D>
struct Location {
  Location_status status = Location_status::outside;
  Cell cell = Cell::none;  ///< a free cell whose closure contains the point: the first one of the first side
  /// Of the lowest cell of the complex that contains it: D inside, .. 0 on a vertex.
  std::uint16_t dimension = D;
  /// All free cells whose closure contains the point, side after side, each by index.
  std::vector<Cell> cells;
  std::vector<int> side_of_cell;  ///< for each of these cells, the number of its side
  /// A particle for each side, in its first cell. Sides are classes of cells linked at the point (joined by
  /// passable facets that contain it). There are several if the point lies on a wall or pinch with free space
  /// on several sides. The first side is that on which the displaced point lies, see displaced_side(), if
  /// that is free; the others are in the order of their least corners. So the order does not depend on the
  /// numbering of cells.
  std::vector<Particle<D>> sides;
};

/// Exact point location by an R-tree over the bounding boxes of cells. Refers to the snapshot, which must
/// outlive it. Facets may be opened and closed; after other edits a new locator must be made.
template <int D>
class Locator {
 public:
  /// Cost: about 0.5 us a cell.
  explicit Locator(const Snapshot<D>& snapshot);
  explicit Locator(const Snapshot<D>&& snapshot) = delete;
  ~Locator();
  Locator(Locator&&) noexcept;
  Locator& operator=(Locator&&) noexcept;

  /// Exact in every position, also in disconnected free space.
  /// \throw Error(usage) if points were moved or cells replaced since the locator was made; Error(input) for
  ///        a point that is not finite
  /// Cost: about 1 us (logarithmic in the number of cells).
  Location<D> locate(const Point<D>& p) const;

  /// A particle at p, on the first side of the walls there. None if p is not in free space.
  std::optional<Particle<D>> particle_at(const Point<D>& p) const;

  /// A particle for each side of the walls at p, in order. Empty if p is not in free space.
  std::vector<Particle<D>> particles_at(const Point<D>& p) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

extern template class Locator<2>;
extern template class Locator<3>;

}  // namespace cellwalk

#endif  // CELLWALK_WALK_LOCATE_H
