// SPDX-License-Identifier: LGPL-3.0-or-later
// Small environments for the tests of the simulation, and checks that do not use its code.
#ifndef CELLWALK_TESTS_SIMULATION_WORLDS_H
#define CELLWALK_TESTS_SIMULATION_WORLDS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {

/// True if the locator, which knows nothing of the walk, finds the point in free space and in the particle's
/// cell.
template <int D>
bool is_where_it_says(const Locator<D>& locator, const Particle<D>& particle) {
  const Location<D> location = locator.locate(particle.position);
  return location.status == Location_status::free &&
         std::find(location.cells.begin(), location.cells.end(), particle.cell) != location.cells.end();
}

/// The outward normal of a facet, by doubles.
template <int D>
Vector<D> outward(const Snapshot<D>& snapshot, Half_facet f) {
  const auto loop = snapshot.loop(f);
  Vector<D> n{};
  if constexpr (D == 2) {
    const Vector<2> e = snapshot.point(loop[1]) - snapshot.point(loop[0]);
    n = {e[1], -e[0]};
  } else {
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      n = n + cross(snapshot.point(loop[i]) - snapshot.point(loop[0]),
                    snapshot.point(loop[i + 1]) - snapshot.point(loop[0]));
  }
  return (1 / length(n)) * n;
}

/// True if a point is within `error` of a facet, by doubles.
template <int D>
bool is_near(const Snapshot<D>& snapshot, Half_facet f, const Point<D>& p, double error) {
  const auto loop = snapshot.loop(f);
  const Vector<D> n = outward(snapshot, f);
  if (std::abs(dot(p - snapshot.point(loop[0]), n)) > error) return false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point<D>& a = snapshot.point(loop[i]);
    const Point<D>& b = snapshot.point(loop[(i + 1) % loop.size()]);
    const Vector<D> e = b - a;
    if constexpr (D == 2) {
      if (dot(p - a, e) < -error * length(e)) return false;
    } else {
      if (dot(cross(e, p - a), n) < -error * length(e)) return false;
    }
  }
  return true;
}

/// True if some wall with a free cell on this side holds the point and has the normal, both up to `error`.
template <int D>
bool lies_in_a_wall(const Snapshot<D>& snapshot, const Point<D>& p, const Vector<D>& normal, double error) {
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    if (snapshot.is_solid(c)) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const bool wall = snapshot.is_impassable(f) || snapshot.neighbour(f) == Cell::none;
      if (wall && length(normal + outward(snapshot, f)) < error && is_near(snapshot, f, p, error))
        return true;
    }
  }
  return false;
}

/// True if a segment goes through the inside of a unit square or cube of the lattice: it meets each axis'
/// open interval at a common parameter. By doubles, with cells shrunk by `margin`; knows nothing of chains.
template <int D>
bool pierces(const Point<D>& a, const Point<D>& b, const Point<D>& low, double margin) {
  double from = 0, to = 1;
  for (int k = 0; k < D; ++k) {
    const double lower = low[k] + margin, upper = low[k] + 1 - margin, d = b[k] - a[k];
    if (d == 0) {
      if (a[k] <= lower || a[k] >= upper) return false;
      continue;
    }
    const double s = (lower - a[k]) / d, t = (upper - a[k]) / d;
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  return from < to;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_WORLDS_H
