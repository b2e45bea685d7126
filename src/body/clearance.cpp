// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/clearance.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk {
namespace {

/// Squares of lengths from which on what underflow takes away is far less than rounding does.
constexpr double least_square = 1e-280;

/// A direction towards a facet: towards the nearest point of it, more or less. Any will do for a bound; the better it is, the
/// better the bound.
Vector<2> direction_to(const Cell_view<2>& cell, std::size_t i, const Point<2>& x) {
  const auto loop = cell.loop(i);
  const Vector<2> from_u = x - cell.point(loop[0]), edge = cell.point(loop[1]) - cell.point(loop[0]);
  const double square = dot(edge, edge);
  const double t = square > 0 ? std::clamp(dot(from_u, edge) / square, 0.0, 1.0) : 0;
  return t * edge - from_u;
}

Vector<3> direction_to(const Cell_view<3>& cell, std::size_t i, const Point<3>& x) {
  const auto loop = cell.loop(i);
  const Point<3>& u = cell.point(loop[0]);
  const Vector<3> normal = cross(cell.point(loop[1]) - u, cell.point(loop[2]) - u);
  Vector<3> best{};
  double least = std::numeric_limits<double>::infinity();
  bool is_above = true;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point<3>& v = cell.point(loop[k]);
    const Vector<3> edge = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]) - v, from_v = x - v;
    is_above &= dot(cross(normal, edge), from_v) >= 0;
    const double square = dot(edge, edge);
    const double t = square > 0 ? std::clamp(dot(from_v, edge) / square, 0.0, 1.0) : 0;
    const Vector<3> to_edge = t * edge - from_v;
    if (const double here = dot(to_edge, to_edge); here < least) {
      least = here;
      best = to_edge;
    }
  }
  if (!is_above) return best;
  return (dot(normal, u - x) < 0 ? -1.0 : 1.0) * normal;
}

/// A lower bound of the distance of x from a closed facet, whatever the rounding; 0 if none better is found. All vertices of the
/// facet lie on the far side of a plane at that distance.
template <int D>
double distance_bound(const Cell_view<D>& cell, std::size_t i, const Point<D>& x) {
  const Vector<D> n = direction_to(cell, i, x);
  const double square = dot(n, n);
  // Underflow and overflow would void the bound.
  if (!(square > least_square) || !std::isfinite(square)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint16_t v : cell.loop(i)) {
    const Vector<D> d = cell.point(v) - x;
    double magnitude = 0;
    for (int k = 0; k < D; ++k) magnitude += std::abs(n[k] * d[k]);
    // A sum of D products of a rounded difference: each term is wrong by at most D + 2 parts in 2^53 of its size.
    if (!std::isfinite(magnitude)) return 0;
    least = std::min(least, dot(n, d) - 0x1p-50 * magnitude);
  }
  // The length of n and this quotient are wrong by a few parts in 2^53.
  return std::max(0.0, least / std::sqrt(square) * (1 - 0x1p-49));
}

}  // namespace

template <int D>
std::optional<Clear_region<D>> clear_region(const Snapshot<D>& snapshot, const Particle<D>& center,
                                            double least, double most, std::size_t most_cells) {
  double radius = most;
  boost::container::small_vector<Cell, 64> found{center.cell};
  for (std::size_t head = 0; head < found.size(); ++head) {
    const Cell_view<D> cell = snapshot.view(found[head]);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(found[head], i);
      const bool is_wall = snapshot.is_impassable(f);
      if (!is_wall && std::find(found.begin(), found.end(), snapshot.neighbor(f)) != found.end()) continue;
      const double distance = distance_bound(cell, i, center.position);
      if (distance >= radius) continue;
      if (!is_wall && found.size() < most_cells) {
        found.push_back(snapshot.neighbor(f));
        continue;
      }
      radius = distance;  // beyond it is a wall, or what was not looked at
      if (!(radius > least)) return {};
    }
  }
  // Underflow would void the bounds.
  const double square = radius * radius * (1 - 0x1p-50);
  if (!(square > least_square)) return {};
  return Clear_region<D>{center, square};
}

template std::optional<Clear_region<2>> clear_region<2>(const Snapshot<2>&, const Particle<2>&, double,
                                                        double, std::size_t);
template std::optional<Clear_region<3>> clear_region<3>(const Snapshot<3>&, const Particle<3>&, double,
                                                        double, std::size_t);

}  // namespace cellwalk
