// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move with nothing near: vertices of a membrane in grids of tetrahedra, and a vessel that beats.
// Nanoseconds of processor time a vertex, of its moves and of its share of close().
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
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
    reshaping.close();
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

}  // namespace
