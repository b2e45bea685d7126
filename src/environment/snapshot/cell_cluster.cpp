// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes rounded outwards into the float frame, packed four by four.
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/cell_cluster.h>

#include <algorithm>
#include <utility>

namespace cellwalk::detail {
namespace {

/// The map into the frame and the conversion are off by less than an ulp of 1.
constexpr double mapping_error = 0x1p-23;

/// A coordinate in the frame, of a point anywhere: nothing of the environment lies outside the frame. In one
/// that maps nothing, all boxes meet, and walls are cut off by their coordinates alone.
template <int D>
double mapped(const Plane_frame<D>& frame, const Point<D>& x, std::size_t k) {
  const double t = (x[k] - frame.centre[k]) * frame.scale;
  return t > -1 ? std::min(t, 1.0) : -1;
}

inline float below(double x) { return static_cast<float>(x - mapping_error); }
inline float above(double x) { return static_cast<float>(x + mapping_error); }

template <int D>
void set_box(Facet_boxes<D>& boxes, std::size_t lane, const Plane_frame<D>& frame, const Box<D>& box,
             std::uint32_t facet) {
  for (std::size_t k = 0; k < D; ++k) {
    boxes.low[k][lane] = below(mapped<D>(frame, box.low, k));
    boxes.high[k][lane] = above(mapped<D>(frame, box.high, k));
  }
  boxes.facets[lane] = facet;
}

}  // namespace

template <int D>
Frame_box<D>::Frame_box(const Plane_frame<D>& frame, const Box<D>& box) {
  for (std::size_t k = 0; k < D; ++k) {
    const float l = below(mapped<D>(frame, box.low, k)), h = above(mapped<D>(frame, box.high, k));
    low[k] = Float4{l, l, l, l};
    high[k] = Float4{h, h, h, h};
  }
}

template <int D>
std::unique_ptr<const Cell_cluster<D>> make_cluster(const Snapshot<D>& snapshot, std::uint32_t number,
                                                    std::uint32_t size) {
  const std::size_t slots = snapshot.half_facet_slots() / 4;
  const std::uint32_t begin = number * size;
  const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(slots, begin + size));
  Cell_cluster<D> cluster;
  std::size_t walls = 0;
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
        if (walls % 4 == 0) cluster.walls.emplace_back();
        set_box(cluster.walls.back().boxes, walls % 4, snapshot.frame(), box, to_index(f));
        cluster.walls.back().set_plane(walls++ % 4, snapshot.blocks(cell)[i / 4], i % 4);
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
  cluster.walls.shrink_to_fit();
  cluster.passages.assign((neighbours.size() + 3) / 4, Facet_boxes<D>::none());
  for (std::size_t n = 0; n < neighbours.size(); ++n)
    set_box(cluster.passages[n / 4], n % 4, snapshot.frame(), neighbours[n].second, neighbours[n].first);
  return std::make_unique<const Cell_cluster<D>>(std::move(cluster));
}

template struct Frame_box<2>;
template struct Frame_box<3>;
template std::unique_ptr<const Cell_cluster<2>> make_cluster(const Snapshot<2>&, std::uint32_t,
                                                             std::uint32_t);
template std::unique_ptr<const Cell_cluster<3>> make_cluster(const Snapshot<3>&, std::uint32_t,
                                                             std::uint32_t);

}  // namespace cellwalk::detail
