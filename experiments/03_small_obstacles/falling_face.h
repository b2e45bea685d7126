// SPDX-License-Identifier: LGPL-3.0-or-later
// A triangle that comes down in a straight line until something stops it.
#ifndef CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FALLING_FACE_H
#define CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FALLING_FACE_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <array>
#include <optional>

#include "face_trials.h"

namespace cellwalk::small_obstacles {

using Triangle = std::array<Point<3>, 3>;

struct Fall {
  Triangle start;
  Vector<3> step;  ///< of all corners, one after the other
};

/// A face whose greatest circle has the radius face_inradius. The target lies ahead of a point of it, see
/// Aim, at the distance `above` along its way; `step` is how far it falls in a step.
Fall random_fall(Random& random, Aim aim, const Point<3>& target, double above, double step);

/// The radius of the greatest circle in a triangle.
double inradius(const Triangle& t);

/// The distance of a point from the plane of a triangle.
double distance_from_plane(const Triangle& t, const Point<3>& x);

/// True if the open segment from x to y passes the inside of the triangle. Exact.
bool passes_inside(const Triangle& t, const Point<3>& x, const Point<3>& y);

struct Landing {
  Triangle end;  ///< after the step in which something was met: a corner that did stands at its verified stop
  std::optional<Body_feature> stopped_by;  ///< the first contact; nothing: it fell for all its steps
};

/// Lets the face fall.
/// \throw Error(outside) if it does not start free
Landing fall(const Snapshot<3>& snapshot, const Locator<3>& locator, const Fall& fall, Sweep sweep,
             int most_steps);

}  // namespace cellwalk::small_obstacles

#endif  // CELLWALK_EXPERIMENTS_SMALL_OBSTACLES_FALLING_FACE_H
