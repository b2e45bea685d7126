// SPDX-License-Identifier: LGPL-3.0-or-later
// What a radius costs: free edges of length 0.3 in the vessel of the demo, whose one end moves there and back
// by 0.05. Without a radius as a sweep of the triangle; with one by a flood each time, and by a list of near
// walls.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/edge/near_wall_list.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/query/query.h>

#include <benchmark/benchmark.h>

#include <span>
#include <vector>

namespace {

using namespace cellwalk;

constexpr double length_of_edges = 0.3, length_of_moves = 0.05;

const Environment<3>& vessel() {
  static const auto environment = Environment<3>::build(branching_vessel({}));
  return environment;
}

struct Edge {
  Particle<3> p, q;
  Point<3> target;
  Chain chain;
};

/// Edges whose moves are free with a radius.
const std::vector<Edge>& edges(double radius) {
  static double known = -1;
  static std::vector<Edge> result;
  if (known == radius) return result;
  known = radius;
  result.clear();
  const Snapshot<3>& snapshot = vessel().snapshot();
  const Locator<3> locator(snapshot);
  Random random(3);
  Edge_counts counts;
  const auto direction = [&] {
    return normalized(Vector<3>{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
  };
  while (result.size() < 2000) {
    const Point<3>& corner = snapshot.points()[random.below(snapshot.points().size())];
    const Point<3> p = corner + 0.3 * random.real() * direction(), q = p + length_of_edges * direction(),
                   t = p + length_of_moves * direction();
    const Edge_motion<3> motion{p, t, q, radius};
    if (answer_sweep<3>(snapshot, locator, motion, {}, counts).status != Motion_status::free) continue;
    Edge e{locator.particle_at(p).value(), locator.particle_at(q).value(), t, {}};
    e.chain = find_chain(snapshot, e.p, e.q, counts.walk).chain;
    result.push_back(e);
  }
  return result;
}

double radius_of(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 100; }

void without_radius(benchmark::State& state) {
  const auto& all = edges(radius_of(state));
  Edge_counts counts;
  for (auto _ : state)
    for (const Edge& e : all)
      benchmark::DoNotOptimize(
          sweep_edge(vessel().snapshot(), e.p, e.target, e.q, e.chain, {}, counts).contact);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

void by_flood(benchmark::State& state) {
  const auto& all = edges(radius_of(state));
  Edge_counts counts;
  for (auto _ : state)
    for (const Edge& e : all)
      benchmark::DoNotOptimize(
          detail::sweep_thick<3>(vessel().snapshot(), e.p.cell,
                                 {e.p.position, e.target, e.q.position, radius_of(state)}, counts)
              .contact);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
  state.counters["cells"] = static_cast<double>(counts.flooded_cells) / static_cast<double>(counts.floods);
}

/// The answer of the list of an edge, which is made if it does not hold.
bool is_free(detail::Near_wall_list<3>& list, const Edge& edge, double radius) {
  const Snapshot<3>& snapshot = vessel().snapshot();
  const std::array<detail::Thick_motion<3>, 1> motion{
      {{edge.p.position, edge.target, edge.q.position, radius}}};
  if (!list.holds(snapshot, motion)) {
    detail::Box<3> box;
    for (const Point<3>& x : {edge.p.position, edge.q.position}) box.extend(x);
    list.make(snapshot, edge.p.cell, box, radius, motion);
  }
  return list.are_free(snapshot, motion);
}

/// The lists of 100 edges stay in the cache, as those of a body do; those of 2000 do not.
void by_list(benchmark::State& state) {
  const auto all = std::span(edges(radius_of(state))).first(static_cast<std::size_t>(state.range(1)));
  std::vector<detail::Near_wall_list<3>> lists(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) is_free(lists[i], all[i], radius_of(state));
  for (auto _ : state)
    for (std::size_t i = 0; i < all.size(); ++i)
      benchmark::DoNotOptimize(is_free(lists[i], all[i], radius_of(state)));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

/// A list, made and used once.
void list_made(benchmark::State& state) {
  const auto& all = edges(radius_of(state));
  for (auto _ : state)
    for (const Edge& e : all) {
      detail::Near_wall_list<3> list;
      benchmark::DoNotOptimize(is_free(list, e, radius_of(state)));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

/// Moves ten times as long, those that a wall blocks.
std::vector<Edge> blocked_edges(double radius) {
  std::vector<Edge> blocked;
  Edge_counts counts;
  for (Edge e : edges(radius)) {
    e.target = e.p.position + 10.0 * (e.target - e.p.position);
    if (detail::sweep_thick<3>(vessel().snapshot(), e.p.cell, {e.p.position, e.target, e.q.position, radius},
                               counts)
            .contact)
      blocked.push_back(e);
  }
  return blocked;
}

void contact(benchmark::State& state) {
  const double radius = radius_of(state);
  const std::vector<Edge> all = blocked_edges(radius);
  Edge_counts counts;
  for (auto _ : state)
    for (const Edge& e : all)
      benchmark::DoNotOptimize(detail::sweep_thick<3>(vessel().snapshot(), e.p.cell,
                                                      {e.p.position, e.target, e.q.position, radius}, counts)
                                   .contact);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

/// As bodies do; some contacts are left to a flood.
void contact_by_list(benchmark::State& state) {
  const double radius = radius_of(state);
  const std::vector<Edge> all = blocked_edges(radius);
  std::vector<detail::Near_wall_list<3>> lists(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) is_free(lists[i], all[i], radius);
  std::size_t found = 0;
  for (auto _ : state)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const detail::Thick_motion<3> motion{all[i].p.position, all[i].target, all[i].q.position, radius};
      found += detail::contact_without_flood<3>(vessel().snapshot(), all[i].p.cell, motion,
                                                lists[i].walls_near(vessel().snapshot(), motion),
                                                detail::Swept_part::all)
                   .has_value();
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
  state.counters["found"] =
      static_cast<double>(found) / static_cast<double>(state.iterations()) / static_cast<double>(all.size());
}

/// Steps of a hexahedron of side 0.3 that goes to and fro in the middle of an empty room; the time of a
/// vertex.
void body_in_the_open(benchmark::State& state) {
  static const auto room = Environment<3>::build(hex_grid({.cells = {20, 20, 20}}));
  Body_soup<3> soup = hexahedron_body(0.3);
  for (Point<3>& x : soup.points) x = x + Vector<3>{10, 10, 10};
  soup.radii = {radius_of(state)};
  Body<3> body(room, soup);
  std::vector<Point<3>> targets = soup.points;
  Body_counts counts;
  Step_report<3> report;
  double side = length_of_moves;
  for (auto _ : state) {
    for (Point<3>& x : targets) x[0] += side;
    side = -side;
    body.step(targets, {}, report, counts);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(targets.size()));
}

BENCHMARK(without_radius)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(by_flood)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(by_list)->ArgsProduct({{5, 15, 30}, {100, 2000}})->Unit(benchmark::kMicrosecond);
BENCHMARK(list_made)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(contact)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(contact_by_list)->Arg(5)->Arg(15)->Arg(30)->Unit(benchmark::kMicrosecond);
BENCHMARK(body_in_the_open)->Arg(0)->Arg(30);

}  // namespace
