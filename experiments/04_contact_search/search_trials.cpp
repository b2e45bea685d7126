// SPDX-License-Identifier: LGPL-3.0-or-later
#include "search_trials.h"

#include <cellwalk/generators/room.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "box_world.h"
#include "common/processor_time.h"

namespace cellwalk::contact_search {
namespace {

template <int D>
struct Scene {
  Environment<D> environment;
  double edge, step;  ///< lengths, in units of the environment
};

Scene<2> room() {
  Room_options options;
  options.obstacles = 6;
  options.rooms = {2, 2};
  return {Environment<2>::build(room_2d(options)), 3, 1.5};
}

Scene<3> boxes() {
  small_obstacles::Box_world_options<3> options;
  options.cubes = 8;
  return {small_obstacles::box_world<3>(options), 2, 0.5};
}

Scene<3> vessel() {
  Vessel_options options;
  options.generations = 1;
  Build_options build;
  build.keep_map = false;
  return {Environment<3>::build(branching_vessel(options), build), 1, 0.5};
}

template <int D>
struct Trial {
  Particle<D> p, q;
  Point<D> target;
  Chain chain;
  Contact<D> exact;
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

/// The corners of the box about all points.
template <int D>
std::array<Point<D>, 2> bounds(const Snapshot<D>& snapshot) {
  std::array<Point<D>, 2> box;
  box[0].fill(std::numeric_limits<double>::infinity());
  box[1].fill(-std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < snapshot.cell_count(); ++c) {
    const Cell_view<D> cell = snapshot.view(snapshot.cell(c));
    for (std::size_t i = 0; i < cell.facet_count(); ++i)
      for (const std::uint32_t v : snapshot.loop(Snapshot<D>::half_facet(snapshot.cell(c), i)))
        for (std::size_t k = 0; k < D; ++k) {
          box[0][k] = std::min(box[0][k], snapshot.point(v)[k]);
          box[1][k] = std::max(box[1][k], snapshot.point(v)[k]);
        }
  }
  return box;
}

/// Moves of an edge at which it is blocked before its end is.
template <int D>
std::vector<Trial<D>> draw(const Scene<D>& scene, Random& random, std::size_t wanted) {
  const Snapshot<D>& snapshot = scene.environment.snapshot();
  const Locator<D> locator(snapshot);
  const auto [low, high] = bounds(snapshot);
  std::vector<Trial<D>> trials(wanted);
  Edge_counts counts;
  for (std::size_t found = 0; found < wanted;) {
    Trial<D>& t = trials[found];
    Point<D> x;
    for (std::size_t k = 0; k < D; ++k) x[k] = random.real(low[k], high[k]);
    t.p = locator.particle_at(x).value_or(Particle<D>{});
    if (t.p.cell == Cell::none) continue;
    t.q = locator.particle_at(x + scene.edge * random_direction<D>(random)).value_or(Particle<D>{});
    if (t.q.cell == Cell::none) continue;
    const Chain_result<D> before = find_chain(snapshot, t.p, t.q, counts.walk);
    if (before.contact) continue;
    t.chain = before.chain;
    t.target = x + scene.step * random_direction<D>(random);
    const auto contact = sweep_edge<D>(snapshot, t.p, t.target, t.q, t.chain, {}, counts).contact;
    if (!contact || contact->body != Body_feature::edge) continue;
    t.exact = *contact;
    ++found;
  }
  return trials;
}

Sweep_options options_of(const Search& search) {
  return {.search = search.options ? &*search.options : nullptr};
}

/// The points of the feature of the environment that a contact names, ascending.
template <int D>
std::vector<std::uint32_t> feature(const Snapshot<D>& snapshot, const Contact<D>& contact) {
  std::vector<std::uint32_t> loop = snapshot.loop(contact.facet);
  if (contact.kind == Contact_kind::vertex) return {loop[contact.corner]};
  if (contact.kind == Contact_kind::edge)
    loop = {loop[contact.corner], loop[(contact.corner + 1) % loop.size()]};
  std::sort(loop.begin(), loop.end());
  return loop;
}

/// The angle between unit vectors, small ones included.
template <std::size_t D>
double degrees_between(const std::array<double, D>& u, const std::array<double, D>& v) {
  return 2 * std::asin(std::min(1.0, length(u - v) / 2)) * 180 / std::numbers::pi;
}

/// The distance of a point from the segment pq.
template <std::size_t D>
double distance(const std::array<double, D>& x, const std::array<double, D>& p,
                const std::array<double, D>& q) {
  const std::array<double, D> way = q - p;
  return length(x - (p + std::clamp(dot(x - p, way) / dot(way, way), 0.0, 1.0) * way));
}

template <int D>
Search_tally locate_all(const Scene<D>& scene, const std::vector<Trial<D>>& trials, const Search& search) {
  const Snapshot<D>& snapshot = scene.environment.snapshot();
  const Sweep_options options = options_of(search);
  Search_tally tally;
  for (const Trial<D>& t : trials) {
    const Contact<D> found =
        *sweep_edge<D>(snapshot, t.p, t.target, t.q, t.chain, options, tally.counts).contact;
    const auto order = found.exact_time() <=> t.exact.exact_time();
    tally.same_time += order == 0;
    tally.late += order > 0;
    tally.same_feature += feature(snapshot, found) == feature(snapshot, t.exact);
    const Point<D> end = t.p.position + found.time * (t.target - t.p.position);
    tally.errors.push_back(
        {t.exact.time - found.time, order == 0 ? 0 : distance(t.exact.point, end, t.q.position) / scene.step,
         length(found.point - t.exact.point) / scene.step, degrees_between(found.normal, t.exact.normal)});
  }
  return tally;
}

template <int D>
void time_all(const Scene<D>& scene, const std::vector<Trial<D>>& trials, const std::vector<Search>& searches,
              int rounds, std::vector<Search_tally>& tallies) {
  const std::size_t n = std::min(trials.size(), timed_contacts);
  std::vector<std::vector<double>> times(searches.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < searches.size(); ++i) {
      const Sweep_options options = options_of(searches[i]);
      Edge_counts counts;
      const double start = experiments::processor_seconds();
      for (std::size_t k = 0; k < n; ++k) {
        const Trial<D>& t = trials[k];
        sweep_edge<D>(scene.environment.snapshot(), t.p, t.target, t.q, t.chain, options, counts);
      }
      times[i].push_back(1e6 * (experiments::processor_seconds() - start) / static_cast<double>(n));
    }
  for (std::size_t i = 0; i < searches.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    tallies[i].microseconds = times[i][times[i].size() / 2];
  }
}

template <int D>
std::vector<Search_tally> run_in(const Scene<D>& scene, const std::vector<Search>& searches,
                                 const Trial_options& options) {
  Random random(options.seed);
  const std::vector<Trial<D>> trials = draw(scene, random, options.contacts);
  std::vector<Search_tally> tallies;
  for (const Search& search : searches) tallies.push_back(locate_all(scene, trials, search));
  if (options.rounds > 0) time_all(scene, trials, searches, options.rounds, tallies);
  return tallies;
}

}  // namespace

std::string_view name_of(World world) {
  switch (world) {
    case World::room:
      return "room";
    case World::boxes:
      return "boxes";
    case World::vessel:
      break;
  }
  return "vessel";
}

std::vector<Search_tally> run(World world, const std::vector<Search>& searches,
                              const Trial_options& options) {
  switch (world) {
    case World::room:
      return run_in(room(), searches, options);
    case World::boxes:
      return run_in(boxes(), searches, options);
    case World::vessel:
      break;
  }
  return run_in(vessel(), searches, options);
}

}  // namespace cellwalk::contact_search
