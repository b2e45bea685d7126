// SPDX-License-Identifier: LGPL-3.0-or-later
// Places of points beside the centre lines of a vessel, by + - * / and sqrt only.
#ifndef CELLWALK_EXPERIMENTS_COMMON_CENTRE_LINES_H
#define CELLWALK_EXPERIMENTS_COMMON_CENTRE_LINES_H

#include <cellwalk/generators/vessel.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace cellwalk::experiments {

struct Centre_place {
  Point<3> centre;   ///< the nearest point of the centre lines
  std::size_t tube;  ///< on which it lies
};

/// Cost: linear in the number of segments of the lines.
inline Centre_place centre_of(const std::vector<Tube>& tubes, const Point<3>& x) {
  Centre_place place{{}, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < tubes.size(); ++k)
    for (std::size_t i = 0; i + 1 < tubes[k].points.size(); ++i) {
      const Point<3>& a = tubes[k].points[i];
      const Vector<3> axis = tubes[k].points[i + 1] - a;
      const Point<3> centre = a + std::clamp(dot(axis, x - a) / dot(axis, axis), 0.0, 1.0) * axis;
      if (const double d = length(x - centre); d < least) least = d, place = {centre, k};
    }
  return place;
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_CENTRE_LINES_H
