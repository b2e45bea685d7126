// SPDX-License-Identifier: LGPL-3.0-or-later
// Random places in free space, and random directions.
#ifndef CELLWALK_SIMULATION_BODIES_RANDOM_START_H
#define CELLWALK_SIMULATION_BODIES_RANDOM_START_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/random.h>

#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// Draws points uniformly from free space, whatever the shapes of its cells: a cell by the size of its box, a
/// point of the box, and both again unless the point lies in the cell.
template <int D>
class Free_space {
 public:
  struct Place {
    Point<D> position;
    Cell cell;
  };

  /// Refers to the snapshot, which must outlive it.
  /// Cost: a look at every cell.
  explicit Free_space(const Snapshot<D>& snapshot);

  bool is_empty() const { return cells_.empty(); }
  /// \pre not empty
  Place draw(Random& random) const;

 private:
  const Snapshot<D>& snapshot_;
  std::vector<std::uint32_t> cells_;
  std::vector<double> sum_;  ///< of the sizes of boxes, up to each cell
};

/// A random unit vector.
template <int D>
Vector<D> random_direction(Random& random);

extern template class Free_space<2>;
extern template class Free_space<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_RANDOM_START_H
