// SPDX-License-Identifier: LGPL-3.0-or-later
// The layout of clusters by the number of walls, made on demand by any thread.
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_cluster.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace cellwalk::detail {
namespace {

/// The mean number of walls of a cluster,
constexpr std::size_t walls_a_cluster = 48;
/// and the bounds of its number of blocks of cells.
constexpr std::size_t least_size = 16, most_size = std::size_t{1} << 14;
/// The number of blocks, at even distances, from which the number of walls is estimated.
constexpr std::size_t samples = 4096;
/// The table has room for this share of further names.
constexpr std::size_t share_of_room = 4;

template <int D>
std::uint32_t cluster_size(const Snapshot<D>& snapshot) {
  const std::size_t slots = snapshot.half_facet_slots() / 4, stride = slots / samples + 1;
  std::size_t seen = 0, walls = 0;
  for (std::size_t b = 0; b < slots; b += stride) {
    const Cell cell{static_cast<std::uint32_t>(b)};
    if (!snapshot.is_cell(cell) || snapshot.is_solid(cell)) continue;
    seen += snapshot.block_count(cell);
    for (std::size_t i = 0; i < snapshot.facet_count(cell); ++i)
      walls += snapshot.is_impassable(Snapshot<D>::half_facet(cell, i));
  }
  const std::size_t size = walls == 0 ? most_size : walls_a_cluster * seen / walls;
  return static_cast<std::uint32_t>(std::clamp(size, least_size, most_size));
}

/// Of two threads that make the same, the second takes the result of the first.
template <class T>
T& publish(std::atomic<T*>& place, std::unique_ptr<T> made) {
  T* expected = nullptr;
  if (place.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
  return *expected;
}

}  // namespace

template <int D>
struct Cell_clusters<D>::Table {
  explicit Table(const Snapshot<D>& snapshot)
      : size(cluster_size(snapshot)), made(number_of(snapshot) + number_of(snapshot) / share_of_room + 1) {}
  Table(std::uint32_t of_size, std::size_t places) : size(of_size), made(places) {}
  ~Table() {
    for (const auto& cluster : made) delete cluster.load();
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  /// The number of clusters whose names are given out.
  std::size_t number_of(const Snapshot<D>& snapshot) const {
    return snapshot.half_facet_slots() / 4 / size + 1;
  }

  const std::uint32_t size;  ///< names of cells a cluster
  std::vector<std::atomic<const Cell_cluster<D>*>> made;
};

template <int D>
void Cell_clusters<D>::clear() {
  delete table_.exchange(nullptr);
}

template <int D>
void Cell_clusters<D>::tell(std::uint32_t& size, std::uint64_t& places) const {
  const Table* table = table_.load();
  size = table ? table->size : 0;
  places = table ? table->made.size() : 0;
}

template <int D>
bool Cell_clusters<D>::lay_out(const Snapshot<D>& snapshot, std::uint32_t size, std::uint64_t places) {
  const std::uint64_t needed = snapshot.half_facet_slots() / 4 / std::max<std::uint32_t>(1, size) + 1;
  if (size < least_size || size > most_size || places < needed || places > 2 * needed + 1) return false;
  clear();
  table_.store(std::make_unique<Table>(size, static_cast<std::size_t>(places)).release());
  return true;
}

template <int D>
void Cell_clusters<D>::follow_slots(const Snapshot<D>& snapshot) {
  if (const Table* table = table_.load(); table && table->made.size() < table->number_of(snapshot)) clear();
}

template <int D>
void Cell_clusters<D>::forget(Cell cell) {
  if (Table* table = table_.load()) delete table->made[to_index(cell) / table->size].exchange(nullptr);
}

template <int D>
const typename Cell_clusters<D>::Table& Cell_clusters<D>::table(const Snapshot<D>& snapshot) const {
  const Table* made = table_.load(std::memory_order_acquire);
  return made ? *made : publish(table_, std::make_unique<Table>(snapshot));
}

template <int D>
std::uint32_t Cell_clusters<D>::size(const Snapshot<D>& snapshot) const {
  return static_cast<std::uint32_t>(table(snapshot).number_of(snapshot));
}

template <int D>
std::uint32_t Cell_clusters<D>::cluster_of(const Snapshot<D>& snapshot, Cell cell) const {
  return to_index(cell) / table(snapshot).size;
}

template <int D>
const Cell_cluster<D>& Cell_clusters<D>::cluster(const Snapshot<D>& snapshot, std::uint32_t number) const {
  Table& all = const_cast<Table&>(table(snapshot));
  if (const Cell_cluster<D>* made = all.made[number].load(std::memory_order_acquire)) return *made;
  return publish(all.made[number], make_cluster(snapshot, number, all.size));
}

template class Cell_clusters<2>;
template class Cell_clusters<3>;

}  // namespace cellwalk::detail
