// SPDX-License-Identifier: LGPL-3.0-or-later
// Swept triangles and chains in rational arithmetic, by definition and without cells: shares nothing with the
// library.
#ifndef CELLWALK_TESTS_EDGE_RATIONAL_SWEEP_H
#define CELLWALK_TESTS_EDGE_RATIONAL_SWEEP_H

#include <cellwalk/kernel/point.h>

#include <optional>
#include <span>
#include <vector>

namespace cellwalk::test {

/// True if the open triangle abq and the relative interior of a convex facet meet, and not in one plane: no
/// motion of the edge from aq to bq can then be free. Boundaries that touch do not count.
bool crosses(const Point<2>& a, const Point<2>& b, const Point<2>& q, std::span<const Point<2>> facet);
bool crosses(const Point<3>& a, const Point<3>& b, const Point<3>& q, std::span<const Point<3>> facet);

/// The first time s at which the segment from a + s (b - a) to q meets the part of a facet that crosses the
/// open triangle, as crosses() says; rounded to nearest. No value if it does not cross.
std::optional<double> first_crossing(const Point<2>& a, const Point<2>& b, const Point<2>& q,
                                     std::span<const Point<2>> facet);
std::optional<double> first_crossing(const Point<3>& a, const Point<3>& b, const Point<3>& q,
                                     std::span<const Point<3>> facet);

/// True if the segment pq meets the facets in order, each in one point: facets in whose plane (line) it lies
/// do not count as met.
bool meets_in_order(const Point<2>& p, const Point<2>& q, const std::vector<std::vector<Point<2>>>& facets);
bool meets_in_order(const Point<3>& p, const Point<3>& q, const std::vector<std::vector<Point<3>>>& facets);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_RATIONAL_SWEEP_H
