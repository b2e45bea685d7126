// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reshape/definition_oracle.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "reshape/near_cells.h"

namespace cellwalk::test {
namespace {

/// The edge at a time, cut wherever it enters or leaves a facet.
template <int D>
class Slice {
 public:
  Slice(const Near<D>& near, const Fraction& time) : near_(near), time_(time) {
    std::map<Fraction, std::pair<int, std::size_t>> makers;
    for (std::size_t c = 0; c < near.cells.size(); ++c) {
      const Near_cell<D>& cell = near.cells[c];
      Interval part;
      for (std::size_t k = 0; k <= D; ++k) keep_positive(part, cell.at_p[k](time), cell.at_q[k](time));
      cells_.push_back(part);
      auto& facets = facets_.emplace_back();
      for (std::size_t k = 0; k <= D; ++k) {
        const Fraction at_p = cell.at_p[k](time), at_q = cell.at_q[k](time);
        Interval of_facet = part;
        keep_positive(of_facet, Fraction(-at_p), Fraction(-at_q));
        facets[k] = of_facet;
        if (at_p.sign() * at_q.sign() >= 0 && (at_p.sign() == 0) == (at_q.sign() == 0)) continue;
        const Fraction root = at_p / (at_p - at_q);
        if (!part.is_empty() && part.low <= root && root <= part.high)
          makers.try_emplace(root, static_cast<int>(c), k);
      }
    }
    makers.try_emplace(Fraction(0), -1, 0).first->second.first = -1;
    makers.try_emplace(Fraction(1), -1, 0).first->second.first = -1;
    for (const auto& [point, maker] : makers) {
      points.push_back(point);
      makers_.push_back(maker);
    }
    for (std::size_t k = 0; k < points.size(); ++k) at.push_back(classes(points[k], points[k]));
    for (std::size_t k = 0; k + 1 < points.size(); ++k) along.push_back(classes(points[k], points[k + 1]));
  }

  /// Where a point is at another time.
  Fraction limit(std::size_t k, const Fraction& then) const {
    const auto [c, facet] = makers_[k];
    if (c < 0) return points[k];
    const Near_cell<D>& cell = near_.cells[static_cast<std::size_t>(c)];
    const Fraction at_p = cell.at_p[facet](then), at_q = cell.at_q[facet](then);
    return at_p.sign() == 0 && at_q.sign() == 0 ? points[k] : Fraction(at_p / (at_p - at_q));
  }

  std::size_t number_of(const Fraction& point) const {
    const auto found = std::ranges::lower_bound(points, point);
    if (found == points.end() || *found != point) throw std::logic_error("a cut without a limit");
    return static_cast<std::size_t>(found - points.begin());
  }

  bool holds(int cell, std::size_t facet, const Fraction& low, const Fraction& high) const {
    const Interval& part = facets_[static_cast<std::size_t>(cell)][facet];
    return !part.is_empty() && part.low <= low && high <= part.high;
  }
  const Interval& part_in(int cell, std::size_t facet) const {
    return facets_[static_cast<std::size_t>(cell)][facet];
  }

  std::vector<Fraction> points;
  std::vector<std::vector<int>> at, along;

 private:
  std::vector<int> classes(const Fraction& low, const Fraction& high) const {
    std::vector<int> result(cells_.size(), -1);
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (!cells_[c].is_empty() && cells_[c].low <= low && high <= cells_[c].high)
        result[c] = static_cast<int>(c);
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t k = 0; k <= D; ++k) {
        const int next = near_.cells[c].neighbour[k];
        if (next < 0 || !holds(static_cast<int>(c), k, low, high)) continue;
        const int a = result[c], b = result[static_cast<std::size_t>(next)];
        if (a != b) std::ranges::replace(result, std::max(a, b), std::min(a, b));
      }
    return result;
  }

