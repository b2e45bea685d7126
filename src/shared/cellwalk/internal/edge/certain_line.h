// SPDX-License-Identifier: LGPL-3.0-or-later
// A line that certainly passes the interiors of facets, in lanes of single precision with an error bound.
// Theory, with the proof of the bound: docs/sweep.md, chains in place.
#ifndef CELLWALK_INTERNAL_EDGE_CERTAIN_LINE_H
#define CELLWALK_INTERNAL_EDGE_CERTAIN_LINE_H

#include <cellwalk/environment/snapshot.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ratio>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// Corners of a facet in the frame of its environment, in the order of its loop. In 3D a ridge leads from
/// each lane to the next, and from the last to the first; a facet of more than four corners has several of
/// these. In 2D the lanes are the two ends.
template <int D>
struct Facet_corners {
  std::array<Float4, D> lanes;  ///< NaN where a corner lies outside of the frame
  unsigned ignored;             ///< lanes that decide nothing, as a bit mask
  bool continues;               ///< the next ones are of the same facet
};

/// Appends the corners of a facet, seen from its cell.
/// Cost: reading the points of the facet.
template <int D>
void append_corners(const Plane_frame<D>& frame, const Cell_view<D>& cell, std::size_t facet,
                    std::vector<Facet_corners<D>>& corners);
template <int D>
void append_corners(const Snapshot<D>& snapshot, Half_facet facet, std::vector<Facet_corners<D>>& corners) {
  append_corners<D>(snapshot.frame(), snapshot.view(snapshot.cell_of(facet)), snapshot.facet_of(facet),
                    corners);
}
/// Appends the corners of facets as seen from their other sides, from the last facet to the first.
template <int D>
void append_from_behind(std::span<const Facet_corners<D>> facets, std::vector<Facet_corners<D>>& corners);

/// The signed distance of a point of the frame from the plane of a facet, within plane_error; 0 if the plane
/// is not certified.
template <int D>
float distance_from_plane(const Snapshot<D>& snapshot, Half_facet f, const Spread_point<D>& y) {
  return evaluate<D>(*snapshot.blocks(Cell{to_index(f) / 4}), y)[to_index(f) % 4];
}

/// The line from one point to others, one after the other.
/// \tparam Part of the error bound, of which tests show that one half is too little
template <int D, class Part = std::ratio<1>>
class Certain_line {
 public:
  /// \param from its start
  /// \param mapped the same in the frame
  Certain_line(const Plane_frame<D>& frame, const Point<D>& from, const Float_point<D>& mapped)
      : scale_(frame.scale), from_(from), start_(spread<D>(mapped)) {}

  const Point<D>& from() const { return from_; }
  /// The start in the frame, in all lanes.
  const Spread_point<D>& start() const { return start_; }

  /// Leads the line to a point.
  /// \param backwards facets are seen from the cells on the side of that point
  void lead_to(const Point<D>& to, bool backwards) {
    float length = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const auto d = static_cast<float>((to[k] - from_[k]) * scale_);
      length += std::abs(d);
      direction_[k] = backwards ? Float4{-d, -d, -d, -d} : Float4{d, d, d, d};
    }
    // Of a shorter line, or one that is not finite, nothing is certain.
    const float error = length > least_length && length < most_length
                            ? length * part
                            : std::numeric_limits<float>::infinity();
    error_ = Float4{error, error, error, error};
  }

  /// True proves that the line leads through the interior of a facet, out of the cell from which its corners
  /// are seen. False is inconclusive.
  /// \param corners some of its corners: the facet is passed if this is true of all
  /// \pre the line was led to a point
  /// Cost: some 30 operations on lanes.
  bool passes(const Facet_corners<D>& corners) const { return open_ridges(corners) == 0; }
  /// The ridges on whose inner sides the line does not certainly pass, as a bit mask.
  unsigned open_ridges(const Facet_corners<D>& corners) const {
    const Turn turned = turn(corners);
    return ~(lane_mask(turned.sign > turned.bound) | corners.ignored) & all_lanes;
  }

  /// The sign of each ridge, positive if the line passes on its inner side. It is an affine function of the
  /// start of the line, and off by at most its bound.
  struct Turn {
    Float4 sign, bound;
  };
  Turn turn(const Facet_corners<D>& corners) const {
    std::array<Float4, D> w;
    for (std::size_t k = 0; k < D; ++k) w[k] = corners.lanes[k] - start_[k];
    Float4 sign, bound;
    if constexpr (D == 3) {
      sign = (direction_[1] * w[2] - direction_[2] * w[1]) * next(w[0]) +
             (direction_[2] * w[0] - direction_[0] * w[2]) * next(w[1]) +
             (direction_[0] * w[1] - direction_[1] * w[0]) * next(w[2]);
      const Float4 size = magnitude(w[0]) + magnitude(w[1]) + magnitude(w[2]);
      const Float4 sizes = size + next(size) + 4 * unit;
      bound = error_ * (sizes * (1.03F + 2.1F * sizes));
    } else {
      const Float4 first = direction_[0] * w[1], second = direction_[1] * w[0];
      sign = (first - second) * Float4{-1, 1, 1, 1};
      bound = 1.03F * error_ + (4.1F * part) * (magnitude(first) + magnitude(second));
    }
    return {sign, bound};
  }

 private:
  static constexpr unsigned all_lanes = 15;
  static constexpr float unit = 0x1p-24F, part = unit * Part::num / Part::den;
  /// In the frame. In shorter lines, the error by underflow may exceed the bound.
  static constexpr float least_length = 0x1p-60F, most_length = 0x1p60F;
  static Float4 magnitude(Float4 x) { return std::bit_cast<Float4>(std::bit_cast<Int4>(x) & 0x7fffffff); }
  static Float4 next(Float4 x) { return __builtin_shufflevector(x, x, 1, 2, 3, 0); }

  double scale_;
  const Point<D>& from_;
  Spread_point<D> start_, direction_{};
  Float4 error_{};
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_CERTAIN_LINE_H
