// SPDX-License-Identifier: LGPL-3.0-or-later
// The directions of points from smoothed normals, and their places at each phase.
#include <cellwalk/internal/records/scene_shape.h>
#include <cellwalk/internal/simulation/wall_pulsation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "simulation/traces/check_motion.h"
#include "star_smoother.h"

namespace cellwalk {
namespace {

/// Toward fixed parts, the motion fades over this number of amplitudes.
constexpr double fading_amplitudes = 10;
/// Each sweep over the points between walls takes each to the mean of its neighbours. Points lie few cells
/// from a wall, so that more sweeps change little.
constexpr int smoothing_sweeps = 64;

/// Perpendicular to a facet, out of its cell, as long as it is large.
Vector<2> across(std::span<const Point<2>> loop) {
  const Vector<2> along = loop[1] - loop[0];
  return {along[1], -along[0]};
}

Vector<3> across(std::span<const Point<3>> loop) {
  Vector<3> sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum + cross(loop[i] - loop[0], loop[i + 1] - loop[0]);
  return sum;
}

/// The surroundings of each point of an environment: the normals of walls around it, and its neighbours along
/// edges.
template <int D>
struct Point_surroundings {
  std::vector<Vector<D>> normals;  ///< the sum of those of its walls, away from free space
  std::vector<char> is_at_wall, is_held;
  std::vector<std::array<std::uint32_t, 2>> neighbours;   ///< a point and a neighbour of it, ascending
  std::vector<std::array<std::uint32_t, 2>> along_walls;  ///< those along edges of walls
};

void sort_once(std::vector<std::array<std::uint32_t, 2>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

template <int D>
Point_surroundings<D> surroundings(const Snapshot<D>& snapshot) {
  Point_surroundings<D> result;
  const std::size_t count = snapshot.points().size();
  result.normals.resize(count);
  result.is_at_wall.resize(count, 0);
  result.is_held.resize(count, 0);
  std::vector<Point<D>> corners;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const std::vector<std::uint32_t> loop = snapshot.loop(facet);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t u = loop[k], v = loop[(k + 1) % loop.size()];
        result.neighbours.push_back({u, v});
        result.neighbours.push_back({v, u});
      }
      if (snapshot.is_solid(cell)) {
        if (snapshot.neighbour(facet) == Cell::none)
          for (const std::uint32_t v : loop) result.is_held[v] = 1;
        continue;
      }
      if (!snapshot.is_impassable(facet)) continue;
      corners.clear();
      for (const std::uint32_t v : loop) corners.push_back(snapshot.point(v));
      const Vector<D> normal = across(corners);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t u = loop[k], v = loop[(k + 1) % loop.size()];
        result.normals[u] = result.normals[u] + normal;
        result.is_at_wall[u] = 1;
        result.along_walls.push_back({u, v});
        result.along_walls.push_back({v, u});
      }
    }
  }
  sort_once(result.neighbours);
  sort_once(result.along_walls);
  return result;
}

/// In each sweep, normals of walls become the mean of their own and those beside them along walls, as units.
template <int D>
void smooth_normals(Point_surroundings<D>& around, std::uint32_t sweeps) {
  const auto& pairs = around.along_walls;
  for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<Vector<D>> units = around.normals;
    for (Vector<D>& n : units)
      if (const double size = length(n); size > 0) n = (1 / size) * n;
    for (std::size_t i = 0; i < pairs.size();) {
      const std::uint32_t point = pairs[i][0];
      Vector<D> sum{};
      std::size_t n = i;
      for (; n < pairs.size() && pairs[n][0] == point; ++n) sum = sum + units[pairs[n][1]];
      around.normals[point] = 0.5 * (units[point] + (1.0 / static_cast<double>(n - i)) * sum);
      i = n;
    }
  }
}

/// Directions at walls given, each other point takes the mean of its neighbours, again and again.
template <int D>
void smooth(const Point_surroundings<D>& around, std::vector<Vector<D>>& directions) {
  const auto& pairs = around.neighbours;
  for (int sweep = 0; sweep < smoothing_sweeps; ++sweep)
    for (std::size_t i = 0; i < pairs.size();) {
      const std::uint32_t point = pairs[i][0];
      Vector<D> sum{};
      std::size_t n = i;
      for (; n < pairs.size() && pairs[n][0] == point; ++n) sum = sum + directions[pairs[n][1]];
      if (!around.is_at_wall[point] && !around.is_held[point])
        directions[point] = (1.0 / static_cast<double>(n - i)) * sum;
      i = n;
    }
}

}  // namespace

