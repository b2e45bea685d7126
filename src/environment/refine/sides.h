// SPDX-License-Identifier: LGPL-3.0-or-later
// The points inside sides of facets. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_SIDES_H
#define CELLWALK_ENVIRONMENT_REFINE_SIDES_H

#include <cellwalk/kernel/point.h>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "environment/certify/boundary_facet.h"

namespace cellwalk::detail {

/// A side is a segment between two vertices, in 2D a whole facet. Its points are the same for all facets that
/// have it, whatever their direction.
template <int D>
class Sides {
 public:
  /// \param points to which more may be added
  /// \param tolerance 0: exact. Otherwise points within this distance of a side lie on it
  Sides(const std::vector<Point<D>>& points, double tolerance) : points_(points), tolerance_(tolerance) {}

  bool empty() const { return inside_.empty(); }

  /// True if a point lies strictly inside a side.
  bool is_inside(std::uint32_t u, std::uint32_t v, std::uint32_t x) const;
  /// Adds a point inside a side; false if it was there already.
  bool add(std::uint32_t u, std::uint32_t v, std::uint32_t x);
  /// The points inside a side.
  std::span<const std::uint32_t> inside(std::uint32_t u, std::uint32_t v) const;

  /// A loop with the points inside its sides; in 2D from one end of the facet to the other.
  Facet_loop subdivided(std::span<const std::uint32_t> loop) const;

 private:
  static std::uint64_t key(std::uint32_t u, std::uint32_t v);
  bool is_before(std::uint32_t u, std::uint32_t v, std::uint32_t x, std::uint32_t y) const;

  const std::vector<Point<D>>& points_;
  double tolerance_;
  std::vector<std::uint8_t> is_end_;  ///< by point: of sides that have points inside
  /// By both ends, from the lower index to the higher.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> inside_;
};

/// The number of sides of a facet.
template <int D>
std::size_t side_count(std::span<const std::uint32_t> loop) {
  return D == 2 ? 1 : loop.size();
}

extern template class Sides<2>;
extern template class Sides<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_SIDES_H
