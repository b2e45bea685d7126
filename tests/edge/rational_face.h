// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces against walls in rational arithmetic, by definition and without cells: shares nothing with the
// library.
#ifndef CELLWALK_TESTS_EDGE_RATIONAL_FACE_H
#define CELLWALK_TESTS_EDGE_RATIONAL_FACE_H

#include <cellwalk/kernel/point.h>

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <optional>
#include <span>

namespace cellwalk::test {

using Fraction = boost::multiprecision::mpq_rational;
using Triangle = std::array<Point<3>, 3>;

/// True if the open triangle and the relative interior of a convex facet meet, and not in one plane.
bool pierces(const Triangle& face, std::span<const Point<3>> facet);

/// True if a facet lies in the plane of a triangle and both have inner points in common.
bool overlaps_in_plane(const Triangle& face, std::span<const Point<3>> facet);

/// True if two facets in the plane of a triangle and the triangle have inner points in common.
bool overlap_in_plane(const Triangle& face, std::span<const Point<3>> facet, std::span<const Point<3>> other);

/// Side of x against the plane of a facet, by the turn of its vertices.
int side_of_plane(std::span<const Point<3>> facet, const Point<3>& x);

/// 0 if the points lie in one plane.
int orientation_of(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d);

/// True if the points lie on one line.
bool on_one_line(const Triangle& face);

/// The first time from which on a facet pierces the face, or at which it passes it in its plane (not at 0 or
/// 1), while corner number `k` moves to b along a line. By definition: all signs by which facet and face lie
/// to each other change at roots of affine functions of time; each root and each interval between roots is
/// looked at.
/// \pre b does not lie in the plane of the face
std::optional<Fraction> first_piercing(const Triangle& face, std::size_t k, const Point<3>& b,
                                       std::span<const Point<3>> facet);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_RATIONAL_FACE_H
