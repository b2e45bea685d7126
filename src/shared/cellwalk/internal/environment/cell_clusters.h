// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls of many cells at once: cells that follow one another in the order of the snapshot form a
// cluster, which has the boxes of its walls and of its passages to other clusters. A flood of clusters finds
// the walls near a box without a look at the cells between. Theory: docs/bodies.md, clearance.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTERS_H
#define CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTERS_H

#include <atomic>
#include <cstdint>

namespace cellwalk {

enum class Cell : std::uint32_t;
template <int D>
class Snapshot;

}  // namespace cellwalk

namespace cellwalk::detail {

template <int D>
struct Cell_cluster;

/// The clusters of a snapshot, each made when it is first needed. A copy has none yet.
/// Thread safety: const members may be called from any number of threads.
template <int D>
class Cell_clusters {
 public:
  Cell_clusters() = default;
  Cell_clusters(const Cell_clusters&) noexcept {}
  Cell_clusters& operator=(const Cell_clusters&) noexcept {
    clear();
    return *this;
  }
  ~Cell_clusters() { clear(); }

  /// How many there are.
  std::uint32_t size(const Snapshot<D>& snapshot) const;
  /// The number of a cell's cluster, of the snapshot that has these clusters.
  std::uint32_t cluster_of(const Snapshot<D>& snapshot, Cell cell) const;
  const Cell_cluster<D>& cluster(const Snapshot<D>& snapshot, std::uint32_t number) const;
  /// Into how many names of cells each the snapshot was divided, and for how many clusters there is room; 0
  /// if none was needed yet.
  void tell(std::uint32_t& size, std::uint64_t& places) const;
  /// Divides it so. False if that is not for this snapshot.
  /// \pre none was needed yet
  bool lay_out(const Snapshot<D>& snapshot, std::uint32_t size, std::uint64_t places);
  /// A cell changes: its walls, its neighbours, or the positions of its vertices; or it goes or comes.
  void forget(Cell cell);
  /// Names may have been given out beyond those that there were.
  void follow_slots(const Snapshot<D>& snapshot);
  void clear();

 private:
  struct Table;
  const Table& table(const Snapshot<D>& snapshot) const;

  mutable std::atomic<Table*> table_{nullptr};
};

extern template class Cell_clusters<2>;
extern template class Cell_clusters<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_CELL_CLUSTERS_H
