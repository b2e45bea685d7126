// SPDX-License-Identifier: LGPL-3.0-or-later
#include "events.h"

#include <vector>

#include "edge_contact.h"
#include "equal_chains.h"
#include "exit_time.h"
#include "in_line.h"
#include "moving_walk.h"
#include "plainly_equal.h"
#include "relink.h"

namespace cellwalk::detail {
namespace {

/// p leaves a cell: when, through which facets, and for which cell.
template <int D>
struct Step {
  Moment<D> time;
  std::span<const Half_facet> facets;
  Cell next;
};

template <int D>
class Events {
 public:
  Events(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q, Walk_counts& counts,
         std::optional<double> until)
      : snapshot_(snapshot),
        triangle_{way.from.position, way.to.position, q.position},
        start_(way.from.cell),
        q_(q),
        counts_(counts) {
    plan(way);
    if (until) limit_ = Moment<D>(*until);
    if (!way.blocked) return;
    const auto blocked = exit_time<D>(snapshot.view(way.visited.back()), triangle_.a, triangle_.b, counts);
    if (!limit_ || blocked < *limit_) limit_ = blocked;
  }

  Chain_result<D> run(const Chain& before) {
    Chain_result<D> result{before, {}, {}};
    Chain& chain = result.chain;
    Moment<D> time;
    for (auto step = steps_.begin(); !limit_ || time < *limit_;) {
      for (; step != steps_.end() && !(time < step->time); ++step) {
        walk_start(snapshot_, chain, step->facets);
        start_ = step->next;
      }
      const Moving_line<D> line(triangle_, time, counts_);
      std::optional<Rational_segment<D>> segment;
      const auto exact_segment = [&]() -> const Rational_segment<D>& {
        if (!segment) segment.emplace(triangle_, time.value());
        return *segment;
      };
      Half_facet parting = Half_facet::none;
      const auto accept = [&](const Chain& other) {
        return are_plainly_equal(snapshot_, line, chain, other) ||
               are_equal(snapshot_, exact_segment(), start_, chain, other, parting);
      };
      Moving_walk<D, decltype(accept)> walk(snapshot_, line, q_, accept);
      const std::optional<Chain> next_chain =
          walk.from(start_) ? walk.chain() : relink(snapshot_, line, start_, q_, chain);
      if (!next_chain) {
        chain.clear();
        result.impact = to_time(time.value());
        result.contact = contact(result.impact, line, exact_segment(),
                                 walk.wall() != Half_facet::none ? walk.wall() : parting);
        return result;
      }
      chain = *next_chain;
      std::optional<Moment<D>> next = end_of(chain, line);
      if (step != steps_.end() && (!next || step->time < *next)) next = step->time;
      if (!next) break;
      time = *next;
    }
    return result;
  }

 private:
  void plan(const Way<D>& way) {
    std::size_t passed = 0;
    for (std::size_t i = 0; i + 1 < way.visited.size(); ++i) {
      const std::size_t first = passed;
      Cell cell = way.visited[i];
      while (cell != way.visited[i + 1]) cell = snapshot_.neighbor(way.crossed[passed++]);
      steps_.push_back({exit_time<D>(snapshot_.view(way.visited[i]), triangle_.a, triangle_.b, counts_),
                        way.crossed.subspan(first, passed - first), cell});
    }
  }

  /// The next time at which one of the signs changes that make the edge pass its chain.
  std::optional<Moment<D>> end_of(const Chain& chain, const Moving_line<D>& line) const {
    std::optional<Moment<D>> end;
    const auto note = [&](const Moment<D>& root) {
      if (!end || root < *end) end = root;
    };
    for (const Half_facet f : chain)
      line.for_all_roots(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f), note);
    return end;
  }

  Wall_contact<D> contact(const Exact_time& time, const Moving_line<D>& line,
                          const Rational_segment<D>& segment, Half_facet wall) const {
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(wall));
    const std::size_t i = snapshot_.facet_of(wall);
    std::optional<Fraction> at;
    if (leaves_through(cell, i, line))
      at = segment.in_plane(cell, i);
    else if (const auto met = segment.in_facet(cell, i))
      at = met->low;
    return edge_contact<D>(snapshot_, time, wall, segment.at(at ? *at : Fraction(1)));
  }

  /// True if the edge comes through closed facet i of a cell from its inner side, in one point, at the time of a line.
  bool leaves_through(const Cell_view<D>& cell, std::size_t i, const Moving_line<D>& line) const {
    if (side<Exact>(cell, i, triangle_.q, counts_) <= 0) return false;
    const Moment<D>& now = line.time();
    if (now.sign_of(line.side_of(cell, i)) > 0) return false;
    const std::size_t ridges = cell.loop(i).size();
    for (std::size_t k = 0; k < ridges; ++k)
      if (now.sign_of(line.along_of(cell, i, k)) < 0) return false;
    return true;
  }

  const Snapshot<D>& snapshot_;
  const Swept_triangle<D> triangle_;
  Cell start_;  ///< of p
  const Particle<D>& q_;
  Walk_counts& counts_;
  std::vector<Step<D>> steps_;
  std::optional<Moment<D>> limit_;  ///< no event from then on matters
};

}  // namespace

template <int D>
Chain_result<D> follow_events(const Snapshot<D>& snapshot, const Way<D>& way, const Particle<D>& q,
                              const Chain& before, Walk_counts& counts, std::optional<double> until) {
  if (are_collinear(way.from.position, way.to.position, q.position))
    return sweep_in_line(snapshot, way, q, before, counts, until);
  return Events<D>(snapshot, way, q, counts, until).run(before);
}

#define CELLWALK_INSTANTIATE(D)                                                                    \
  template Chain_result<D> follow_events<D>(const Snapshot<D>&, const Way<D>&, const Particle<D>&, \
                                            const Chain&, Walk_counts&, std::optional<double>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
