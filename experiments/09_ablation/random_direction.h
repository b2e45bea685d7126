// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef CELLWALK_EXPERIMENTS_ABLATION_RANDOM_DIRECTION_H
#define CELLWALK_EXPERIMENTS_ABLATION_RANDOM_DIRECTION_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/point.h>

#include <cmath>

namespace cellwalk::ablation {

/// A unit vector, all directions alike.
inline Vector<3> random_direction(Random& random) {
  for (;;) {
    const Vector<3> v{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const double square = dot(v, v);
    if (square <= 1 && square > 0x1p-20) return (1 / std::sqrt(square)) * v;
  }
}

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_RANDOM_DIRECTION_H
