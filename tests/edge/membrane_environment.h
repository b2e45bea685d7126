// SPDX-License-Identifier: LGPL-3.0-or-later
// A certified environment in which any given triangle is a membrane: an obstacle with free space on both
// sides and round its rim. Its three points are vertices of the complex, unrounded.
#ifndef CELLWALK_TESTS_EDGE_MEMBRANE_ENVIRONMENT_H
#define CELLWALK_TESTS_EDGE_MEMBRANE_ENVIRONMENT_H

#include <cellwalk/environment/environment.h>

#include <array>
#include <span>

namespace cellwalk::test {

/// 14 tetrahedra round the triangle t: one on each side of it; two at each of its edges i (from vertex i to
/// the next), with an outer vertex X_i beyond the edge; two at each of its vertices. The outer vertices (two
/// poles on the normal of t, and X_0 X_1 X_2) span a double pyramid. They are 64 times as far out as the box
/// of t and `inside` reaches from its centre, the walls on the boundary 28 times: far from all that happens
/// inside.
///
/// It fits for every triangle, a needle too, because only signs with room to spare are asked of rounded
/// points: seen from far away the triangle is a point, with outward normals m_i of its edges in its plane.
/// Cells are positive if X_i lies within 90 degrees of m_i, and each X_i within 180 of the next. The X_i are
/// put at 120 degrees from each other. The normals turn by less than 180 from one to the next and by 360 in
/// all, so they are ahead of such directions by amounts that differ by at most 120: turned to the middle of
/// these, each X_i is within 60 degrees of m_i. The exact certificate of the environment decides whether all
/// this is so.
///
/// The membrane is facet 0 of the cell with index 0, which lies on the side from which t turns
/// counterclockwise.
/// \pre coordinates, and their differences that are not 0, have magnitudes from 1e-100 to 1e100
/// \throw std::invalid_argument if the points of t lie on one line; Error(not_certified) never, if the above
///        is right
Environment<3> membrane_environment(const std::array<Point<3>, 3>& t, std::span<const Point<3>> inside,
                                    Build_report* report = nullptr);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_MEMBRANE_ENVIRONMENT_H
