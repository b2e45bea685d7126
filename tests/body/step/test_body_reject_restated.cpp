// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of traces where touching is free, stated once more by the public functions for one particle and
// one edge: in every position, walls in the plane of the motion included.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "body/rejecting.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

/// A body without regions, and without any answer but those of walks and sweeps.
template <int D>
class Restated_body {
 public:
  /// \pre caught up
  Restated_body(const Snapshot<D>& snapshot, const Body<D>& body)
      : snapshot_(snapshot), particles_(body.particles().begin(), body.particles().end()) {
    edges_.assign(body.edges().begin(), body.edges().end());
    for (std::size_t e = 0; e < edges_.size(); ++e) chains_.push_back(body.chain(e));
  }

  const Point<D>& position(std::uint32_t vertex) const { return particles_[vertex].position; }

  Rejected_move<D> move_or_stay(std::uint32_t vertex, const Point<D>& target, Sweep sweep) {
    Tried tried = try_on_sides(vertex, target, sweep, nullptr);
    if (tried.severity() != 0 && tried.had_choice && !tried.answer.is_vertex_blocked) {
      std::optional<Tried> best;
      detail::Sides_taken choices;
      do {
        tried = try_on_sides(vertex, target, sweep, &choices);
        if (!tried.answer.is_vertex_blocked && (!best || tried.severity() < best->severity())) best = tried;
      } while ((!best || best->severity() != 0) && detail::take_next_sides(choices));
      tried = *best;
    }
    if (tried.answer.stays()) return tried.answer;
    particles_[vertex] = tried.to;
    for (const auto& [edge, chain] : tried.chains)
      chains_[edge] = edges_[edge][0] == vertex || chain.empty() ? chain : reversed(snapshot_, chain);
    return tried.answer;
  }

  /// After three segments any chains will do, and along walls there may be several: takes those of the body.
  void take_chains(Body<D> body) {
    Body_counts counts;
    body.refresh(counts);
    body.validate();
    for (std::size_t e = 0; e < edges_.size(); ++e) chains_[e] = body.chain(e);
  }

 private:
  struct Tried {
    Rejected_move<D> answer;
    Particle<D> to;
    std::vector<std::pair<std::size_t, Chain>> chains;
    bool had_choice = false;

    int severity() const { return answer.stays() ? 2 : answer.swept_edges != 0 ? 1 : 0; }
  };

  /// The move on given sides of walls or, without, on those that the vertex prefers.
  Tried try_on_sides(std::uint32_t vertex, const Point<D>& target, Sweep sweep,
                     detail::Sides_taken* choices) {
    Tried tried;
    Rejected_move<D>& answer = tried.answer;
    answer.vertex = vertex;
    const Particle<D> from = particles_[vertex];
    tried.to = from;
    const auto keep = [&](const Contact<D>& wall, Body_feature body, std::size_t feature) {
      answer.contact = wall;
      answer.contact->body = body;
      answer.contact->vertex = vertex;
      answer.contact->feature = static_cast<std::uint32_t>(feature);
    };
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    const auto walked =
        detail::move_on_sides(snapshot_, tried.to, target, counts_.walk, {&visited, &crossed}, choices);
    tried.had_choice = walked.had_choice;
    if (walked.contact) {
      keep(*walked.contact, Body_feature::vertex, vertex);
      answer.is_vertex_blocked = true;
      return tried;
    }
    Sweep_options options;
    options.sweep = sweep;
    std::uint64_t bit = 1;
    for (const auto& [other, edge] : edges_of(vertex)) {
      const Particle<D>& q = particles_[other];
      Chain_result<D> at_end;
      if (sweep == Sweep::three_segments) {
        at_end = find_any_chain(snapshot_, tried.to, q, counts_.walk);
      } else {
        const Vertex_path<D> path{from, tried.to, visited, crossed};
        const Sweep_result<D> swept =
            sweep_edge_along(snapshot_, path, q, seen_from(vertex, edge), options, counts_);
        at_end.chain = swept.chain;
        if (swept.contact) {
          answer.swept_edges |= bit;
          at_end = find_any_chain(snapshot_, tried.to, q, counts_.walk);
        }
      }
      if (at_end.contact) answer.edges |= bit;
      if (at_end.contact && !answer.contact) keep(*at_end.contact, Body_feature::edge, edge);
      tried.chains.emplace_back(edge, at_end.chain);
      bit <<= 1;
    }
    return tried;
  }

