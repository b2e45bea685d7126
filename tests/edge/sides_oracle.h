// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle of sides: a vertex that takes edges along is free if on some sides of the walls all of them
// pass, and blocked at the latest time that is reached on any. By brute force over all ways of the vertex;
// each edge on each of them is judged by the oracle of chains.
#ifndef CELLWALK_TESTS_EDGE_SIDES_ORACLE_H
#define CELLWALK_TESTS_EDGE_SIDES_ORACLE_H

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "edge/chain_oracle.h"
#include "oracle/oracle.h"

namespace cellwalk::oracle {

/// A way of a point: its cells, and the facets passed between one and the next.
struct Way {
  std::vector<std::uint32_t> cells;
  std::vector<std::vector<std::uint32_t>> passed;  ///< half-facets
  bool is_blocked = false;
  int end = 0;  ///< the last event
};

/// All ways of a motion from a cell: one for each combination of sides.
class All_ways {
 public:
  template <int D>
  All_ways(const Cell_soup<D>& soup, const Trace& trace, std::uint32_t start) : trace_(trace) {
    for (const Incidence& i : trace.incidences)
      facets_.push_back(soup.cell_begin[trace.visits[static_cast<std::size_t>(i.visit)].cell] + i.facet);
    for (int e = 0; e < trace.last_event(); ++e) {
      at_.push_back(trace.classes_at(e));
      after_.push_back(trace.classes_after(e));
    }
    way_.cells.push_back(start);
    go_on(trace.visit_of(start), 0);
  }

  std::vector<Way> found;

  /// The facets on a path between visits linked at an event.
  std::vector<std::uint32_t> link(int from, int to, int event) const {
    std::map<int, std::vector<std::uint32_t>> paths{{from, {}}};
    std::vector<int> queue{from};
    for (std::size_t head = 0; !paths.contains(to); ++head) {
      const int visit = queue.at(head);
      for (std::size_t k = 0; k < facets_.size(); ++k) {
        const Incidence& i = trace_.incidences[k];
        if (i.visit != visit || !i.passable || event < i.first || i.last < event ||
            paths.contains(i.neighbour))
          continue;
        paths[i.neighbour] = paths[visit];
        paths[i.neighbour].push_back(static_cast<std::uint32_t>(facets_[k]));
        queue.push_back(i.neighbour);
      }
    }
    return paths[to];
  }

 private:
  void go_on(int visit, int event) {
    if (event == trace_.last_event()) return end(event, false);
    const auto &at = at_[static_cast<std::size_t>(event)], &after = after_[static_cast<std::size_t>(event)];
    const auto here = static_cast<std::size_t>(visit);
    std::map<int, int> sides;  // a cell of each class that holds the next piece: this one where it does
    for (std::size_t v = 0; v < after.size(); ++v)
      if (after[v] >= 0 && at[v] == at[here]) sides.emplace(after[v], static_cast<int>(v));
    if (after[here] >= 0) sides[after[here]] = visit;
    if (sides.empty()) return end(event, true);
    for (const auto& [side, next] : sides) {
      const Way before = way_;
      if (next != visit) {
        way_.cells.push_back(trace_.visits[static_cast<std::size_t>(next)].cell);
        way_.passed.push_back(link(visit, next, event));
      }
      go_on(next, event + 1);
      way_ = before;
    }
  }

  void end(int event, bool is_blocked) {
    if (found.size() == most) throw std::length_error("too many ways");
    found.push_back(way_);
    found.back().is_blocked = is_blocked;
    found.back().end = event;
  }

  static constexpr std::size_t most = 4096;
  const Trace& trace_;
  std::vector<std::size_t> facets_;
  std::vector<std::vector<int>> at_, after_;
  Way way_;
};

/// An edge at the vertex before it moves.
template <int D>
struct Edge_at {
  Point<D> q;
  std::uint32_t q_cell = 0;
  std::vector<std::uint32_t> chain;  ///< half-facets, each seen from the side of the vertex
};

/// The truth about a move.
struct Sides_truth {
  int ways = 0, free_ways = 0;
  Share latest{0, 1};  ///< of the times at which the ways are blocked, if none is free