template <int D>
Wall_pulsation<D>::Wall_pulsation(const Snapshot<D>& snapshot, const Pulsation<D>& pulsation,
                                  std::span<const Scene_shape<D>> fixed)
    : pulsation_(pulsation) {
  Point_surroundings<D> around = surroundings(snapshot);
  smooth_normals(around, pulsation.even);
  const auto share = [&](const Point<D>& x) {
    return std::min(1.0, detail::distance<D>(fixed, x) / (fading_amplitudes * pulsation.amplitude));
  };
  std::vector<Vector<D>> directions(around.normals.size());
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    const double moved = share(snapshot.point(i)), size = length(around.normals[i]);
    if (moved == 0) around.is_held[i] = 1;
    if (around.is_at_wall[i] && !around.is_held[i] && size > 0)
      directions[i] = (moved / size) * around.normals[i];
  }
  smooth(around, directions);
  for (std::uint32_t i = 0; i < directions.size(); ++i)
    if (directions[i] != Vector<D>{}) movers_.push_back({i, snapshot.point(i), directions[i], {}});
  if (pulsation.smooth == 0) return;
  std::vector<char> may_move(directions.size());
  for (std::size_t i = 0; i < may_move.size(); ++i) may_move[i] = !around.is_at_wall[i] && !around.is_held[i];
  smooth_inside(snapshot, std::move(may_move), directions);
}

/// Points between walls get the best places found at the ends of the motion and in its middle, and go on a
/// parabola through them.
template <int D>
void Wall_pulsation<D>::smooth_inside(const Snapshot<D>& snapshot, std::vector<char> may_move,
                                      const std::vector<Vector<D>>& directions) {
  const detail::Star_smoother<D> smoother(snapshot, std::move(may_move));
  const int sweeps = static_cast<int>(pulsation_.smooth);
  const double size = pulsation_.amplitude, floor = pulsation_.quality_floor;
  std::vector<Point<D>> rest(directions.size()), out = rest, in = rest;
  for (std::uint32_t i = 0; i < rest.size(); ++i) rest[i] = snapshot.point(i);
  const std::vector<char> moved = smoother.smooth(rest, sweeps, floor);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    out[i] = rest[i] + size * directions[i];
    in[i] = rest[i] + -size * directions[i];
  }
  const std::vector<char> moved_out = smoother.smooth(out, sweeps, floor);
  const std::vector<char> moved_in = smoother.smooth(in, sweeps, floor);
  movers_.clear();
  for (std::uint32_t i = 0; i < rest.size(); ++i) {
    Mover mover{i, rest[i], directions[i], {}};
    if (moved_out[i] || moved_in[i]) {
      mover.direction = (0.5 / size) * (out[i] - in[i]);
      mover.bend = 0.5 * ((out[i] - rest[i]) + (in[i] - rest[i]));
    }
    if (moved[i] || mover.direction != Vector<D>{} || mover.bend != Vector<D>{}) movers_.push_back(mover);
  }
}

template <int D>
std::vector<Vertex_move<D>> Wall_pulsation<D>::targets(double time) const {
  const double turns = time / pulsation_.period, size = pulsation_.amplitude * std::min(1.0, turns);
  std::vector<Vertex_move<D>> result;
  result.reserve(movers_.size());
  for (const Mover& mover : movers_) {
    double phase = turns;
    if (pulsation_.wave) {
      const Vector<D>& wave = *pulsation_.wave;
      phase -= dot(mover.start - Point<D>{}, wave) / dot(wave, wave);
    }
    const double way = size * std::sin(2 * std::numbers::pi * phase);
    Point<D> target = mover.start + way * mover.direction;
    if (mover.bend != Vector<D>{}) {
      const double share = way / pulsation_.amplitude;
      target = target + (share * share) * mover.bend;
    }
    if (!is_finite(target))
      detail::refuse_motion("pulsation: the motion of point " + std::to_string(mover.point));
    result.push_back({mover.point, target});
  }
  return result;
}

template class Wall_pulsation<2>;
template class Wall_pulsation<3>;

}  // namespace cellwalk
