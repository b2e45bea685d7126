// SPDX-License-Identifier: LGPL-3.0-or-later
// The centre line of free space from one place to another, as the path of a catheter.
#ifndef CELLWALK_INTERNAL_SIMULATION_CENTRE_LINE_H
#define CELLWALK_INTERNAL_SIMULATION_CENTRE_LINE_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/records/scene.h>

#include <vector>

namespace cellwalk {

/// A polyline through free space, and how far walls are from each of its points.
template <int D>
struct Centre_line {
  std::vector<Point<D>> points;
  std::vector<double> clearances;

  double length() const;
};

/// Finds a line from one end to the other that keeps to the middle: the way from cell to cell on which the
/// integral of 1 over the distance from walls is least, then smoothed and moved away from walls. It begins
/// and ends at a point given, or just before the middle of a group. Facets of the two groups are no walls
/// here. Exact walks prove each piece of the line free, and the line as a whole.
/// \param groups of facets and cells by name
/// \param radius an end before a group keeps this distance from all walls, the facets of the group included
/// \throw Error(input) for a group that there is not, or that has no free cell; Error(outside) for a point
///        that is not in free space, if no way joins the ends, and if no point of the line is that far from
///        all walls. The message begins with "from", "to" or "radius".
/// Cost: about 10 us a cell that is nearer than the end.
template <int D>
Centre_line<D> find_centre_line(const Snapshot<D>& snapshot, const Groups<D>& groups,
                                const Catheter_ends<D>& ends, double radius = 0);

/// Lays a catheter along the centre line between its ends: finds its path, and all numbers that are 0.
/// \pre catheter.ends
/// \throw Error as find_centre_line(), naming the key
template <int D>
void lay_along_centre_line(const Snapshot<D>& snapshot, const Groups<D>& groups, Catheter<D>& catheter);

extern template struct Centre_line<2>;
extern template struct Centre_line<3>;
extern template Centre_line<2> find_centre_line(const Snapshot<2>&, const Groups<2>&, const Catheter_ends<2>&,
                                                double);
extern template Centre_line<3> find_centre_line(const Snapshot<3>&, const Groups<3>&, const Catheter_ends<3>&,
                                                double);
extern template void lay_along_centre_line(const Snapshot<2>&, const Groups<2>&, Catheter<2>&);
extern template void lay_along_centre_line(const Snapshot<3>&, const Groups<3>&, Catheter<3>&);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_CENTRE_LINE_H
