// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges whose ends move. The oracle of walks judges the path of the end, that of chains the edge. Cells and
// chains are handed on by the library, as far as the oracles agree with it: if they do not, nothing is made.
#include <cellwalk/environment/gluing.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "edge/sweep_judge.h"
#include "makers.h"
#include "oracle/oracle.h"
#include "touch.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::corpus {
namespace {

template <int D>
struct Edge {
  Particle<D> p, q;
  Chain chain;  ///< from p to q
};

template <int D>
class Sweep_maker final : public Maker<D> {
 public:
  Sweep_maker(const World<D>& world, std::uint64_t seed)
      : world_(world),
        snapshot_(Snapshot<D>::compile(world.soup, glue(world.soup))),
        locator_(snapshot_),
        oracle_(world.soup),
        chains_(world.soup),
        source_world_{"", world.soup, true},
        source_(source_world_, seed) {}

  std::optional<Case<D>> propose() override {
    oracle::Motion_kind kind = source_.kind(source_.random().below(12) == 0);
    Case<D> c;
    const Point<D> p = source_.start(kind);
    const Point<D> q = source_.target(kind, p, p);
    c.points = {p, q};
    if (p == q) return {};
    if (meets_walls<D>(world_, c.points)) {
      const std::optional<std::vector<Point<D>>> side = find_side(c.points);
      if (!side) return {};
      c.side = *side;
    }
    const bool moves_both = source_.random().below(3) == 0;
    for (std::uint32_t v = 0; v < (moves_both ? 2u : 1u); ++v) {
      if (kind != oracle::Motion_kind::in_wall_plane && kind != oracle::Motion_kind::along_edge) do
          kind = source_.kind(false);
        while (kind == oracle::Motion_kind::in_wall_plane || kind == oracle::Motion_kind::along_edge);
      c.moves.push_back({v, source_.target(kind, c.points[v], c.points[v])});
    }
    return c;
  }

  bool judge(Case<D>& c) override {
    std::optional<Edge<D>> edge = start_of(c);
    if (!edge) return false;
    for (std::uint32_t m = 0; m < c.moves.size(); ++m) {
      const std::optional<Judged> judged = judge_move(*edge, c.moves[m]);
      if (!judged) return false;
      for (const Rational& time : judged->times) c.crossings.push_back(meeting(world_, c, m, time));
      c.crossing = judged->crossing;
      if (c.crossing == Crossing::no) continue;
      if (c.crossing == Crossing::either && m + 1 < c.moves.size()) return false;
      break;
    }
    return true;
  }

 private:
  struct Judged {
    Crossing crossing = Crossing::no;
    std::vector<Rational> times;
  };

  /// Where the edge may come from: moved there, one end after the other, it meets no wall off its start.
  std::optional<std::vector<Point<D>>> find_side(const std::vector<Point<D>>& points) {
    constexpr int tries = 12;
    for (int k = 0; k < tries; ++k) {
      const Point<D> aim = source_.start(oracle::Motion_kind::to_lattice);
      const Vector<D> away = (k % 2 == 0 ? 0.125 : 0.03125) * (aim - points[0]);
      const std::vector<Point<D>> side{points[0] + away, points[1] + away};
      if (meets_walls<D>(world_, side)) continue;
      const std::vector<Point<D>> half{side[0], points[1]};
      if (first_touch<D>(world_, points, {0, side[0]}) || first_touch<D>(world_, half, {1, side[1]}))
        continue;
      return side;
    }
    return {};
  }

  /// The edge as it stands, on its side of the walls there. None if it is not in free space.
  std::optional<Edge<D>> start_of(const Case<D>& c) {
    const std::vector<Point<D>>& at = c.side.empty() ? c.points : c.side;
    const auto p = locator_.particle_at(at[0]), q = locator_.particle_at(at[1]);
    if (!p || !q) return {};
    const Chain_result<D> found = find_chain(snapshot_, *p, *q, counts_.walk);
    if (found.contact) return {};
    Edge<D> edge{*p, *q, found.chain};
    if (c.side.empty()) return edge;
    for (const std::uint32_t v : {1u, 0u}) {  // the way of find_side() back
      const auto judged = judge_move(edge, {v, c.points[v]});
      if (!judged || judged->crossing != Crossing::no) return {};
    }
    return edge;
  }

  /// Judges a move, and makes it if it is free. None if the path of the end leaves a choice.
  std::optional<Judged> judge_move(Edge<D>& edge, const Move<D>& move) {
    if (move.vertex == 1) {
      Edge<D> turned{edge.q, edge.p, reversed(snapshot_, edge.chain)};
      const auto judged = judge_move(turned, {0, move.to});
      edge = {turned.q, turned.p, reversed(snapshot_, turned.chain)};
      return judged;
    }
    const oracle::Trace trace = oracle_.trace(edge.p.position, move.to);
    const oracle::Truth truth = oracle::judge(trace, snapshot_.index(edge.p.cell));
    if (truth.choices > 0 || truth.stops.size() > 1) return {};
    Particle<D> p = edge.p;
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    const bool blocked =
        cellwalk::move(snapshot_, p, move.to, counts_.walk, {Walk_strategy::certified, &visited, &crossed})
            .contact.has_value();
    if (blocked != truth.arrivals.empty()) throw std::logic_error("a walk that the oracle contradicts");
    if (blocked) {
      p.position = move.to;
      p.cell = visited.back();
    }
    const Vertex_path<D> path{edge.p, p, visited, crossed, blocked};
    const Sweep_result<D> result = sweep_triangle<D>(snapshot_, path, edge.q, edge.chain, counts_);
    const auto motion = test::motion_of(world_.soup, snapshot_, path, edge.q, edge.chain);
    const oracle::Outcomes outcomes = chains_.judge(motion);
    if (test::fault_of(chains_, motion, outcomes, snapshot_, result) != test::Sweep_fault::none)
      throw std::logic_error("a sweep that the oracle contradicts");
    Judged judged;
    for (const oracle::Share& s : outcomes.blocks) judged.times.push_back(to_rational(s));
    if (blocked && outcomes.may_be_free())
      judged.times.push_back(to_rational(trace.events[static_cast<std::size_t>(truth.stops[0].event)]));
    std::ranges::sort(judged.times);
    judged.times.erase(std::unique(judged.times.begin(), judged.times.end()), judged.times.end());
    judged.crossing = judged.times.empty()                 ? Crossing::no
                      : !blocked && outcomes.may_be_free() ? Crossing::either
                                                           : Crossing::yes;
    if (judged.crossing == Crossing::no) edge = {p, edge.q, result.chain};
    // What has several ends goes on from one of them only.
    if (judged.crossing == Crossing::no && outcomes.choices > 0) return {};
    return judged;
  }

  const World<D>& world_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const oracle::Oracle<D> oracle_;
  const oracle::Chain_oracle<D> chains_;
  const oracle::World<D> source_world_;
  oracle::Motion_source<D> source_;
  Edge_counts counts_;
};

}  // namespace

template <int D>
std::unique_ptr<Maker<D>> sweep_maker(const World<D>& world, std::uint64_t seed) {
  return std::make_unique<Sweep_maker<D>>(world, seed);
}

template std::unique_ptr<Maker<2>> sweep_maker<2>(const World<2>&, std::uint64_t);
template std::unique_ptr<Maker<3>> sweep_maker<3>(const World<3>&, std::uint64_t);

}  // namespace cellwalk::corpus
