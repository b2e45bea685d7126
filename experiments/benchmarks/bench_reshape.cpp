// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move with nothing near: vertices of a membrane in grids of tetrahedra, and a vessel that beats.
// Nanoseconds of processor time a vertex, of its moves and of its share of close(). And a vertex that moves
// among edges of a body: nanoseconds an edge, of those that keep their chains and those that get new ones.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/reshape/reshaping.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "common/centre_lines.h"
#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace {

using namespace cellwalk;

/// Nanoseconds a vertex: the medians over all steps.
class Step_clock {
 public:
  void step(Environment<3>& environment, std::span<const Vertex_move<3>> moves, bool in_rounds) {
    const auto share = [&](double seconds) { return 1e9 * seconds / static_cast<double>(moves.size()); };
    const double start = experiments::processor_seconds();
    Reshaping<3> reshaping(environment, {{}, {}});
    if (in_rounds)
      short_ += reshaping.move(moves).short_of_target.size();
    else
      for (const auto& [point, target] : moves)
        short_ += reshaping.move(point, target).end != Move_end::reached;
    const double moved = experiments::processor_seconds();
    reshaping.finish();
    const double closed = experiments::processor_seconds();
    moves_.push_back(share(moved - start));
    close_.push_back(share(closed - moved));
    whole_.push_back(1e3 * (closed - start));
    if (in_rounds) tries_ += reshaping.counts().moves;
  }
  void report(benchmark::State& state) {
    state.counters["ns_move"] = experiments::median(moves_);
    state.counters["ns_close"] = experiments::median(close_);
    state.counters["ms_first"] = whole_.front();
    state.counters["ms_median"] = experiments::median(whole_);
    state.counters["ms_most"] = experiments::quantile(whole_, 1);
    state.counters["short"] = static_cast<double>(short_);
    if (tries_ != 0)
      state.counters["tries"] = static_cast<double>(tries_) / static_cast<double>(whole_.size());
  }

 private:
  std::vector<double> moves_, close_, whole_;
  std::size_t short_ = 0;
  std::uint64_t tries_ = 0;
};

/// So many vertices of the layer in the middle of a grid go a little way and back.
void layer(benchmark::State& state) {
  Simplex_grid_options<3> options;
  const auto side = static_cast<std::uint32_t>(std::cbrt(static_cast<double>(state.range(0)) / 6) + 0.5);
  options.cells = {side, side, side};
  options.jitter = 0.12;
  Environment<3> environment = Environment<3>::build(tetrahedral_grid(options), {.keep_map = false});
  const Snapshot<3>& snapshot = environment.snapshot();
  const auto wide = std::min<std::uint32_t>(side - 1, static_cast<std::uint32_t>(state.range(1)));
  const std::uint32_t first = (side - wide) / 2 + 1;
  std::vector<Vertex_move<3>> there, back;
  for (std::uint32_t y = 0; y < wide; ++y)
    for (std::uint32_t x = 0; x < wide; ++x) {
      const std::uint32_t v = first + x - (first + x == side) +
                              (side + 1) * (first + y - (first + y == side) + (side + 1) * (side / 2));
      const Point<3> home = snapshot.point(v);
      back.push_back({v, home});
      there.push_back({v, home + Vector<3>{0, 0, 0.02}});
    }
  Step_clock clock;
  bool is_back = true;
  for (auto _ : state) clock.step(environment, (is_back = !is_back) ? back : there, false);
  clock.report(state);
  state.counters["tetrahedra"] = static_cast<double>(snapshot.cell_count());
  state.counters["vertices"] = static_cast<double>(back.size());
}

constexpr double amplitude = 0.1;

/// A vessel whose points go away from the centre lines and back, by a tenth of their distance. All of them,
/// or those of one branch.
void vessel(benchmark::State& state, bool of_one_branch) {
  Environment<3> environment = Environment<3>::build(branching_vessel({}), {.keep_map = false});
  const Snapshot<3>& snapshot = environment.snapshot();
  const std::vector<Tube> tubes = vessel_tubes({});
  std::vector<Vertex_move<3>> moves;
  std::vector<Point<3>> home, centre;
  for (std::uint32_t v = 0; v < snapshot.points().size(); ++v) {
    const auto [nearest, tube] = experiments::centre_of(tubes, snapshot.point(v));
    if (of_one_branch && tube + 1 != tubes.size()) continue;
    moves.push_back({v, {}});
    home.push_back(snapshot.point(v));
    centre.push_back(nearest);
  }
  Step_clock clock;
  const auto steps_of_beat = static_cast<double>(state.range(0));
  int step = 0;
  for (auto _ : state) {
    const double share = amplitude * std::sin(2 * std::numbers::pi * ++step / steps_of_beat);
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i].target = home[i] + share * (home[i] - centre[i]);
    clock.step(environment, moves, true);
  }
  clock.report(state);
  state.counters["vertices"] = static_cast<double>(moves.size());
}

