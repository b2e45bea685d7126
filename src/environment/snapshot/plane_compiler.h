// SPDX-License-Identifier: LGPL-3.0-or-later
// Float planes of facets, proved to lie within the bound stated in <cellwalk/internal/environment/planes.h>.
#ifndef CELLWALK_ENVIRONMENT_SNAPSHOT_PLANE_COMPILER_H
#define CELLWALK_ENVIRONMENT_SNAPSHOT_PLANE_COMPILER_H

#include <cellwalk/internal/environment/planes.h>
#include <cellwalk/kernel/point.h>

#include <span>

namespace cellwalk {

/// The frame of a point set: a power of two scales the box of the points into [-1,1]^D. If the coordinates
/// are too large or too small for that, the frame maps nothing, and everything is decided exactly.
template <int D>
Plane_frame<D> make_frame(std::span<const Point<D>> points);

/// One plane for a lane. normal = offset = 0: not certified, every sign is undecided.
template <int D>
struct Float_plane {
  std::array<float, D> normal{};
  float offset = 0;
};

/// The plane through D points, positive outside (2D: to the right of p0 p1; 3D: where p0, p1, p2 turn
/// counterclockwise), or a plane that certifies nothing if the bound cannot be proved.
Float_plane<2> make_plane(const Plane_frame<2>& frame, const Point<2>& p0, const Point<2>& p1);
Float_plane<3> make_plane(const Plane_frame<3>& frame, const Point<3>& p0, const Point<3>& p1,
                          const Point<3>& p2);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SNAPSHOT_PLANE_COMPILER_H
