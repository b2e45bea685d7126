// SPDX-License-Identifier: LGPL-3.0-or-later
// A swept triangle that certainly meets facets, or misses them, in lanes of single precision with an error
// bound. Theory, with the proof: docs/sweep.md, floods in lanes.
#ifndef CELLWALK_INTERNAL_EDGE_CERTAIN_TRIANGLE_H
#define CELLWALK_INTERNAL_EDGE_CERTAIN_TRIANGLE_H

#include <cellwalk/edge/swept_triangle.h>
#include <cellwalk/internal/edge/certain_line.h>

#include <array>
#include <cstddef>
#include <span>

namespace cellwalk::detail {

/// Whether a closed facet meets a closed triangle. `open`: it is not certain.
enum class Certain_meeting { missed, met, open };

/// In 2D only the lines of facets are looked at.
template <int D>
class Certain_triangle {
 public:
  Certain_triangle(const Plane_frame<D>& frame, const Swept_triangle<D>& triangle);
  Certain_triangle(const Certain_triangle&) = delete;
  Certain_triangle& operator=(const Certain_triangle&) = delete;

  /// False if nothing is certain: a corner lies outside of the frame, or two are the same.
  bool is_certain() const { return is_certain_; }

  /// On which sides of the planes of a block its corners certainly lie, as bit masks of the lanes.
  struct Plane_sides {
    std::array<unsigned, 3> before, beyond;

    /// The facets whose planes do not meet the triangle.
    unsigned missed() const {
      return (before[0] & before[1] & before[2]) | (beyond[0] & beyond[1] & beyond[2]);
    }
    /// The facets on one side of whose planes two corners lie, or on both sides.
    unsigned on_one_side(std::size_t i, std::size_t j) const {
      return (before[i] & before[j]) | (beyond[i] & beyond[j]);
    }
    unsigned on_both_sides(std::size_t i, std::size_t j) const {
      return (before[i] & beyond[j]) | (beyond[i] & before[j]);
    }
  };
  /// \pre is_certain()
  /// Cost: some 20 operations on lanes.
  Plane_sides sides(const Plane_block<D>& block) const;

  /// \param facet the corners of a facet
  /// \param planes the sides of its block, `lane` its lane there
  /// \pre is_certain()
  /// Cost: up to some 120 operations on lanes.
  Certain_meeting meeting(std::span<const Facet_corners<D>> facet, const Plane_sides& planes,
                          unsigned lane) const;

 private:
  /// The corners of a facet that certainly lie above and below the plane of the triangle, as bit masks.
  typename Certain_line<D>::Sides heights(const Facet_corners<D>& corners) const;

  Swept_triangle<D> corners_;
  std::array<Float_point<D>, 3> mapped_{};
  bool is_certain_;
  Spread_point<D> third_;                 ///< the corner q in the frame, in all lanes
  std::array<Certain_line<D>, 3> lines_;  ///< from a to b, from b to q, and from a to q
  Spread_point<D> normal_{};              ///< of the sum 1; zero if it is not certain
};

extern template class Certain_triangle<2>;
extern template class Certain_triangle<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_EDGE_CERTAIN_TRIANGLE_H
