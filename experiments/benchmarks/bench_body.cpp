// SPDX-License-Identifier: LGPL-3.0-or-later
// What a move of a vertex with its three edges costs in the scene of the paper, with all certificates and
// without each of them: hexahedra of side 0.3 bounce in a grid of hexahedral unit cells, 10 % of them solid,
// by a fiftieth of a cell a step. Times include the response to contacts. Beside it, what the searches for a
// contact cost where there is one.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/rigid_body.h>
#include <cellwalk/kernel/error.h>

#include <benchmark/benchmark.h>

#include <deque>
#include <vector>

namespace {

using namespace cellwalk;

constexpr std::uint32_t side = 46;
constexpr int bodies = 225;
constexpr double step_length = 0.02;

const Snapshot<3>& scene() {
  static const Snapshot<3> snapshot = [] {
    Grid_options<3> options;
    options.cells = {side, side, side};
    options.solid_share = 0.1;
    const Cell_soup<3> soup = hex_grid(options);
    return Snapshot<3>::compile(soup, glue(soup));
  }();
  return snapshot;
}

std::vector<Rigid_body<3>> throw_bodies() {
  static const Locator<3> locator(scene());
  const Body_soup<3> shape = hexahedron_body(0.3, false);
  Random random(1);
  std::vector<Rigid_body<3>> result;
  while (result.size() < bodies) {
    Body_placement<3> placement;
    Vector<3> velocity;
    for (int k = 0; k < 3; ++k) {
      placement.position[k] = random.real(0, side);
      velocity[k] = random.real(-1, 1);
    }
    try {
      result.emplace_back(Body<3>(scene(), locator, transformed(shape, placement)), velocity,
                          Spin<3>{0.2, 0.3, 0.1});
    } catch (const Error&) {  // in a wall: elsewhere
    }
  }
  return result;
}

void fly(benchmark::State& state, const Body_options& options) {
  std::vector<Rigid_body<3>> rigid_bodies = throw_bodies();
  Dynamics_options<3> conditions;
  conditions.time_step = step_length;
  conditions.body = options;
  Step_report<3> report;
  Body_counts counts;
  for (auto _ : state) {
    for (Rigid_body<3>& rigid_body : rigid_bodies) rigid_body.step(conditions, report, counts);
    report.clear();
  }
  const auto n = static_cast<double>(counts.moves), edges = static_cast<double>(counts.edges.edges);
  const auto share = [](std::uint64_t part, double whole) { return static_cast<double>(part) / whole; };
  state.counters["time_per_move"] =
      benchmark::Counter(n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["in_region"] = share(counts.in_region, n);
  state.counters["edges"] = edges / n;
  state.counters["same_cell"] = share(counts.edges.same_cell, edges);
  state.counters["same_chain"] = share(counts.edges.same_chain, edges);
  state.counters["relinked"] = share(counts.edges.relinked, edges);
  state.counters["events"] = share(counts.edges.event_sweeps, edges);
  state.counters["contacts"] = share(counts.contacts, n);
}

void all(benchmark::State& s) { fly(s, {}); }
void no_clearance(benchmark::State& s) {
  Body_options options;
  options.clearance = false;
  fly(s, options);
}
void no_certificate(benchmark::State& s) {
  Body_options options;
  options.clearance = false;
  options.sweep.certificates = false;
  fly(s, options);
}
void three_segments(benchmark::State& s) {
  Body_options options;
  options.clearance = false;
  options.sweep.sweep = Sweep::three_segments;
  fly(s, options);
}

BENCHMARK(all)->Unit(benchmark::kMicrosecond);
BENCHMARK(no_clearance)->Unit(benchmark::kMicrosecond);
BENCHMARK(no_certificate)->Unit(benchmark::kMicrosecond);
BENCHMARK(three_segments)->Unit(benchmark::kMicrosecond);

/// Edges that a wall stops, each with the motion that it stops.
struct Blocked {
  Particle<3> p, q;
  Point<3> target;
  Chain chain;
};

const std::deque<Blocked>& blocked() {
  static const std::deque<Blocked> result = [] {
    const Locator<3> locator(scene());
    Random random(2);
    Edge_counts counts;
    std::deque<Blocked> found;
    while (found.size() < 500) {
      Point<3> p, q, t;
      for (int k = 0; k < 3; ++k) {
        p[k] = random.real(2, side - 2);
        q[k] = p[k] + random.real(-1, 1);
        t[k] = p[k] + random.real(-0.3, 0.3);
      }
      const auto from = locator.particle_at(p), to = locator.particle_at(q);
      if (!from || !to) continue;
      const Chain_result<3> edge = find_chain(scene(), *from, *to, counts.walk);
      if (edge.contact) continue;
      const auto swept = sweep_edge(scene(), *from, t, *to, edge.chain, {}, counts);
      if (!swept.contact || swept.contact->body != Body_feature::edge) continue;
      const Blocked motion{*from, *to, t, edge.chain};
      found.push_back(motion);
    }
    return found;
  }();
  return result;
}

void sweep(benchmark::State& state, const Sweep_options& options) {
  Edge_counts counts;
  for (auto _ : state)
    for (const Blocked& b : blocked())
      benchmark::DoNotOptimize(sweep_edge(scene(), b.p, b.target, b.q, b.chain, options, counts));
  const auto n = static_cast<double>(state.iterations()) * static_cast<double>(blocked().size());
  state.counters["time_per_contact"] =
      benchmark::Counter(n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["event_sweeps"] = static_cast<double>(counts.event_sweeps) / n;
  state.counters["search_sweeps"] = static_cast<double>(counts.search_sweeps) / n;
  state.counters["walls"] = static_cast<double>(counts.search_walls) / n;
  state.counters["misses"] = static_cast<double>(counts.search_misses) / n;
}

void search(benchmark::State& state, const Search_options& options) { sweep(state, {.search = &options}); }

void exact(benchmark::State& s) { sweep(s, {}); }
void dichotomic(benchmark::State& s) { search(s, {}); }
void exhaustive(benchmark::State& s) { search(s, {.method = Contact_search::exhaustive}); }
void exhaustive_traversed(benchmark::State& s) {
  search(s, {.method = Contact_search::exhaustive, .cells = Search_cells::traversed});
}
void touches(benchmark::State& s) { sweep(s, {.touch = Touch::stop}); }

BENCHMARK(exact)->Unit(benchmark::kMicrosecond);
BENCHMARK(dichotomic)->Unit(benchmark::kMicrosecond);
BENCHMARK(exhaustive)->Unit(benchmark::kMicrosecond);
BENCHMARK(exhaustive_traversed)->Unit(benchmark::kMicrosecond);
BENCHMARK(touches)->Unit(benchmark::kMicrosecond);

}  // namespace
