// SPDX-License-Identifier: LGPL-3.0-or-later
// Smooth tubes enclosed by walls, for runs and pictures without a file.
#ifndef CELLWALK_GENERATORS_VESSEL_H
#define CELLWALK_GENERATORS_VESSEL_H

#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <vector>

namespace cellwalk {

/// A tube: a polyline with a radius at each point.
struct Tube {
  std::vector<Point<3>> points;
  std::vector<double> radii;
  int parent = -1;  ///< the tube from which it branches; -1: none
};

/// A tree of vessels. Lengths are in units of the trunk's radius.
struct Vessel_options {
  int generations = 3;  ///< number of successive forks: 2^generations ends; 0 to 6
  double length = 7;    ///< of the trunk; each branch is about a fifth shorter and thinner than its parent
  double curvature = 0.35;  ///< sideways bend of branches, 0 to 1
  double cell_size = 0.3;   ///< see Implicit_shape; at most 0.8 of the thinnest branch's radius
  double radius = 1;        ///< of the trunk, in units of the result: scales everything
  double tissue = 0;        ///< thickness of solid cells around it, see Implicit_shape; 0: none
  std::uint64_t seed = 1;
};

/// A branching vessel: a trunk that starts at the origin in direction z and forks into ever thinner branches,
/// rounded at the ends. Tetrahedra, about 43,000 with the default options, in one component; solid ones of
/// its tissue come in addition, and its walls are inner facets then.
/// \throw Error(usage) for options out of range
/// Cost: about 7 us a tetrahedron.
Cell_soup<3> branching_vessel(const Vessel_options& options);

/// The centre lines of its branches, parents before children, for the paths of catheters.
std::vector<Tube> vessel_tubes(const Vessel_options& options);

/// A bent tube with a bulge on the outer side of the bend, like an aneurysm. Lengths in units of the tube's
/// radius.
struct Bulge_options {
  double length = 14;  ///< from end to end in a straight line
  /// Height of the bend over the line between its ends, as a fraction of the length; 0 to 1.
  double bend = 0.4;
  double bulge_radius = 2;  ///< of the bulge; 0: none
  double bulge_offset = 2;  ///< of its centre from the centre line, outwards
  double cell_size = 0.3;
  double radius = 1;  ///< scales everything
  double tissue = 0;  ///< thickness of solid cells around it, see Implicit_shape; 0: none
};

/// A tube from x = -length/2 to length/2 in the plane y = 0 that bends towards z.
/// \throw Error(usage) for options out of range
Cell_soup<3> bulging_tube(const Bulge_options& options);

/// Its centre line.
Tube bulging_tube_line(const Bulge_options& options);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_VESSEL_H
