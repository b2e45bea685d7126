// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/certain_triangle.h>

#include <cmath>

namespace cellwalk::detail {
namespace {

/// The normal of a triangle in the frame, divided by the sum of the sizes of its coordinates; zero if it is
/// nearly a segment.
Vector<3> unit_normal(const Plane_frame<3>& frame, const Swept_triangle<3>& t) {
  // By which the size of the normal may fall short of the product of those of two sides.
  constexpr double least_sine = 0x1p-20;
  const Vector<3> d = frame.scale * (t.b - t.a), e = frame.scale * (t.q - t.a), n = cross(d, e);
  const auto size = [](const Vector<3>& x) { return std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]); };
  return size(n) > least_sine * size(d) * size(e) ? (1 / size(n)) * n : Vector<3>{};
}

}  // namespace

template <int D>
Certain_triangle<D>::Certain_triangle(const Plane_frame<D>& frame, const Swept_triangle<D>& triangle)
    : corners_(triangle),
      is_certain_(frame.map(corners_.a, mapped_[0]) & frame.map(corners_.b, mapped_[1]) &
                  frame.map(corners_.q, mapped_[2])),
      third_(spread<D>(mapped_[2])),
      lines_{Certain_line<D>(frame, corners_.a, mapped_[0]), Certain_line<D>(frame, corners_.b, mapped_[1]),
             Certain_line<D>(frame, corners_.a, mapped_[0])} {
  if (!is_certain_) return;
  lines_[0].lead_to(corners_.b, false);
  lines_[1].lead_to(corners_.q, false);
  lines_[2].lead_to(corners_.q, false);
  for (const Certain_line<D>& line : lines_) is_certain_ &= line.is_certain();
  if constexpr (D == 3)
    if (is_certain_) {
      const Vector<3> normal = unit_normal(frame, corners_);
      normal_ = spread<3>(
          {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
    }
}

template <int D>
auto Certain_triangle<D>::sides(const Plane_block<D>& block) const -> Plane_sides {
  Plane_sides sides;
  const std::array<const Spread_point<D>*, 3> corners{&lines_[0].start(), &lines_[1].start(), &third_};
  for (std::size_t i = 0; i < 3; ++i) {
    const Float4 distance = evaluate<D>(block, *corners[i]);
    sides.before[i] = lane_mask(distance < -plane_error);
    sides.beyond[i] = lane_mask(distance > plane_error);
  }
  return sides;
}

template <int D>
auto Certain_triangle<D>::heights(const Facet_corners<D>& corners) const -> typename Certain_line<D>::Sides {
  constexpr float unit = 0x1p-24F;
  Float4 height{}, size{};
  for (std::size_t k = 0; k < D; ++k) {
    const Float4 w = corners.lanes[k] - lines_[0].start()[k];
    height += normal_[k] * w;
    size += std::bit_cast<Float4>(std::bit_cast<Int4>(w) & 0x7fffffff);
  }
  const Float4 bound = unit * (1.1F + 6 * size);
  return {lane_mask(height > bound), lane_mask(-height > bound)};
}

template <int D>
Certain_meeting Certain_triangle<D>::meeting(std::span<const Facet_corners<D>> facet,
                                             const Plane_sides& planes, unsigned lane) const {
  if ((planes.missed() >> lane & 1) != 0) return Certain_meeting::missed;
  if constexpr (D == 2) return Certain_meeting::open;
  constexpr unsigned all = Certain_line<D>::all_lanes;
  const auto next = [](unsigned lanes) { return lanes >> 1 | (lanes & 1) << 3; };
  // The ridges that miss the triangle, and those that each side has on its inner and on its outer side.
  unsigned missed = all;
  std::array<unsigned, 3> inner{}, outer{}, all_inner{all, all, all}, all_outer = all_inner;
  for (const Facet_corners<D>& corners : facet) {
    const auto ends = heights(corners);
    std::array<typename Certain_line<D>::Sides, 3> turns;
    for (std::size_t i = 0; i < 3; ++i) {
      turns[i] = lines_[i].sides(corners);
      inner[i] |= turns[i].inner;
      outer[i] |= turns[i].outer;
      all_inner[i] &= turns[i].inner | corners.ignored;
      all_outer[i] &= turns[i].outer | corners.ignored;
    }
    // The third line leads the other way round the triangle.
    const unsigned passes = (ends.inner & next(ends.outer)) | (ends.outer & next(ends.inner));
    if ((passes & ((turns[0].inner & turns[1].inner & turns[2].outer) |
                   (turns[0].outer & turns[1].outer & turns[2].inner))) != 0)
      return Certain_meeting::met;
    missed &= (ends.inner & next(ends.inner)) | (ends.outer & next(ends.outer)) | corners.ignored |
              ((turns[0].inner | turns[1].inner | turns[2].outer) &
               (turns[0].outer | turns[1].outer | turns[2].inner));
  }
  bool is_missed = missed == all;
  constexpr std::array<std::array<std::size_t, 2>, 3> ends{{{0, 1}, {1, 2}, {0, 2}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [u, v] = ends[i];
    if ((planes.on_both_sides(u, v) >> lane & 1) != 0 && (all_inner[i] == all || all_outer[i] == all))
      return Certain_meeting::met;
    is_missed &= (planes.on_one_side(u, v) >> lane & 1) != 0 || (inner[i] != 0 && outer[i] != 0);
  }
  return is_missed ? Certain_meeting::missed : Certain_meeting::open;
}

template class Certain_triangle<2>;
template class Certain_triangle<3>;

}  // namespace cellwalk::detail
