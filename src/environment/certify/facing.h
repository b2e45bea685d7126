// SPDX-License-Identifier: LGPL-3.0-or-later
// Boundary facets of free cells that turn their outer sides to each other, in or near one plane. Internal to
// certification.
#ifndef CELLWALK_ENVIRONMENT_CERTIFY_FACING_H
#define CELLWALK_ENVIRONMENT_CERTIFY_FACING_H

#include <cellwalk/internal/kernel/box.h>

#include <array>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "boundary_facet.h"

namespace cellwalk::detail {

/// A boundary facet of another cell, and whether the cell is on its outer side, with D vertices in its plane.
struct Facing_candidate {
  std::uint32_t facet = 0;
  bool is_in_contact = false;
};

/// Collects the pairs, from any threads; the result does not depend on their number.
template <int D>
class Facing_search {
 public:
  /// \param facets all of the boundary
  Facing_search(const Snapshot<D>& snapshot, std::span<const Boundary_facet<D>> facets);

  /// The box of a cell with room for the gaps of its facets.
  Box<D> enlarged(const Box<D>& cell) const;

  /// Compares the facets of a cell with those of cells before it.
  /// \param own, others by their places among all facets
  void compare(std::span<const std::uint32_t> own, std::span<const Facing_candidate> others);

  Facing_walls result() const;

 private:
  using Key = std::array<std::uint32_t, 4>;  ///< both cells by their indices, and both facets
  struct Pairs {
    std::size_t count = 0;
    Key first{};
  };

  void add(Pairs& pairs, std::uint32_t f, std::uint32_t g);
  Facing_facets described(const Pairs& pairs) const;

  const Snapshot<D>& snapshot_;
  std::span<const Boundary_facet<D>> facets_;
  std::vector<Vector<D>> normals_;  ///< outwards, rounded
  double tolerance_ = 0;
  std::mutex mutex_;
  Pairs overlapping_, near_;
};

extern template class Facing_search<2>;
extern template class Facing_search<3>;

/// \throw Error(not_certified) if facets overlap
template <int D>
void refuse_overlapping(const Facing_facets& facets);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_CERTIFY_FACING_H
