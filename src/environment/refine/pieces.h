// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that face others as pieces, and the soup with them. Internal to refinement.
#ifndef CELLWALK_ENVIRONMENT_REFINE_PIECES_H
#define CELLWALK_ENVIRONMENT_REFINE_PIECES_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "lone_facets.h"
#include "sides.h"

namespace cellwalk::detail {

/// The pieces of each facet that has any, by its number in the soup.
using Pieces = std::unordered_map<std::uint32_t, std::vector<Facet_loop>>;

/// Divides each facet in a pair by its counterparts. In 2D this is done by the points inside the facets.
/// \return nothing if facets of one side overlap, so that cells do
template <int D>
std::optional<Pieces> pieces_of(std::span<const Point<D>> points, std::span<const Lone_facet<D>> facets,
                                std::span<const Facet_pair> pairs, const Sides<D>& sides, double tolerance);

/// The cells with these pieces, and the points inside the sides of all facets. With a tolerance, facets with
/// points that are not exactly in their sides are cut into triangles.
/// \param soup as it was read: its cells keep their own of several points in one place
/// \param cells the same, with the names of points that pieces and sides have, and all points
/// \param begin receives the number of the first piece of each facet, and the number of all
template <int D>
Cell_soup<D> with_pieces(const Cell_soup<D>& soup, const Cell_soup<D>& cells, const Pieces& pieces,
                         const Sides<D>& sides, double tolerance, std::vector<std::uint32_t>& begin);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_REFINE_PIECES_H
