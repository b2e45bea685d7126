// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/edge/triangle.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "confirm.h"
#include "equal_chains.h"
#include "in_line.h"
#include "moving_walk.h"
#include "relink.h"

namespace cellwalk {
namespace {

using detail::Moving_line;

/// p leaves a cell: when, through which facets, and for which cell.
struct Step {
  Rational time;
  std::span<const Half_facet> facets;
  Cell next;
};

template <int D>
class Events {
 public:
  Events(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q, Walk_counts& counts)
      : snapshot_(snapshot),
        triangle_{way.from.position, way.to.position, q.position},
        start_(way.from.cell),
        q_(q),
        counts_(counts) {
    plan(way);
    if (way.blocked) limit_ = exit_time(way.visited.back());
  }

  Chain_result<D> run(const Chain& before) {
    Chain chain = before;
    Rational time = 0;
    for (auto step = steps_.begin();;) {
      for (; step != steps_.end() && step->time <= time; ++step) {
        walk_start(snapshot_, chain, step->facets);
        start_ = step->next;
      }
      const Moving_line<D> line(triangle_, time, counts_);
      const detail::Rational_segment<D> segment(moved(time), detail::exact<D>(triangle_.q));
      Half_facet parting = Half_facet::none;
      const auto accept = [&](const Chain& other) {
        return detail::are_equal(snapshot_, segment, start_, chain, other, parting);
      };
      detail::Moving_walk<D, decltype(accept)> walk(snapshot_, line, q_, accept);
      Chain_result<D> result;
      if (limit_ && time >= *limit_) {
        result.chain = chain;
        return result;
      }
      const std::optional<Chain> next_chain =
          walk.from(start_) ? walk.chain() : detail::relink(snapshot_, line, start_, q_, chain);
      if (!next_chain) {
        result.contact = contact(time, segment, walk.wall() != Half_facet::none ? walk.wall() : parting);
        return result;
      }
      chain = *next_chain;
      std::optional<Rational> next = end_of(chain, line);
      if (step != steps_.end() && (!next || step->time < *next)) next = step->time;
      if (!next || (limit_ && *next >= *limit_)) {
        result.chain = chain;
        return result;
      }
      time = *next;
    }
  }

 private:
  void plan(const Way<D>& way) {
    std::size_t passed = 0;
    for (std::size_t i = 0; i + 1 < way.visited.size(); ++i) {
      const std::size_t first = passed;
      Cell cell = way.visited[i];
      while (cell != way.visited[i + 1]) cell = snapshot_.neighbor(way.crossed[passed++]);
      steps_.push_back({exit_time(way.visited[i]), way.crossed.subspan(first, passed - first), cell});
    }
  }

  Rational exit_time(Cell c) const {
    return detail::exit_time(snapshot_.view(c), triangle_.a, triangle_.b, counts_);
  }

  detail::Rational_point<D> moved(const Rational& time) const {
    return detail::Rational_segment<D>(detail::exact<D>(triangle_.a), detail::exact<D>(triangle_.b)).at(time);
  }

  /// The next time at which one of the signs changes that make the edge pass its chain.
  std::optional<Rational> end_of(const Chain& chain, const Moving_line<D>& line) const {
    std::optional<Rational> end;
    const auto note = [&](const auto& function) {
      const auto root = function.root_after(line.time());
      if (root && (!end || *root < *end)) end = root;
    };
    for (const Half_facet f : chain)
      line.for_all_functions(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f), note);
    return end;
  }

  Wall_contact<D> contact(const Rational& time, const detail::Rational_segment<D>& segment,
                          Half_facet wall) const {
    const auto met = segment.in_facet(snapshot_.view(snapshot_.cell_of(wall)), snapshot_.facet_of(wall));
    return detail::edge_contact<D>(snapshot_, time, wall, segment.at(met ? met->low : Rational(1)));
  }

  const Snapshot<D>& snapshot_;
  const Swept_triangle<D> triangle_;
  Cell start_;  ///< of p
  const Particle<D>& q_;
  Walk_counts& counts_;
  std::vector<Step> steps_;
  std::optional<Rational> limit_;  ///< p is blocked then
};

}  // namespace

template <int D>
Chain_result<D> sweep_triangle(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                               const Chain& before, Edge_counts& counts) {
  const Swept_triangle<D> triangle{way.from.position, way.to.position, q.position};
  if (way.blocked) {
    ++counts.edges;
    ++counts.changed;
    Chain_result<D> result{before, {}};
    walk_start(snapshot, result.chain, way.crossed);
    if (are_collinear(triangle.a, triangle.b, triangle.q))
      return detail::sweep_in_line(snapshot, way, q, before, counts);
    if (is_clear(snapshot, way.from.cell, triangle, counts)) return result;
    ++counts.event_sweeps;
    return Events<D>(snapshot, way, q, counts.walk).run(before);
  }
  Chain_result<D> result;
  if (detail::is_confirmed(snapshot, before, way.crossed, way.to, q, result, counts)) return result;
  ++counts.changed;
  if (are_collinear(triangle.a, triangle.b, triangle.q))
    return detail::sweep_in_line(snapshot, way, q, before, counts);
  if (!result.contact && is_clear(snapshot, way.from.cell, triangle, counts)) return result;
  ++counts.event_sweeps;
  return Events<D>(snapshot, way, q, counts.walk).run(before);
}

#define CELLWALK_INSTANTIATE(D)                                                                     \
  template Chain_result<D> sweep_triangle<D>(const Snapshot<D>&, const Way<D>&, const Particle<D>&, \
                                             const Chain&, Edge_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
