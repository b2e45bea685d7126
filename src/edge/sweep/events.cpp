// SPDX-License-Identifier: LGPL-3.0-or-later
// The next event of the chain, the chain or contact after it, and the search over sides.
#include "events.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "collinear_sweep.h"
#include "edge/chain/differ_around_ridge.h"
#include "edge/chain/equal_chains.h"
#include "edge/contact/edge_contact.h"
#include "edge/exact/exit_time.h"
#include "edge/exact/rational_segment.h"
#include "moving_line_walk.h"
#include "relink.h"
#include "strict_passage.h"

namespace cellwalk::detail {
namespace {

/// A step of p to its next cell: the time, the facets crossed, and that cell.
template <int D>
struct Step {
  Event_time<D> time;
  std::span<const Half_facet> facets;
  Cell next;
};

/// An edge at a time of its sweep.
template <int D>
struct Edge_state {
  Event_time<D> time;
  std::size_t step;  ///< of p, the next one
  Cell start;        ///< of p
  Chain chain;
};

/// A time after which the edge may go on along several sides of walls in the plane of its triangle.
template <int D>
struct Edge_choice {
  Edge_state<D> state;                ///< just before
  std::vector<Relinked<D>> relinked;  ///< in the order of preference
  std::size_t taken = 0;
};

/// The choices of an edge, for the search of the combinations of sides.
template <int D>
struct Edge_choices {
  std::vector<Edge_choice<D>> open;  ///< those of the last sweep, in order
  /// States from which the edge has gone on, or will, on all sides.
  std::vector<Edge_state<D>> seen;
};

template <int D>
class Event_sweep {
 public:
  /// \param choices if not null, the sweep goes on from the last of them; others that it takes are appended
  Event_sweep(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
              Walk_counts& counts, std::optional<double> until, Event_rule rule,
              Edge_choices<D>* choices = nullptr)
      : snapshot_(snapshot),
        triangle_{path.from.position, path.to.position, q.position},
        first_(path.from.cell),
        q_(q),
        counts_(counts),
        rule_(rule),
        choices_(choices) {
    plan(path);
    if (until) limit_ = Event_time<D>(*until);
    if (!path.blocked) return;
    const auto blocked = exit_time<D>(snapshot.view(path.visited.back()), triangle_.a, triangle_.b, counts);
    if (!limit_ || blocked < *limit_) limit_ = blocked;
  }

  /// None if the edge came where it was before on other sides.
  std::optional<Sweep_result<D>> run(const Chain& before) {
    Edge_state<D> state{{}, 0, first_, before};
    auto& [time, step, start, chain] = state;
    std::optional<Relinked<D>> taken;          // at a choice
    std::optional<Strict_passage<D>> passage;  // of the chain until now
    if (choices_ && !choices_->open.empty()) {
      const Edge_choice<D>& choice = choices_->open.back();
      state = choice.state;
      taken = choice.relinked[choice.taken];
    }
    while (!limit_ || time < *limit_) {
      for (; step != steps_.size() && !(time < steps_[step].time); ++step) {
        prepend_crossed_facets(snapshot_, chain, steps_[step].facets);
        start = steps_[step].next;
      }
      const Moving_line<D> line(triangle_, time, counts_);
      std::optional<Event_time<D>> next;
      const std::optional<Ridge> ridge = passage ? passage->ridge : std::nullopt;
      if (!taken && rule_ == Event_rule::turns) passage = pass_on(line, passage, chain);
      if (passage) {
        if (ridge && snapshot_.is_impassable(chain.back()))
          return Sweep_result<D>{edge_contact(snapshot_, triangle_, chain.back(), *ridge), {}};
        next = passage->end;
      } else {
        if (!taken) {
          auto gone_on = go_on(line, state);
          if (gone_on.was_seen) return {};
          if (gone_on.contact) return Sweep_result<D>{std::move(gone_on.contact), {}};
          taken = std::move(gone_on.relinked);
        }
        chain = std::move(taken->chain);
        if (taken->end < Event_time<D>(1.0)) next = taken->end;
        taken.reset();
        if (!next && rule_ == Event_rule::turns) passage = pass_strictly(snapshot_, line, chain, q_);
        const auto end = passage ? passage->end : end_of(chain, line);
        if (end && (!next || *end < *next)) next = *end;
      }
      if (step != steps_.size() && (!next || !(*next < steps_[step].time))) {
        if (!next || steps_[step].time < *next) next = steps_[step].time;
        if (passage) passage->ridge.reset();  // p goes on at that time
      }
      if (!next) break;
      time = *next;
    }
    return Sweep_result<D>{{}, std::move(chain)};
  }

  /// True if the edge may have had a choice of sides.
  bool was_relinked() const { return was_relinked_; }

 private:
  /// The chain just after a time, or the contact then.
  struct Gone_on {
    std::optional<Relinked<D>> relinked{};
    std::optional<Contact<D>> contact{};
    bool was_seen = false;
  };