  const Near<D>& near_;
  const Fraction time_;
  std::vector<Interval> cells_;
  std::vector<std::array<Interval, static_cast<std::size_t>(D) + 1>> facets_;
  std::vector<std::pair<int, std::size_t>> makers_;
};

/// The classes at p, along the pieces, and at q.
using State = std::vector<int>;

template <int D>
std::optional<State> state_of(const Near<D>& near, const Slice<D>& slice, const Registered_edge<D>& edge) {
  State state;
  int cell = near.number_of(edge.p_cell);
  std::size_t at = 0;
  if (cell < 0 || slice.at.front()[static_cast<std::size_t>(cell)] < 0) return {};
  state.push_back(slice.at.front()[static_cast<std::size_t>(cell)]);
  const auto pass = [&](std::size_t end) {
    for (; at < end; ++at) {
      const int c = cell < 0 ? -1 : slice.along[at][static_cast<std::size_t>(cell)];
      if (c < 0) return false;
      state.push_back(c);
    }
    return true;
  };
  for (const Half_facet f : edge.chain) {
    std::size_t k = 0;
    while (cell >= 0 && k <= D && near.cells[static_cast<std::size_t>(cell)].facet[k] != f) ++k;
    if (cell < 0 || k > D) return {};
    const Interval& met = slice.part_in(cell, k);
    if (met.is_empty() || met.high < slice.points[at]) return {};
    if (!pass(std::max(at, slice.number_of(met.low)))) return {};
    cell = near.cells[static_cast<std::size_t>(cell)].neighbour[k];
  }
  if (!pass(slice.along.size()) || cell < 0 || near.cells[static_cast<std::size_t>(cell)].cell != edge.q_cell)
    return {};
  state.push_back(slice.at.back()[static_cast<std::size_t>(cell)]);
  return state;
}

/// All states of an interval that continue one at its beginning.
template <int D>
std::set<State> continued(const Slice<D>& open, const Slice<D>& before,
                          const std::vector<std::size_t>& limits, const State& state) {
  const auto fits = [&](std::size_t piece, std::size_t c) {
    for (std::size_t k = limits[piece]; k < limits[piece + 1]; ++k)
      if (before.along[k][c] != state[k + 1]) return false;
    return true;
  };
  const std::size_t pieces = open.along.size(), cells = open.at.front().size();
  std::set<State> states;
  for (std::size_t c = 0; c < cells; ++c)
    if (open.at.front()[c] == static_cast<int>(c) && before.at.front()[c] == state.front())
      states.insert({static_cast<int>(c)});
  for (std::size_t piece = 0; piece <= pieces; ++piece) {
    std::set<State> longer;
    for (const State& begun : states)
      for (std::size_t c = 0; c < cells; ++c) {
        const std::vector<int>& here = open.at[piece];
        // Any cell of the class before will do: all are linked at the point as well.
        if (here[c] < 0 || here[c] != here[static_cast<std::size_t>(begun.back())]) continue;
        if (piece == pieces) {
          if (here[c] != static_cast<int>(c) || before.at.back()[c] != state.back()) continue;
        } else if (open.along[piece][c] != static_cast<int>(c) || !fits(piece, c)) {
          continue;
        }
        State next = begun;
        next.push_back(static_cast<int>(c));
        longer.insert(std::move(next));
      }
    states = std::move(longer);
    if (states.size() > 4096) throw std::length_error("too many chains to follow");
  }
  return states;
}

template <int D>
State closed(const Slice<D>& closing, const std::vector<std::size_t>& limits, const State& chain) {
  const auto number = [](int c) { return static_cast<std::size_t>(c); };
  State state{closing.at.front()[number(chain.front())]};
  for (std::size_t piece = 0; piece + 1 < limits.size(); ++piece)
    for (std::size_t k = limits[piece]; k < limits[piece + 1]; ++k)
      state.push_back(closing.along[k][number(chain[piece + 1])]);
  state.push_back(closing.at.back()[number(chain.back())]);
  if (std::ranges::count(state, -1) > 0) throw std::logic_error("a chain without a limit");
  return state;
}

template <int D>
std::vector<std::size_t> limits(const Slice<D>& open, const Slice<D>& closing, const Fraction& time) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < open.points.size(); ++k)
    result.push_back(closing.number_of(open.limit(k, time)));
  if (!std::ranges::is_sorted(result)) throw std::logic_error("cuts changed places");
  return result;
}

template <int D>
std::vector<Cell> named(const Near<D>& near, const State& state) {
  std::vector<Cell> cells;
  for (const int c : state) cells.push_back(near.cells[static_cast<std::size_t>(c)].cell);
  return cells;
}

}  // namespace

template <int D>
Fate fate_of(const Wall_motion<D>& motion, const Registered_edge<D>& before) {
  const Near<D> near(motion, before.p, before.q);
  const std::set<Fraction> set = near.times();
  const std::vector<Fraction> times(set.begin(), set.end());
  Fate fate;
  std::optional<Slice<D>> here(std::in_place, near, times[0]);
  const auto start = state_of(near, *here, before);
  if (!start) throw std::logic_error("the chain before is none");
  std::set<State> states{*start};
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const Slice<D> open(near, Fraction((times[k] + times[k + 1]) / 2)), next(near, times[k + 1]);
    const auto from = limits(open, *here, times[k]), to = limits(open, next, times[k + 1]);
    std::set<State> next_states;
    for (const State& state : states) {
      const std::set<State> found = continued(open, *here, from, state);
      fate.has_choice |= found.size() > 1;
      for (const State& chain : found) next_states.insert(closed(next, to, chain));
    }
    if (next_states.empty()) {
      fate.blocked = times[k];
      return fate;
    }
    states = std::move(next_states);
    here.emplace(near, times[k + 1]);
  }
  fate.may_be_free = true;
  for (const State& state : states) fate.ends.insert(named(near, state));
  return fate;
}

template <int D>
bool is_end(const Wall_motion<D>& motion, const Fate& fate, const Registered_edge<D>& after) {
  const Near<D> near(motion, after.p, after.q);
  const auto state = state_of(near, Slice<D>(near, 1), after);
  return state && fate.ends.contains(named(near, *state));
}

template Fate fate_of<2>(const Wall_motion<2>&, const Registered_edge<2>&);
template Fate fate_of<3>(const Wall_motion<3>&, const Registered_edge<3>&);
template bool is_end<2>(const Wall_motion<2>&, const Fate&, const Registered_edge<2>&);
template bool is_end<3>(const Wall_motion<3>&, const Fate&, const Registered_edge<3>&);

}  // namespace cellwalk::test
