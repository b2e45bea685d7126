// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces as helper programs take them.
#ifndef CELLWALK_MESHING_FILL_MESHER_INPUT_H
#define CELLWALK_MESHING_FILL_MESHER_INPUT_H

#include <cellwalk/kernel/error.h>
#include <cellwalk/records/surface_soup.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "meshing/child/protocol.h"
#include "scale.h"

namespace cellwalk::detail {

/// \pre the surfaces consist of triangles
/// \param scale exponent of a factor
inline Mesher_input mesher_input(const std::vector<Surface_soup>& surfaces, int scale) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  Mesher_input input;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces[s].points.size() > most - input.points.size())
      throw Error(Error_code::input, "the surfaces have too many points for a mesher: more than 2^31");
    const auto first = static_cast<std::int32_t>(input.points.size());
    for (const Point<3>& p : surfaces[s].points) input.points.push_back(scaled(p, scale));
    for (const auto& f : surfaces[s].facets) {
      const auto corner = [&](int k) { return first + static_cast<std::int32_t>(f[k]); };
      input.triangles.push_back({corner(0), corner(1), corner(2)});
      input.surfaces.push_back(static_cast<std::int32_t>(s));
    }
  }
  return input;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_FILL_MESHER_INPUT_H
