// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells that are replaced by others among bodies, and back: nanoseconds of processor time an operation, and
// the memory after many of them.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/reshape/reshaping.h>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace {

using namespace cellwalk;

constexpr int vertices_of_body = 200;

Environment<3> grid(std::int64_t cells) {
  Simplex_grid_options<3> options;
  const auto side = static_cast<std::uint32_t>(std::cbrt(static_cast<double>(cells) / 6) + 0.5);
  options.cells = {side, side, side};
  options.jitter = 0.12;
  return Environment<3>::build(tetrahedral_grid(options));
}

/// A coil in the middle of the grid, with edges of a fifth of a cell.
Body<3> coil(const Snapshot<3>& snapshot) {
  Body_soup<3> soup;
  const double middle = std::floor(snapshot.points().back()[0]) / 2;
  for (int k = 0; k < vertices_of_body; ++k) {
    const double t = 0.15 * k;
    soup.points.push_back({middle + 1.3 * std::cos(t), middle + 1.3 * std::sin(t), middle - 1.5 + 0.1 * t});
    if (k > 0) soup.edges.push_back({static_cast<std::uint32_t>(k - 1), static_cast<std::uint32_t>(k)});
  }
  return Body<3>(snapshot, Locator<3>(snapshot), soup);
}

enum Kind { flip, remove_edge, split, insert, collapse, kinds };

/// Operations in cells with vertices of the body, each taken back.
class Replacing {
 public:
  Replacing(Environment<3>& environment, Body<3>* body)
      : snapshot_(environment.snapshot()), body_(body), reshaping_(environment, residents(body)) {}

  void run() {
    const Cell cell = some_cell();
    const Cell_view<3> view = snapshot_.view(cell);
    const std::uint32_t u = view.point_index(random_.below(4));
    const std::size_t facet = random_.below(4);
    const Half_facet f = Snapshot<3>::half_facet(cell, facet);
    std::uint32_t apex = 0, other = 0;
    if (snapshot_.neighbour(f) != Cell::none) {
      apex = apex_of(f);
      other = apex_of(snapshot_.opposite(f));
    }
    if (timed(flip, [&] { return reshaping_.flip(f); }).is_made)
      timed(remove_edge, [&] { return reshaping_.remove_edge(apex, other); });
    const Cell now = some_cell();
    Point<3> x = snapshot_.view(now).point(0);
    for (std::size_t k = 1; k < 4; ++k)
      x = x + (1.0 / (1.0 + static_cast<double>(k))) * (snapshot_.view(now).point(k) - x);
    const std::uint32_t onto = snapshot_.view(now).point_index(0);
    const Replacement in = timed(insert, [&] { return reshaping_.insert_point(now, x); });
    if (in.is_made) timed(collapse, [&] { return reshaping_.collapse(in.point, onto); });
    const Cell third = some_cell();
    const std::uint32_t a = snapshot_.view(third).point_index(0), b = snapshot_.view(third).point_index(1);
    const Point<3> half = snapshot_.point(a) + 0.5 * (snapshot_.point(b) - snapshot_.point(a));
    const Replacement cut = timed(split, [&] { return reshaping_.split_edge(a, b, half); });
    if (cut.is_made) timed(collapse, [&] { return reshaping_.collapse(cut.point, a); });
    benchmark::DoNotOptimize(u);
  }
  const std::vector<double>& times(Kind kind) const { return times_[kind]; }
  std::uint64_t made() const { return made_; }
  const Reshape_counts& counts() const { return reshaping_.counts(); }

 private:
  static Residents<3> residents(Body<3>* body) {
    Residents<3> result;
    if (body) result.bodies.push_back(body);
    return result;
  }
  Cell some_cell() {
    if (body_) return body_->particles()[random_.below(vertices_of_body)].cell;
    for (;;)
      if (const Cell c = snapshot_.cell(random_.below(snapshot_.cell_slots())); c != Cell::none) return c;
  }
  std::uint32_t apex_of(Half_facet f) const {
    const auto loop = snapshot_.loop(f);
    for (const std::uint32_t v : snapshot_.view(snapshot_.cell_of(f)).vertices)
      if (v != loop[0] && v != loop[1] && v != loop[2]) return v;
    return loop[0];
  }
  template <class Edit>
  Replacement timed(Kind kind, const Edit& edit) {
    const double start = experiments::processor_seconds();
    Replacement result = edit();
    if (result.is_made) {
      times_[kind].push_back(1e9 * (experiments::processor_seconds() - start));
      ++made_;
    }
    return result;
  }

  const Snapshot<3>& snapshot_;
  Body<3>* body_;
  Reshaping<3> reshaping_;
  Random random_{1};
  std::array<std::vector<double>, kinds> times_;
  std::uint64_t made_ = 0;
};

void replace(benchmark::State& state) {
  Environment<3> environment = grid(state.range(0));
  const Snapshot<3>& snapshot = environment.snapshot();
  Body<3> body = coil(snapshot);
  const std::size_t slots = snapshot.half_facet_slots() / 4, points = snapshot.points().size();
  Replacing replacing(environment, state.range(1) != 0 ? &body : nullptr);
  for (auto _ : state) replacing.run();
  constexpr std::array<const char*, kinds> names{"ns_flip", "ns_remove", "ns_split", "ns_insert",
                                                 "ns_collapse"};
  for (int kind = 0; kind < kinds; ++kind) {
    const std::vector<double>& times = replacing.times(static_cast<Kind>(kind));
    if (!times.empty()) state.counters[names[static_cast<std::size_t>(kind)]] = experiments::median(times);
  }
  state.counters["tetrahedra"] = static_cast<double>(snapshot.cell_count());
  state.counters["made"] = static_cast<double>(replacing.made());
  state.counters["relinked"] = static_cast<double>(replacing.counts().relinked);
  state.counters["more_slots"] = static_cast<double>(snapshot.half_facet_slots() / 4 - slots);
  state.counters["more_points"] = static_cast<double>(snapshot.points().size() - points);
}

// With a body, and without.
BENCHMARK(replace)
    ->ArgsProduct({{1'000, 10'000, 100'000, 1'000'000}, {1, 0}})
    ->Iterations(3000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(replace)->Args({10'000, 1})->Iterations(200'000)->Unit(benchmark::kMicrosecond);

}  // namespace
