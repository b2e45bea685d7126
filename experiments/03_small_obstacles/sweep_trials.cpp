// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sweep_trials.h"

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "box_world.h"
#include "common/processor_time.h"

namespace cellwalk::small_obstacles {
namespace {

constexpr std::uint32_t period = 4;         // cubes along each axis in which edges start
constexpr std::size_t timed_moves = 10000;  // they go through the caches again in each round

template <int D>
struct Move {
  Particle<D> p, q;
  Point<D> target;
  Chain chain;
};

template <int D>
Vector<D> random_direction(Random& random) {
  for (;;) {
    Vector<D> v;
    for (double& x : v) x = random.real(-1, 1);
    const double square = dot(v, v);
    if (square <= 1 && square > 0x1p-20) return (1 / std::sqrt(square)) * v;
  }
}

/// Twice the area of a triangle.
template <int D>
double twice_area(const Vector<D>& u, const Vector<D>& v) {
  if constexpr (D == 3) return length(cross(u, v));
  return std::abs(u[0] * v[1] - u[1] * v[0]);
}

/// How many of the boxes, one in each unit of space, meet a triangle but not its side pq, on average over all
/// places and directions: the principal kinematic formula for convex sets.
template <int D>
double expected_hits(const Point<D>& p, const Point<D>& target, const Point<D>& q, double side) {
  const double area = twice_area<D>(target - p, q - p) / 2;
  // The perimeter of the triangle, less that of the side counted there and back.
  const double more = length(target - p) + length(q - target) - length(q - p);
  if constexpr (D == 3) return 1.5 * side * area + 0.75 * side * side * more;
  return area + 4 * side * more / (2 * std::numbers::pi);
}

template <int D>
class Moves {
 public:
  explicit Moves(const Sweep_setting& setting)
      : setting_(setting),
        edge_(setting.edge_over_step * setting.step),
        border_(static_cast<std::uint32_t>(std::ceil(edge_ + setting.step))),
        side_(setting.size_over_step * setting.step),
        environment_(box_world<D>({period + 2 * border_, side_, scramble(setting.seed)})),
        locator_(snapshot()),
        random_(setting.seed) {}

  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }

  /// Draws the next move. False if it starts in or across a box: then it is not made. `expected` receives the
  /// contacts expected of it in either case.
  bool draw(Move<D>& move, double& expected) {
    Point<D> x;
    for (double& coordinate : x) coordinate = border_ + period * random_.real();
    const Point<D> y = x + edge_ * random_direction<D>(random_);
    move.target = x + setting_.step * random_direction<D>(random_);
    expected = expected_hits<D>(x, move.target, y, side_);
    move.p = locator_.particle_at(x).value_or(Particle<D>{});
    move.q = locator_.particle_at(y).value_or(Particle<D>{});
    if (move.p.cell == Cell::none || move.q.cell == Cell::none) return false;
    Walk_counts counts;
    const Chain_result<D> before = find_chain(snapshot(), move.p, move.q, counts);
    move.chain = before.chain;
    return !before.contact;
  }

 private:
  Sweep_setting setting_;
  double edge_;
  std::uint32_t border_;
  double side_;
  Environment<D> environment_;
  Locator<D> locator_;
  Random random_;
};

template <int D>
Sweep_tally run(const Sweep_setting& setting) {
  Moves<D> moves(setting);
  Sweep_tally tally;
  Move<D> m;
  for (std::uint64_t i = 0; i < setting.draws; ++i) {
    double expected = 0;
    const bool is_made = moves.draw(m, expected);
    tally.expected_contacts += expected;
    if (!is_made) continue;
    ++tally.sweeps;
    std::array<std::optional<Contact<D>>, 2> found;
    for (std::size_t k = 0; k < found.size(); ++k) {
      Sweep_options options;
      options.sweep = sweeps_compared[k];
      found[k] =
          sweep_edge<D>(moves.snapshot(), m.p, m.target, m.q, m.chain, options, tally.cost[k].counts).contact;
    }
    const auto& [segments, complete] = found;
    if (complete && complete->body == Body_feature::edge) {
      ++tally.edge_contacts;
      tally.missed += !segments;
      tally.late += segments && complete->exact_time() < segments->exact_time();
    }
    tally.vertex_contacts += complete && complete->body == Body_feature::vertex;
    tally.false_contacts += segments && !complete;
  }
  return tally;
}

template <int D>
void time(const Sweep_setting& setting, int rounds, Sweep_tally& tally) {
  Moves<D> moves(setting);
  std::vector<Move<D>> made(timed_moves);
  std::size_t count = 0;
  double expected = 0;
  for (std::uint64_t i = 0; i < setting.draws && count < made.size(); ++i)
    count += moves.draw(made[count], expected);
  made.resize(count);
  std::array<std::vector<double>, sweeps_compared.size()> times;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < times.size(); ++k) {
      Sweep_options options;
      options.sweep = sweeps_compared[k];
      Edge_counts counts;
      const double start = experiments::processor_seconds();
      for (const Move<D>& m : made)
        sweep_edge<D>(moves.snapshot(), m.p, m.target, m.q, m.chain, options, counts);
      times[k].push_back(1e9 * (experiments::processor_seconds() - start) / static_cast<double>(made.size()));
    }
  for (std::size_t k = 0; k < times.size(); ++k) {
    std::sort(times[k].begin(), times[k].end());
    tally.cost[k].nanoseconds = times[k][times[k].size() / 2];
  }
}

}  // namespace

Sweep_tally run_sweeps(const Sweep_setting& setting) {
  return setting.dimension == 2 ? run<2>(setting) : run<3>(setting);
}

void time_sweeps(const Sweep_setting& setting, int rounds, Sweep_tally& tally) {
  setting.dimension == 2 ? time<2>(setting, rounds, tally) : time<3>(setting, rounds, tally);
}

}  // namespace cellwalk::small_obstacles
