// SPDX-License-Identifier: LGPL-3.0-or-later
#include "random_flights.h"

#include <cellwalk/walk/locate.h>

#include <algorithm>

#include "random_direction.h"

namespace cellwalk::ablation {

double edge_length(const Snapshot<3>& snapshot, const std::vector<Particle<3>>& particles) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(1000, particles.size()); ++i) {
    const Cell_view<3> cell = snapshot.view(particles[i].cell);
    for (std::size_t f = 0; f < cell.facet_count(); ++f) {
      const auto loop = cell.loop(f);
      for (std::size_t k = 0; k < loop.size(); ++k, ++count)
        sum += length(snapshot.point(loop[(k + 1) % loop.size()]) - snapshot.point(loop[k]));
    }
  }
  return sum / static_cast<double>(count);
}

std::vector<Particle<3>> random_starts(const Snapshot<3>& snapshot, std::size_t count, Random& random) {
  const Locator<3> locator(snapshot);
  Point<3> low = snapshot.point(0), high = low;
  for (const Point<3>& x : snapshot.points())
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  std::vector<Particle<3>> particles;
  while (particles.size() < count) {
    const Point<3> x{random.real(low[0], high[0]), random.real(low[1], high[1]),
                     random.real(low[2], high[2])};
    if (const auto particle = locator.particle_at(x)) particles.push_back(*particle);
  }
  return particles;
}

std::vector<Vector<3>> random_moves(double length, std::size_t count, Random& random) {
  std::vector<Vector<3>> moves(count);
  for (Vector<3>& move : moves) move = length * random_direction(random);
  return moves;
}

}  // namespace cellwalk::ablation
