// SPDX-License-Identifier: LGPL-3.0-or-later
// A hull of a few points in the frame of a snapshot, against planes in lanes.
#ifndef CELLWALK_EDGE_THICK_HULL_IN_FRAME_H
#define CELLWALK_EDGE_THICK_HULL_IN_FRAME_H

#include <cellwalk/internal/environment/planes.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace cellwalk::detail {

/// A plane (n, d) with |n.y + d - g(y)| <= 3u in the frame for its exact plane function g has a gradient of g
/// of length (1 + 5u) at most, so where all corners of the hull have n.y + d > R (1 + 2^-20) + plane_error,
/// or all have it below the negative of that, all of the hull is more than R away.
template <int D>
class Hull_in_frame {
 public:
  /// \param distance R, from the planes
  Hull_in_frame(const Plane_frame<D>& frame, std::span<const Point<D>> corners, double distance) {
    for (const Point<D>& x : corners) {
      Float_point<D> y;
      is_mapped_ &= frame.map(x, y);
      corners_.push_back(spread<D>(y));
    }
    const double in_frame = distance * frame.scale * (1 + 0x1p-20) + static_cast<double>(plane_error);
    constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
    // Rounded up: a conversion is off by less.
    threshold_ = static_cast<float>(std::min(in_frame * (1 + 0x1p-23), largest));
  }

  /// The lanes whose planes may be as near as that; all if the hull leaves the frame.
  unsigned lanes_near(const Plane_block<D>& planes) const {
    if (!is_mapped_) return 0xf;
    Float4 low = evaluate<D>(planes, corners_[0]), high = low;
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const Float4 at = evaluate<D>(planes, corners_[i]);
      low = -lane_max(-low, -at);
      high = lane_max(high, at);
    }
    return ~lane_mask((low > threshold_) | (high < -threshold_)) & 0xf;
  }

 private:
  boost::container::small_vector<Spread_point<D>, 8> corners_;
  float threshold_;
  bool is_mapped_ = true;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_THICK_HULL_IN_FRAME_H
