// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge_judge.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/environment/gluing.h>

#include <algorithm>
#include <stdexcept>

#include "edge/sweep_judge.h"

namespace cellwalk::corpus {

template <int D>
Edge_judge<D>::Edge_judge(const Cell_soup<D>& soup)
    : soup_(soup),
      snapshot_(Snapshot<D>::compile(soup, glue(soup))),
      locator_(snapshot_),
      oracle_(soup),
      chains_(soup) {}

template <int D>
std::optional<Edge<D>> Edge_judge<D>::place(const Point<D>& p, const Point<D>& q) {
  const auto at_p = locator_.particle_at(p), at_q = locator_.particle_at(q);
  if (!at_p || !at_q) return {};
  const Chain_result<D> found = find_chain(snapshot_, *at_p, *at_q, counts_.walk);
  if (found.contact) return {};
  std::optional<Edge<D>> edge(std::in_place);
  edge->p = *at_p;
  edge->q = *at_q;
  edge->chain = found.chain;
  return edge;
}

template <int D>
std::optional<Judged> Edge_judge<D>::move(Edge<D>& edge, const Move<D>& move) {
  if (move.vertex == 1) {
    Edge<D> turned{edge.q, edge.p, reversed(snapshot_, edge.chain)};
    const auto judged = this->move(turned, {0, move.to});
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
      cellwalk::move(snapshot_, p, move.to, counts_.walk, {&visited, &crossed}).contact.has_value();
  if (blocked != truth.arrivals.empty()) throw std::logic_error("a walk that the oracle contradicts");
  if (blocked) {
    p.position = move.to;
    p.cell = visited.back();
  }
  const Vertex_path<D> path{edge.p, p, visited, crossed, blocked};
  const Sweep_result<D> result = sweep_triangle<D>(snapshot_, path, edge.q, edge.chain, counts_);
  const auto motion = test::motion_of(soup_, snapshot_, path, edge.q, edge.chain);
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

template class Edge_judge<2>;
template class Edge_judge<3>;

}  // namespace cellwalk::corpus
