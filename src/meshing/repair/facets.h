// SPDX-License-Identifier: GPL-3.0-or-later
// A surface under repair: oriented triangles, each of which remembers its source.
#ifndef CELLWALK_MESHING_REPAIR_FACETS_H
#define CELLWALK_MESHING_REPAIR_FACETS_H

#include <cellwalk/kernel/point.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshing/fill/tetgen_sides.h"

namespace cellwalk::detail {

using Repair_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// The source of a triangle. Of triangles in the same place, the one of lower value counts.
enum class Part : std::uint8_t {
  surface,  ///< a facet of the file
  cap,      ///< added where the surface is open
  sheet,    ///< a facet of the file that bounds no part of the volume: a membrane, if it lies in free space
  mouth     ///< added where a lumen opens
};

struct Facet {
  Triangle corners;
  Part part = Part::surface;
  std::uint32_t number = 0;  ///< of the facet in the file, of the cap, sheet or mouth
};

struct Facets {
  std::vector<Point<3>> points;
  std::vector<Facet> facets;
  std::size_t given_points = 0;  ///< the first points are those of the file, the others were made
  double size = 0;               ///< the diagonal of the box around the points of the file

  const Point<3>& corner(const Facet& f, std::size_t k) const { return points[f.corners[k]]; }
};

inline Repair_kernel::Point_3 to_cgal(const Point<3>& p) { return {p[0], p[1], p[2]}; }

inline Point<3> centre(const Facets& s, const Facet& f) {
  return (1.0 / 3) * (s.corner(f, 0) + s.corner(f, 1) + s.corner(f, 2));
}

/// Twice the area times the normal.
inline Vector<3> area_vector(const Facets& s, const Facet& f) {
  return cross(s.corner(f, 1) - s.corner(f, 0), s.corner(f, 2) - s.corner(f, 0));
}

inline double area(const Facets& s, const Facet& f) { return length(area_vector(s, f)) / 2; }

/// The volume between triangles and a point; of closed ones, the volume that they enclose.
inline double signed_volume(const Facets& s, std::span<const Facet> facets, const Point<3>& origin) {
  double volume = 0;
  for (const Facet& f : facets)
    volume += dot(s.corner(f, 0) - origin, cross(s.corner(f, 1) - origin, s.corner(f, 2) - origin)) / 6;
  return volume;
}

inline void turn(Facet& f) { std::swap(f.corners[1], f.corners[2]); }

/// True if the corners run around as their ascending order does.
inline bool runs_upwards(const Triangle& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_FACETS_H