  /// The passage of the chain just after a time, round the ridge at which the passage until then ends.
  /// The chain may end with a wall, in which the edge is then stopped. None if this is not all that happens.
  std::optional<Strict_passage<D>> pass_on(const Moving_line<D>& line,
                                           const std::optional<Strict_passage<D>>& before, Chain& chain) {
    if (!before || !before->ridge) return pass_strictly(snapshot_, line, chain, q_);
    if (!turn_round(snapshot_, chain, before->place, *before->ridge, turned_)) return {};
    // At a wall the sweep ends, and the facets before the ridge are passed still.
    const bool is_at_wall = snapshot_.is_impassable(turned_.back());
    auto passage = pass_strictly(snapshot_, line, turned_, q_, is_at_wall ? before->place : 0);
    if (passage) chain.swap(turned_);
    return passage;
  }

  Gone_on go_on(const Moving_line<D>& line, const Edge_state<D>& state) {
    std::optional<Rational_segment<D>> segment;
    const auto exact_segment = [&]() -> const Rational_segment<D>& {
      if (!segment) segment.emplace(triangle_, state.time.value());
      return *segment;
    };
    Half_facet parting = Half_facet::none;
    const auto accept = [&](const Chain& other) {
      return differ_only_around_one_ridge(snapshot_, line, state.chain, other) ||
             are_equal(snapshot_, exact_segment(), state.start, state.chain, other, parting);
    };
    Moving_line_walk<D, decltype(accept)> walk(snapshot_, line, q_, accept);
    const bool is_found = walk.from(state.start);
    // Walls in the plane of the triangle may begin wherever the edge arrives at them; then only a search of
    // all paths determines its side.
    if (!is_found || (walk.is_in_plane() && lies_in_wall_plane(line))) {
      Gone_on relinked = relink_on_side(line, state);
      if (relinked.was_seen || relinked.relinked) return relinked;
    }
    if (is_found) return {Relinked<D>{walk.chain(), Event_time<D>(1.0)}};
    const Half_facet wall = walk.wall() != Half_facet::none ? walk.wall() : parting;
    if (wall == Half_facet::none)
      throw Error(Error_code::other,
                  "an edge has no chain any more, and no wall parts it from the one it had: the "
                  "environment is not certified, or the chain was that of another edge");
    return {{}, contact(state.time.exact(), line, exact_segment(), wall)};
  }

  Gone_on relink_on_side(const Moving_line<D>& line, const Edge_state<D>& state) {
    if (!choices_) {
      auto relinked = relink(snapshot_, line, state.start, q_, state.chain);
      was_relinked_ |= relinked.has_value();
      return {std::move(relinked)};
    }
    const auto is_same = [&](const Edge_state<D>& other) {
      return other.step == state.step && other.start == state.start && other.chain == state.chain &&
             !(other.time < state.time) && !(state.time < other.time);
    };
    if (std::ranges::any_of(choices_->seen, is_same)) return {{}, {}, true};
    auto all = relink_on_all_sides(snapshot_, line, state.start, q_, state.chain, most_side_tries);
    if (all.empty()) return {};
    choices_->seen.push_back(state);
    Edge_choice<D>& choice = choices_->open.emplace_back(Edge_choice<D>{state, std::move(all)});
    return {choice.relinked.front()};
  }

  /// Whether a wall near the triangle lies in its plane; computed once.
  bool lies_in_wall_plane(const Moving_line<D>& line) {
    if (!in_wall_plane_) in_wall_plane_ = has_wall_in_plane(snapshot_, line, first_);
    return *in_wall_plane_;
  }

  void plan(const Vertex_path<D>& path) {
    std::size_t passed = 0;
    for (std::size_t i = 0; i + 1 < path.visited.size(); ++i) {
      const std::size_t first = passed;
      Cell cell = path.visited[i];
      while (cell != path.visited[i + 1]) cell = snapshot_.neighbour(path.crossed[passed++]);
      const auto facets = path.crossed.subspan(first, passed - first);
      steps_.push_back({passing_time(facets), facets, cell});
    }
  }

  /// The first time at which p lies in all of the given facets, which it passes together.
  Event_time<D> passing_time(std::span<const Half_facet> facets) const {
    if (facets.size() == 1) {
      const Half_facet f = facets.front();
      const auto side = moving_side<D>(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f),
                                       triangle_.a, triangle_.b, counts_);
      if (side.has_root()) return Event_time<D>::root_of(side);
      if (side.at_1() != 0) return {};  // a lies in the plane of the facet
    }
    const Rational_segment<D> path_of_p(triangle_.a, triangle_.b);
    Fraction time = 0;
    for (const Half_facet f : facets)
      if (const auto met = path_of_p.in_facet(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f)))
        time = std::max<Fraction>(time, met->low);
    return Event_time<D>(time);
  }