  /// The other ends, ascending, and the edges.
  std::vector<std::pair<std::uint32_t, std::size_t>> edges_of(std::uint32_t vertex) const {
    std::vector<std::pair<std::uint32_t, std::size_t>> result;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const std::size_t k : {0, 1})
        if (edges_[e][k] == vertex) result.emplace_back(edges_[e][1 - k], e);
    std::ranges::sort(result);
    return result;
  }
  Chain seen_from(std::uint32_t vertex, std::size_t edge) const {
    const Chain& chain = chains_[edge];
    return edges_[edge][0] == vertex || chain.empty() ? chain : reversed(snapshot_, chain);
  }

  const Snapshot<D>& snapshot_;
  std::vector<Particle<D>> particles_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<Chain> chains_;
  Edge_counts counts_;
};

struct Restated_seen {
  int bodies = 0, steps = 0, moves = 0, by_vertex = 0, by_edges = 0, gone_round = 0, large = 0;
  int on_walls = 0, in_wall_plane = 0, different = 0;
  std::string first;
  Body_counts counts;
};

template <int D>
class Restatement {
 public:
  Restatement(std::uint64_t number, bool generic, Restated_seen& seen)
      : world_(oracle::make_world<D>(number)),
        snapshot_(Snapshot<D>::compile(world_.soup, glue(world_.soup))),
        locator_(snapshot_),
        source_(world_, number),
        generic_(generic),
        seen_(seen) {}

  void run(int bodies, int steps) {
    for (int k = 0; k < bodies; ++k) {
      std::optional<Body<D>> body;
      try {
        body.emplace(snapshot_, locator_, make_body());
      } catch (const Error&) {  // no room there
        continue;
      }
      ++seen_.bodies;
      seen_.large += body->vertex_count() > 8;
      follow(*body, steps);
    }
  }

 private:
  Random& random() { return source_.random(); }