  bool is_free() const { return free_ways > 0; }
  /// True if a contact is at that time, rounded down.
  bool is_time(double time) const {
    Outcomes outcomes;
    outcomes.blocks.push_back(latest);
    return outcomes.may_be_blocked_at(time);
  }
};

/// \pre at least one edge
template <int D>
Sides_truth judge_sides(const Oracle<D>& oracle, const Chain_oracle<D>& chains, const Point<D>& a,
                        const Point<D>& b, std::uint32_t start, const std::vector<Edge_at<D>>& edges) {
  Sides_truth truth;
  const Trace trace = oracle.trace(a, b);
  for (const Way& way : All_ways(oracle.soup(), trace, start).found) {
    ++truth.ways;
    std::optional<Share> blocked;
    const auto note = [&](const Share& time) {
      if (!blocked || time < *blocked) blocked = time;
    };
    for (const Edge_at<D>& edge : edges) {
      const Outcomes outcomes =
          chains.judge({a, b, edge.q, way.cells, way.passed, edge.q_cell, edge.chain, way.is_blocked});
      if (way.is_blocked) note(outcomes.end);
      if (!outcomes.may_be_free()) note(outcomes.blocks.back());
    }
    truth.free_ways += !blocked;
    if (blocked && truth.latest < *blocked) truth.latest = *blocked;
  }
  return truth;
}

/// The truth about a move of an edge whose side is not given: of p, of q, of walls in the line of the edge,
/// and on the way of p, all are tried. Nothing if the edge crosses a wall where it is.
template <int D>
std::optional<Sides_truth> judge_edge(const Oracle<D>& oracle, const Chain_oracle<D>& chains,
                                      const Facet_table& table, const Point<D>& p, const Point<D>& target,
                                      const Point<D>& q) {
  std::optional<Sides_truth> truth;
  const Trace trace = oracle.trace(q, p);
  const std::vector<int> at_q = trace.classes_at(0), at_p = trace.classes_at(trace.last_event());
  // Each class by the visit that has its number.
  const auto stands = [&](const std::vector<int>& classes, std::size_t v) {
    return classes[v] == static_cast<int>(v) && !trace.visits[v].solid;
  };
  for (std::size_t v = 0; v < at_q.size(); ++v) {
    if (!stands(at_q, v)) continue;
    const std::uint32_t q_cell = trace.visits[v].cell;
    const All_ways ways(oracle.soup(), trace, q_cell);
    for (const Way& way : ways.found) {
      const int last = trace.visit_of(way.cells.back());
      if (way.is_blocked) continue;
      for (std::size_t w = 0; w < at_p.size(); ++w) {
        if (!stands(at_p, w) || at_p[static_cast<std::size_t>(last)] != at_p[w]) continue;
        std::vector<std::uint32_t> facets;
        for (const auto& passed : way.passed) facets.insert(facets.end(), passed.begin(), passed.end());
        const auto link = ways.link(last, static_cast<int>(w), trace.last_event());
        facets.insert(facets.end(), link.begin(), link.end());
        std::reverse(facets.begin(), facets.end());
        for (std::uint32_t& f : facets) f = static_cast<std::uint32_t>(table.opposite[f]);
        const Sides_truth found =
            judge_sides<D>(oracle, chains, p, target, trace.visits[w].cell, {{q, q_cell, facets}});
        if (!truth) truth.emplace();
        truth->ways += found.ways;
        truth->free_ways += found.free_ways;
        if (!found.is_free() && truth->latest < found.latest) truth->latest = found.latest;
      }
    }
  }
  return truth;
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_EDGE_SIDES_ORACLE_H
