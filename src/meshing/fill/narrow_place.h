// SPDX-License-Identifier: GPL-3.0-or-later
// The narrowest places of surfaces, where meshers fail.
#ifndef CELLWALK_MESHING_FILL_NARROW_PLACE_H
#define CELLWALK_MESHING_FILL_NARROW_PLACE_H

#include <cellwalk/records/surface_soup.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "feature_names.h"

namespace cellwalk::detail {

struct Narrow_place {
  bool are_vertices = true;               ///< or facets
  std::array<std::size_t, 2> features{};  ///< vertices or facets, numbered through
  int common_corners = 0;                 ///< of the facets
  double distance = 0;                    ///< divided by the diagonal of all surfaces; rounded
  Point<3> at{};
};

/// The two nearest vertices, if they are near; then the two nearest facets, if they are much nearer than
/// that, but for those with a common edge. If nothing is near, the narrowest of edges and folds.
/// \pre the surfaces are triangles that do not intersect, without degenerate ones
/// Cost: about 5 us a triangle.
std::vector<Narrow_place> narrow_places(const std::vector<Surface_soup>& surfaces);

/// The places in words: "vertices 0 and 8 are 1e-12 of the size apart, at (0, 0, 0)".
std::string describe(const std::vector<Narrow_place>& places, const Feature_names& names);

/// A point in words.
std::string describe(const Point<3>& point);

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_NARROW_PLACE_H