  /// A polygon with spokes, or one along a wall; small, or with corners anywhere.
  Body_soup<D> make_body() {
    Body_soup<D> soup;
    kind_ = source_.kind(generic_);
    const Point<D> first = source_.start(kind_);
    const auto vertices = static_cast<std::uint32_t>(1 + random().below(random().below(3) == 0 ? 12 : 4));
    const bool is_small = random().below(2) == 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const Point<D> x = v == 0 ? first : source_.target(kind_, first, first);
      soup.points.push_back(v == 0 || !is_small ? x : first + 0.125 * (x - first));
    }
    for (std::uint32_t u = 0; u < vertices; ++u)
      for (std::uint32_t v = u + 1; v < vertices; ++v)
        if (u == 0 || v == u + 1) soup.edges.push_back({u, v});
    return soup;
  }

  bool is_along_walls() const {
    return kind_ == oracle::Motion_kind::in_wall_plane || kind_ == oracle::Motion_kind::along_edge;
  }

  Point<D> target(const Point<D>& x) {
    oracle::Motion_kind kind = kind_;
    while (!is_along_walls() || random().below(4) == 0) {
      kind = source_.kind(generic_);
      if (kind != oracle::Motion_kind::in_wall_plane && kind != oracle::Motion_kind::along_edge) break;
    }
    const Point<D> to = source_.target(kind, x, x);
    return random().below(2) == 0 ? to : x + 0.125 * (to - x);
  }

  void follow(Body<D>& body, int steps) {
    Restated_body<D> restated(snapshot_, body);
    for (const Point<D>& x : body.positions()) seen_.on_walls += locator_.locate(x).sides.size() > 1;
    seen_.in_wall_plane += is_along_walls();
    for (int step = 0; step < steps; ++step) {
      ++seen_.steps;
      std::vector<Point<D>> to(body.positions().begin(), body.positions().end());
      for (Point<D>& x : to)
        if (random().below(3) > 0) x = target(x);
      const Sweep sweep = random().below(2) == 0 ? Sweep::three_segments : Sweep::triangle;
      // With a region, a vertex on a border between cells may be registered in another one: see Body_options.
      const bool clearance = generic_ && random().below(2) == 0;
      const auto blocked =
          reject<D>(body, to, rejecting(sweep, Touch::pass, clearance), seen_.counts).blocked;
      auto given = blocked.begin();
      for (std::uint32_t v = 0; v < to.size(); ++v) {
        ++seen_.moves;
        const Rejected_move<D> truth = restated.move_or_stay(v, to[v], sweep);
        const bool is_met = truth.stays() || truth.swept_edges != 0;
        const bool is_given = given != blocked.end() && given->vertex == v;
        if (is_met != is_given || (is_met && !are_alike(*given, truth)) ||
            body.positions()[v] != restated.position(v)) {
          ++seen_.different;
          if (seen_.first.empty())
            seen_.first = world_.name + ", step " + std::to_string(step) + ", vertex " + std::to_string(v) +
                          ", motion " + std::to_string(static_cast<int>(kind_));
          return;
        }
        given += is_given;
        seen_.by_vertex += truth.is_vertex_blocked;
        seen_.by_edges += truth.edges != 0;
        seen_.gone_round += (truth.swept_edges & ~truth.edges) != 0;
      }
      if (sweep == Sweep::three_segments) {
        ASSERT_NO_THROW(restated.take_chains(body));
      }
      if (random().below(4) > 0) continue;
      body.refresh(seen_.counts);
      ASSERT_NO_THROW(body.validate()) << world_.name << ", step " << step;
    }
  }

  static bool are_alike(const Rejected_move<D>& x, const Rejected_move<D>& y) {
    if (x.is_vertex_blocked != y.is_vertex_blocked || x.edges != y.edges || x.swept_edges != y.swept_edges ||
        x.contact.has_value() != y.contact.has_value())
      return false;
    return !x.contact || (x.contact->facet == y.contact->facet && x.contact->kind == y.contact->kind &&
                          x.contact->exact_time() == y.contact->exact_time() &&
                          x.contact->normal == y.contact->normal && x.contact->body == y.contact->body &&
                          x.contact->vertex == y.contact->vertex && x.contact->feature == y.contact->feature);
  }

  const oracle::World<D> world_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  oracle::Motion_source<D> source_;
  const bool generic_;
  oracle::Motion_kind kind_{};
  Restated_seen& seen_;
};

template <int D>
void test_restated() {
  const std::size_t worlds = oracle::scaled_count(4 * oracle::world_kinds);
  constexpr std::uint64_t first_world = 5'000'000 * oracle::world_kinds;  // that no other test has
  for (const bool generic : {true, false}) {
    Restated_seen seen;
    for (std::uint64_t number = 0; number < worlds; ++number)
      Restatement<D>(first_world + number, generic, seen).run(16, 10);
    std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.bodies << " bodies ("
              << seen.large << " of more than 8 vertices, " << seen.in_wall_plane << " along walls), "
              << seen.on_walls << " vertices on walls with several sides, " << seen.steps << " steps, "
              << seen.moves << " moves, " << seen.counts.in_region << " in regions, " << seen.by_vertex
              << " blocked, " << seen.by_edges << " by edges, " << seen.gone_round
              << " gone round; different " << seen.different << "\n";
    EXPECT_EQ(seen.different, 0) << seen.first;
    if (worlds < 4 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.bodies, 200);
    EXPECT_GT(seen.large, 10);
    EXPECT_GT(seen.by_vertex, 1000);
    EXPECT_GT(seen.by_edges, 150);
    EXPECT_GT(seen.gone_round, generic ? 4 : 15);
    if (generic) {
      EXPECT_GT(seen.counts.in_region, 2000u);
    } else {
      EXPECT_GT(seen.on_walls, 150);
      EXPECT_GT(seen.in_wall_plane, 50);
    }
  }
}

TEST(BodyReject, AsWalksAndSweepsSay2) { test_restated<2>(); }
TEST(BodyReject, AsWalksAndSweepsSay3) { test_restated<3>(); }

}  // namespace
}  // namespace cellwalk::test
