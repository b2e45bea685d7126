// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that one cell has and no other, and those of them that face each other. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_LONE_FACETS_H
#define CELLWALK_ENVIRONMENT_REFINE_LONE_FACETS_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "environment/certify/boundary_facet.h"

namespace cellwalk::detail {

template <int D>
struct Lone_facet {
  std::uint32_t facet, cell;  ///< by their numbers in the soup
  bool is_solid;              ///< so is the cell
  bool is_sound;              ///< exactly planar and convex; otherwise `plane` is not set
  Plane_points<D> plane;
  Facet_loop loop;
  Vector<D> normal;  ///< outwards, rounded
  Box<D> box;
};

/// In the order of the soup.
template <int D>
std::vector<Lone_facet<D>> lone_facets(const Cell_soup<D>& soup, const Gluing& gluing);

/// Two facets by their places among the lone ones, ascending.
using Facet_pair = std::array<std::uint32_t, 2>;

/// Pairs of facets of different cells with opposite sides, ascending.
struct Facing_pairs {
  std::vector<Facet_pair> touching;  ///< they overlap in a plane, by exact predicates
  std::vector<Facet_pair> near;      ///< others of which one lies over the other within the tolerance
};

/// \param is_exact whether facets that touch are told from others that are near, and those of solid cells are
///        left out. Otherwise all are near, unless they overlap by less than the tolerance
template <int D>
Facing_pairs facing_pairs(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                          double tolerance, bool is_exact);

/// The number of some pairs, and the first with a place; cells by their numbers in the soup.
template <int D>
Facing_facets described(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                        std::span<const Facet_pair> pairs);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_LONE_FACETS_H
