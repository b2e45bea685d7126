// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_clusters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace cellwalk::detail {
namespace {

/// A cluster should have so many walls on average,
constexpr std::size_t walls_a_cluster = 48;
/// and so many blocks of cells.
constexpr std::size_t least_size = 16, most_size = std::size_t{1} << 14;
/// So many blocks, at even distances, tell how many walls there are.
constexpr std::size_t samples = 4096;

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

/// The map into the frame and the conversion are off by less than an ulp of 1.
constexpr double mapping_error = 0x1p-23;

inline float below(double x) { return static_cast<float>(x - mapping_error); }
inline float above(double x) { return static_cast<float>(x + mapping_error); }

/// The boxes of facets, four by four.
template <int D>
class Packed_boxes {
 public:
  void add(const Plane_frame<D>& frame, const Box<D>& box, std::uint32_t facet) {
    const std::size_t lane = count_++ % 4;
    if (lane == 0) {
      Facet_boxes<D> empty;
      const float far = std::numeric_limits<float>::infinity();
      for (std::size_t k = 0; k < D; ++k) {
        empty.low[k] = Float4{far, far, far, far};
        empty.high[k] = -empty.low[k];
      }
      empty.facets.fill(0);
      boxes_.push_back(empty);
    }
    Facet_boxes<D>& last = boxes_.back();
    for (std::size_t k = 0; k < D; ++k) {
      last.low[k][lane] = below((box.low[k] - frame.centre[k]) * frame.scale);
      last.high[k][lane] = above((box.high[k] - frame.centre[k]) * frame.scale);
    }
    last.facets[lane] = facet;
  }
  std::vector<Facet_boxes<D>> boxes() && {
    boxes_.shrink_to_fit();
    return std::move(boxes_);
  }

 private:
  std::vector<Facet_boxes<D>> boxes_;
  std::size_t count_ = 0;
};

template <int D>
std::unique_ptr<const Cell_cluster<D>> made_cluster(const Snapshot<D>& snapshot, std::uint32_t number,
                                                    std::uint32_t size) {
  const std::size_t slots = snapshot.half_facet_slots() / 4;
  const std::uint32_t begin = number * size;
  const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(slots, begin + size));
  Packed_boxes<D> walls, passages;
  std::vector<std::pair<std::uint32_t, Box<D>>> neighbours;
  for (std::uint32_t b = begin; b < end; ++b) {
    const Cell cell{b};
    if (!snapshot.is_cell(cell) || snapshot.is_solid(cell)) continue;
    const Cell_view<D> view = snapshot.view(cell);
    for (std::size_t i = 0; i < view.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(cell, i);
      const bool is_wall = snapshot.is_impassable(f);
      const Cell next = is_wall ? Cell::none : snapshot.neighbour(f);
      if (!is_wall && (next == Cell::none || to_index(next) / size == number)) continue;
      Box<D> box;
      for (const std::uint16_t v : view.loop(i)) box.extend(view.point(v));
      if (is_wall) {
        walls.add(snapshot.frame(), box, to_index(f));
        continue;
      }
      const std::uint32_t other = to_index(next) / size;
      const auto known = std::ranges::find(neighbours, other, &std::pair<std::uint32_t, Box<D>>::first);
      if (known == neighbours.end())
        neighbours.emplace_back(other, box);
      else
        known->second.extend(box);
    }
  }
  for (const auto& [other, box] : neighbours) passages.add(snapshot.frame(), box, other);
  return std::make_unique<const Cell_cluster<D>>(
      Cell_cluster<D>{std::move(walls).boxes(), std::move(passages).boxes()});
}

/// Of two threads that make the same, the second takes what the first made.
template <class T>
T& publish(std::atomic<T*>& place, std::unique_ptr<T> made) {
  T* expected = nullptr;
  if (place.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *made.release();
  return *expected;
}

}  // namespace

template <int D>
Frame_box<D>::Frame_box(const Plane_frame<D>& frame, const Box<D>& box) {
  for (std::size_t k = 0; k < D; ++k) {
    // Nothing of the environment lies outside its frame.
    const auto map = [&](double x) { return std::clamp((x - frame.centre[k]) * frame.scale, -1.0, 1.0); };
    const float l = below(map(box.low[k])), h = above(map(box.high[k]));
    low[k] = Float4{l, l, l, l};
    high[k] = Float4{h, h, h, h};
  }
}

template <int D>
struct Cell_clusters<D>::Table {
  explicit Table(const Snapshot<D>& snapshot)
      : size(cluster_size(snapshot)), made(snapshot.half_facet_slots() / 4 / size + 1) {}
  ~Table() {
    for (const auto& cluster : made) delete cluster.load();
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  const std::uint32_t size;  ///< names of cells a cluster
  std::vector<std::atomic<const Cell_cluster<D>*>> made;
};

template <int D>
void Cell_clusters<D>::clear() {
  delete table_.exchange(nullptr);
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
std::uint32_t Cell_clusters<D>::cluster_of(const Snapshot<D>& snapshot, Cell cell) const {
  return to_index(cell) / table(snapshot).size;
}

template <int D>
const Cell_cluster<D>& Cell_clusters<D>::cluster(const Snapshot<D>& snapshot, std::uint32_t number) const {
  Table& all = const_cast<Table&>(table(snapshot));
  if (const Cell_cluster<D>* made = all.made[number].load(std::memory_order_acquire)) return *made;
  return publish(all.made[number], made_cluster(snapshot, number, all.size));
}

template struct Frame_box<2>;
template struct Frame_box<3>;
template class Cell_clusters<2>;
template class Cell_clusters<3>;

}  // namespace cellwalk::detail