  /// The next time at which one of the signs changes by which the edge passes its chain.
  std::optional<Event_time<D>> end_of(const Chain& chain, const Moving_line<D>& line) const {
    std::optional<Event_time<D>> end;
    const auto note = [&](const Event_time<D>& root) {
      if (!end || root < *end) end = root;
    };
    for (const Half_facet f : chain)
      line.for_all_roots(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f), note);
    return end;
  }

  Contact<D> contact(const Exact_time& time, const Moving_line<D>& line, const Rational_segment<D>& segment,
                     Half_facet wall) const {
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(wall));
    const std::size_t i = snapshot_.facet_of(wall);
    std::optional<Fraction> at;
    if (leaves_through(cell, i, line))
      at = segment.in_plane(cell, i);
    else if (const auto met = segment.in_facet(cell, i))
      at = met->low;
    return edge_contact<D>(snapshot_, time, wall, segment.at(at ? *at : Fraction(1)));
  }

  /// True if the edge, at the time of a line, passes closed facet i of a cell from its inner side in one
  /// point.
  bool leaves_through(const Cell_view<D>& cell, std::size_t i, const Moving_line<D>& line) const {
    if (side<Exact>(cell, i, triangle_.q, counts_) <= 0) return false;
    const Event_time<D>& now = line.time();
    if (now.sign_of(line.side_of(cell, i)) > 0) return false;
    const std::size_t ridges = cell.loop(i).size();
    for (std::size_t k = 0; k < ridges; ++k)
      if (now.sign_of(line.along_of(cell, i, k)) < 0) return false;
    return true;
  }

  const Snapshot<D>& snapshot_;
  const Swept_triangle<D> triangle_;
  const Cell first_;  ///< of p before it moves
  const Particle<D>& q_;
  Walk_counts& counts_;
  std::vector<Step<D>> steps_;
  std::optional<Event_time<D>> limit_;  ///< events from then on do not matter
  std::optional<bool> in_wall_plane_;
  const Event_rule rule_;
  Edge_choices<D>* choices_;
  Chain turned_;
  bool was_relinked_ = false;
};

/// Sweeps the edge on one combination of sides after the other, in the order of preference, until a result is
/// accepted or most_side_tries were made.
template <int D, class Accept>
void sweep_on_all_sides(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                        const Chain& before, Walk_counts& counts, std::optional<double> until,
                        Event_rule rule, const Accept& accept) {
  Edge_choices<D> choices;
  auto& open = choices.open;
  for (int tries = 0; tries < most_side_tries; ++tries) {
    const auto result = Event_sweep<D>(snapshot, path, q, counts, until, rule, &choices).run(before);
    if (result && accept(*result)) return;
    // Sides taken after a contact do not matter.
    const auto is_exhausted = [&](const Edge_choice<D>& choice) {
      return choice.taken + 1 == choice.relinked.size() ||
             (result && result->contact && result->contact->exact_time() < choice.state.time.exact());
    };
    while (!open.empty() && is_exhausted(open.back())) open.pop_back();
    if (open.empty()) return;
    ++open.back().taken;
  }
}

}  // namespace

template <int D>
Sweep_result<D> follow_events(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                              const Chain& before, Walk_counts& counts, std::optional<double> until,
                              Event_rule rule) {
  if (are_collinear(path.from.position, path.to.position, q.position))
    return collinear_sweep(snapshot, path, q, before, counts, until);
  Event_sweep<D> sweep(snapshot, path, q, counts, until, rule);
  Sweep_result<D> result = *sweep.run(before);  // an edge without choices never returns to a state
  if (!result.contact || !sweep.was_relinked()) return result;
  sweep_on_all_sides(snapshot, path, q, before, counts, until, rule, [&](const Sweep_result<D>& other) {
    if (!other.contact || result.contact->exact_time() < other.contact->exact_time()) result = other;
    return !other.contact;
  });
  return result;
}

template <int D>
std::vector<Chain> all_swept_chains(const Snapshot<D>& snapshot, const Vertex_path<D>& path,
                                    const Particle<D>& q, const Chain& before, Walk_counts& counts) {
  std::vector<Chain> chains;
  const Point<D>&a = path.from.position, &b = path.to.position;
  if (are_collinear(a, b, q.position)) {  // the end that moves determines the side
    chains.push_back(collinear_sweep(snapshot, path, q, before, counts, {}).chain);
    return chains;
  }
  const Rational_segment<D> segment(b, q.position);
  sweep_on_all_sides(snapshot, path, q, before, counts, {}, Event_rule::turns,
                     [&](const Sweep_result<D>& result) {
                       Half_facet wall = Half_facet::none;
                       if (!result.contact && std::ranges::none_of(chains, [&](const Chain& other) {
                             return are_equal(snapshot, segment, path.to.cell, other, result.chain, wall);
                           }))
                         chains.push_back(result.chain);
                       return false;
                     });
  return chains;
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template Sweep_result<D> follow_events<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&,  \
                                            const Chain&, Walk_counts&, std::optional<double>, Event_rule); \
  template std::vector<Chain> all_swept_chains<D>(const Snapshot<D>&, const Vertex_path<D>&,                \
                                                  const Particle<D>&, const Chain&, Walk_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
