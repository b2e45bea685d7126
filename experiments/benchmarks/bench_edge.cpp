// SPDX-License-Identifier: LGPL-3.0-or-later
// What the check of a moving body edge costs: by walking a temporary particle along it each time (the paper),
// with the certificate of its old chain in front of that, and as a complete sweep of the triangle.
//
// Edges of a given length, in units of the cubes that six tetrahedra fill, lie all over a jittered grid of
// 10^5 tetrahedra without inner walls. Their one end moves there and back by a twentieth of a cube. Times
// include the walk of that end.
//
// Faces are swept in the same grid, far from all walls, and in one in which some facets are walls: there,
// times are of sweep_face alone, of moves that are free.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/three_segments.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

namespace {

using namespace cellwalk;

constexpr std::uint32_t side = 26;  // 6 side^3 tetrahedra
constexpr double reach = 0.05;

const Snapshot<3>& grid() {
  static const Snapshot<3> snapshot = [] {
    Simplex_grid_options<3> options;
    options.cells = {side, side, side};
    options.jitter = 0.12;
    const Cell_soup<3> soup = tetrahedral_grid(options);
    return Snapshot<3>::compile(soup, glue(soup));
  }();
  return snapshot;
}

struct Edge {
  Particle<3> p, q;
  Chain chain;
  std::array<Point<3>, 2> targets;
};

std::vector<Edge> edges(double length) {
  const Locator<3> locator(grid());
  Random random(3);
  Walk_counts counts;
  std::vector<Edge> result(2000);
  for (Edge& e : result) {
    Point<3> p, q, t;
    for (int k = 0; k < 3; ++k) {
      p[k] = random.real(length + 1, side - length - 1);
      q[k] = p[k] + length * random.real(-1, 1) / 1.7;
      t[k] = p[k] + reach * random.real(-1, 1);
    }
    e = {locator.particle_at(p).value(), locator.particle_at(q).value(), {}, {t, p}};
    e.chain = find_chain(grid(), e.p, e.q, counts).chain;
  }
  return result;
}

enum class Check { walk, three_segments, triangle };

void check_edges(benchmark::State& state, Check check) {
  std::vector<Edge> all = edges(static_cast<double>(state.range(0)) / 10);
  Edge_counts counts;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  bool back = true;
  std::size_t blocked = 0;
  for (auto _ : state) {
    back = !back;
    for (Edge& e : all) {
      visited.clear();
      crossed.clear();
      const Particle<3> from = e.p;
      move(grid(), e.p, e.targets[back], counts.walk, {&visited, &crossed});
      const auto note = [&](auto&& result) {
        blocked += result.contact.has_value();
        e.chain = std::move(result.chain);
      };
      if (check == Check::walk) {
        ++counts.edges;
        note(find_chain(grid(), e.p, e.q, counts.walk));
      } else if (check == Check::three_segments) {
        note(check_third_segment<3>(grid(), {from, e.p, visited, crossed}, e.q, e.chain, counts));
      } else {
        note(sweep_triangle<3>(grid(), {from, e.p, visited, crossed}, e.q, e.chain, counts));
      }
    }
  }
  if (blocked != 0) state.SkipWithError("an edge met a wall");
  const auto n = static_cast<double>(counts.edges);
  state.counters["time_per_edge"] =
      benchmark::Counter(n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["same_cell"] = static_cast<double>(counts.same_cell) / n;
  state.counters["same_chain"] = static_cast<double>(counts.same_chain) / n;
  state.counters["changed"] = static_cast<double>(counts.changed) / n;
  state.counters["facets"] = static_cast<double>(counts.chain_facets) / n;
}

void walk_each_time(benchmark::State& s) { check_edges(s, Check::walk); }
void three_segments(benchmark::State& s) { check_edges(s, Check::three_segments); }
void triangle(benchmark::State& s) { check_edges(s, Check::triangle); }

void lengths(benchmark::internal::Benchmark* b) { b->Arg(1)->Arg(3)->Arg(10)->ArgName("length_in_tenths"); }

BENCHMARK(walk_each_time)->Apply(lengths);
BENCHMARK(three_segments)->Apply(lengths);
BENCHMARK(triangle)->Apply(lengths);

/// The same grid with some facets made walls.
const Snapshot<3>& grid_with_walls() {
  static const Snapshot<3> snapshot = [] {
    Simplex_grid_options<3> options;
    options.cells = {side, side, side};
    options.jitter = 0.12;
    Cell_soup<3> soup = tetrahedral_grid(options);
    Random random(1);
    for (auto& wall : soup.impassable) wall = random.below(40) == 0;
    return Snapshot<3>::compile(soup, glue(soup));
  }();
  return snapshot;
}

/// A face, and the two ways of its corner p.
struct Swept {
  std::array<Vertex_path<3>, 2> ways;
  Particle<3> q, r;
  std::array<Chain, 4> chains;  ///< of pq at both ends of the way, of qr, and of rp at the end
};

/// Faces whose edges and way are free, with or without walls near.
std::vector<Swept> swept_faces(const Snapshot<3>& snapshot, double length, bool near_walls) {
  const Locator<3> locator(snapshot);
  Random random(5);
  Edge_counts edge_counts;
  Face_counts counts;
  std::vector<Swept> result;
  while (result.size() < 2000) {
    std::array<Point<3>, 4> x;  // p, its target, q, r
    for (int k = 0; k < 3; ++k) {
      x[0][k] = random.real(length + 1, side - length - 1);
      x[1][k] = x[0][k] + reach * random.real(-1, 1);
      for (const int j : {2, 3}) x[j][k] = x[0][k] + length * random.real(-1, 1) / 1.7;
    }
    const Particle<3> p = locator.particle_at(x[0]).value(), t = locator.particle_at(x[1]).value();
    const Vertex_path<3> path{p, t, {}, {}, false}, back{t, p, {}, {}, false};
    Swept s{{path, back}, locator.particle_at(x[2]).value(), locator.particle_at(x[3]).value(), {}};
    Walk_counts& walks = edge_counts.walk;
    const auto qr = find_chain(snapshot, s.q, s.r, walks), pq = find_chain(snapshot, p, s.q, walks),
               rp = find_chain(snapshot, s.r, p, walks), tq = find_chain(snapshot, t, s.q, walks);
    const bool is_free = !qr.contact && !pq.contact && !rp.contact && !tq.contact &&
                         !find_chain(snapshot, p, t, walks).contact;
    if (!is_free) continue;
    s.chains = {pq.chain, tq.chain, qr.chain, rp.chain};
    const std::uint64_t clear = counts.clear;
    const bool is_hit = sweep_face(snapshot, path, s.q, s.r, {}, {}, counts).contact.has_value();
    if (!is_hit && (counts.clear == clear) == near_walls) result.push_back(s);
  }
  return result;
}

void sweep_faces(benchmark::State& state, const Snapshot<3>& snapshot, bool near_walls) {
  const std::vector<Swept> faces =
      swept_faces(snapshot, static_cast<double>(state.range(0)) / 10, near_walls);
  Face_counts counts;
  std::size_t turn = 0, blocked = 0;
  for (auto _ : state) {
    turn = 1 - turn;
    for (const Swept& s : faces) {
      const Face_chains chains{{&s.chains[turn]}, {&s.chains[2]}, {&s.chains[3]}};
      blocked += sweep_face(snapshot, s.ways[turn], s.q, s.r, {}, chains, counts).contact.has_value();
    }
  }
  if (blocked != 0) state.SkipWithError("a face met a wall");
  const auto n = static_cast<double>(counts.faces);
  state.counters["time_per_face"] =
      benchmark::Counter(n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["cells"] = static_cast<double>(counts.flooded_cells) / n;
  state.counters["walls"] = static_cast<double>(counts.walls) / n;
  state.counters["signs"] = static_cast<double>(counts.walk.predicates.orientations) / n;
}

void face_in_free_space(benchmark::State& s) { sweep_faces(s, grid(), false); }
void face_near_walls(benchmark::State& s) { sweep_faces(s, grid_with_walls(), true); }

BENCHMARK(face_in_free_space)->Apply(lengths);
BENCHMARK(face_near_walls)->Apply(lengths);

}  // namespace