/// A vertex in the middle of a grid goes up and down, by thousandths of a cell, among edges through
/// its cells. With a wall, they lie above the middle layer, which is a membrane.
void edges(benchmark::State& state, bool has_wall) {
  Simplex_grid_options<3> options;
  options.cells = {8, 8, 8};
  Environment<3> environment = Environment<3>::build(tetrahedral_grid(options), {});
  const Snapshot<3>& snapshot = environment.snapshot();
  const Point<3> home{4, 4, 4};
  const auto points = snapshot.points();
  const auto vertex = static_cast<std::uint32_t>(std::ranges::find(points, home) - points.begin());
  for (std::size_t i = 0; has_wall && i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      if (std::ranges::all_of(snapshot.loop(f), [&](std::uint32_t v) { return points[v][2] == 4; }))
        environment.set_impassable(f, true);
    }
  Random random(1);
  Body_soup<3> soup;
  const auto count = static_cast<std::uint32_t>(state.range(0));
  for (std::uint32_t e = 0; e < count; ++e) {
    const Point<3> middle{random.real(3.6, 4.4), random.real(3.6, 4.4),
                          has_wall ? random.real(4.2, 4.6) : random.real(3.6, 4.4)};
    const double angle = random.real(0, 2 * std::numbers::pi);
    const double rise = has_wall ? random.real(-0.05, 0.05) : random.real(-0.7, 0.7);
    const Vector<3> along{std::cos(angle), std::sin(angle), rise};
    soup.points.push_back(middle + (-1.9) * along);
    soup.points.push_back(middle + 1.9 * along);
    soup.edges.push_back({2 * e, 2 * e + 1});
  }
  const Point<3> up = home + Vector<3>{0, 0, 1e-3 * static_cast<double>(state.range(1))};
  const auto beat = [&](Reshaping<3>& reshaping) {
    const double start = experiments::processor_seconds();
    for (const Point<3>& target : {up, home})
      if (reshaping.move(vertex, target).end != Move_end::reached) state.SkipWithError("blocked");
    return experiments::processor_seconds() - start;
  };
  double alone = 1, among = 1;
  {
    Reshaping<3> nothing(environment, {{}, {}});
    for (int k = 0; k < 200; ++k) alone = std::min(alone, beat(nothing));
  }
  Body<3> body(snapshot, Locator<3>(snapshot), soup);
  Reshaping<3> reshaping(environment, {{&body}, {}});
  beat(reshaping);
  const Reshape_counts before = reshaping.counts();
  for (auto _ : state) among = std::min(among, beat(reshaping));
  const Reshape_counts& after = reshaping.counts();
  const auto edges = static_cast<double>(after.edges - before.edges);
  state.counters["edges"] = edges / static_cast<double>(2 * state.iterations());
  state.counters["kept"] = static_cast<double>(after.same_chain - before.same_chain) / edges;
  state.counters["relinked"] = static_cast<double>(after.relinked - before.relinked) / edges;
  state.counters["ns_edge"] = 1e9 * (among - alone) / edges * static_cast<double>(state.iterations());
}

// So many steps each: the medians are of these.
BENCHMARK(layer)
    ->Args({1'000, 10})
    ->Args({10'000, 10})
    ->Args({100'000, 10})
    ->Args({1'000'000, 10})
    ->Iterations(60)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(layer)->Args({1'000'000, 50})->Iterations(20)->Unit(benchmark::kMicrosecond);
// A beat in so many steps.
BENCHMARK_CAPTURE(vessel, all, false)->Arg(16)->Arg(64)->Iterations(128)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(vessel, branch, true)->Arg(16)->Arg(64)->Iterations(512)->Unit(benchmark::kMillisecond);
// The least of so many rounds.
BENCHMARK_CAPTURE(edges, far_from_walls, false)
    ->Args({1000, 1})
    ->Args({1000, 200})
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(edges, above_a_wall, true)
    ->Args({1000, 1})
    ->Args({1000, 100})
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
