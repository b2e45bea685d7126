// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the tissue of a snapshot lies: its solid cells, and the free ones at membranes. Cells that follow one
// another in the order of the snapshot form a run, and runs a group; each stores the box of its tissue. A cut
// finds the cells near its blade without a look at all of them.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_TISSUE_BOXES_H
#define CELLWALK_INTERNAL_ENVIRONMENT_TISSUE_BOXES_H

#include <cellwalk/internal/kernel/box.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace cellwalk {

enum class Cell : std::uint32_t;
template <int D>
class Snapshot;

}  // namespace cellwalk

namespace cellwalk::detail {

/// The boxes of a snapshot, each made when it is first needed. A copy has none yet.
/// Thread safety: const members may be called from any number of threads; one at a time searches.
template <int D>
class Tissue_boxes {
 public:
  Tissue_boxes() = default;
  Tissue_boxes(const Tissue_boxes&) {}
  Tissue_boxes& operator=(const Tissue_boxes&) {
    clear();
    return *this;
  }

  /// The cells of tissue in boxes that may be near, in the order of the snapshot: the caller's test must hold
  /// for each box that has a part for which it holds.
  /// Cost: about 0.2 us a cell where nothing is known yet; later that of some tests a run that is near, and
  /// of a test for each 4096 cells.
  std::vector<Cell> find(const Snapshot<D>& snapshot,
                         const std::function<bool(const Box<D>&)>& is_near) const;
  /// A cell changes: its walls or the positions of its vertices; or it goes or comes.
  void forget(Cell cell);
  void clear();

 private:
  struct Known_box {
    Box<D> box;
    bool is_known = false;
  };
  const Box<D>& box_of_run(const Snapshot<D>& snapshot, std::size_t run) const;
  const Box<D>& box_of_group(const Snapshot<D>& snapshot, std::size_t group) const;

  mutable std::mutex mutex_;
  mutable std::vector<Known_box> runs_, groups_;
};

extern template class Tissue_boxes<2>;
extern template class Tissue_boxes<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_TISSUE_BOXES_H
