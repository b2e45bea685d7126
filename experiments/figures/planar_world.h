// SPDX-License-Identifier: LGPL-3.0-or-later
// A rectangle of the plane with spikes on its floor and ceiling and an obstacle that floats.
#ifndef CELLWALK_EXPERIMENTS_FIGURES_PLANAR_WORLD_H
#define CELLWALK_EXPERIMENTS_FIGURES_PLANAR_WORLD_H

#include <cellwalk/environment/environment.h>

#include <vector>

namespace cellwalk::figures {

using Polygon = std::vector<Point<2>>;  // of an obstacle: a triangle

/// The rectangle from (0,0), triangulated and certified; obstacles are solid cells. Vertices stand at every
/// unit of its sides.
/// \pre obstacles are triangles that do not meet; width and height are whole
Environment<2> planar_world(int width, int height, const std::vector<Polygon>& obstacles);

}  // namespace cellwalk::figures

#endif  // CELLWALK_EXPERIMENTS_FIGURES_PLANAR_WORLD_H
