// SPDX-License-Identifier: LGPL-3.0-or-later
#include "events.h"

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

namespace cellwalk::detail {
namespace {

/// A step of p to its next cell: the time, the facets crossed, and that cell.
template <int D>
struct Step {
  Event_time<D> time;
  std::span<const Half_facet> facets;
  Cell next;
};

/// A time after which the edge may go on along several sides of walls in the plane of its triangle.
template <int D>
struct Edge_choice {
  Event_time<D> time;
  std::size_t taken = 0;        ///< in the order of preference
  std::vector<Chain> chains{};  ///< on these sides, up to one after that taken

  bool has_more() const { return chains.size() > taken + 1; }
};

template <int D>
class Event_sweep {
 public:
  /// \param choices if not null, the sides to take; others taken are appended
  Event_sweep(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
              Walk_counts& counts, std::optional<double> until,
              std::vector<Edge_choice<D>>* choices = nullptr)
      : snapshot_(snapshot),
        triangle_{path.from.position, path.to.position, q.position},
        first_(path.from.cell),
        start_(path.from.cell),
        q_(q),
        counts_(counts),
        choices_(choices) {
    plan(path);
    if (until) limit_ = Event_time<D>(*until);
    if (!path.blocked) return;
    const auto blocked = exit_time<D>(snapshot.view(path.visited.back()), triangle_.a, triangle_.b, counts);
    if (!limit_ || blocked < *limit_) limit_ = blocked;
  }

  Sweep_result<D> run(const Chain& before) {
    Sweep_result<D> result{{}, before};
    Chain& chain = result.chain;
    Event_time<D> time;
    for (auto step = steps_.begin(); !limit_ || time < *limit_;) {
      for (; step != steps_.end() && !(time < step->time); ++step) {
        prepend_crossed_facets(snapshot_, chain, step->facets);
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
        return differ_only_around_one_ridge(snapshot_, line, chain, other) ||
               are_equal(snapshot_, exact_segment(), start_, chain, other, parting);
      };
      Moving_line_walk<D, decltype(accept)> walk(snapshot_, line, q_, accept);
      std::optional<Event_time<D>> next;
      const bool is_found = walk.from(start_);
      // Walls in the plane of the triangle may begin wherever the edge arrives at them; then only a search of
      // all paths determines its side.
      const bool is_doubtful = !is_found || (walk.is_in_plane() && lies_in_wall_plane(line));
      const auto relinked = is_doubtful ? relink_on_side(line, chain) : std::optional<Relinked<D>>();
      if (relinked) {
        chain = relinked->chain;
        if (relinked->end < Event_time<D>(1.0)) next = relinked->end;
      } else if (is_found) {
        chain = walk.chain();
      } else {
        chain.clear();
        const Half_facet wall = walk.wall() != Half_facet::none ? walk.wall() : parting;
        if (wall == Half_facet::none)
          throw Error(Error_code::other,
                      "an edge has no chain any more, and no wall parts it from the one it had: the "
                      "environment is not certified, or the chain was that of another edge");
        result.contact = contact(time.exact(), line, exact_segment(), wall);
        return result;
      }
      if (const auto end = end_of(chain, line); end && (!next || *end < *next)) next = *end;
      if (step != steps_.end() && (!next || step->time < *next)) next = step->time;
      if (!next) break;
      time = *next;
    }
    return result;
  }

  /// True if the edge may have had a choice of sides.
  bool was_relinked() const { return was_relinked_; }

 private:
  std::optional<Relinked<D>> relink_on_side(const Moving_line<D>& line, const Chain& chain) {
    if (!choices_) {
      auto relinked = relink(snapshot_, line, start_, q_, chain);
      was_relinked_ |= relinked.has_value();
      return relinked;
    }
    if (choices_passed_ == choices_->size()) choices_->push_back({line.time()});
    Edge_choice<D>& choice = (*choices_)[choices_passed_++];
    return relink(snapshot_, line, start_, q_, chain, choice.taken, &choice.chains);
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
  Cell start_;        ///< of p
  const Particle<D>& q_;
  Walk_counts& counts_;
  std::vector<Step<D>> steps_;
  std::optional<Event_time<D>> limit_;  ///< events from then on do not matter
  std::optional<bool> in_wall_plane_;
  std::vector<Edge_choice<D>>* choices_;
  std::size_t choices_passed_ = 0;
  bool was_relinked_ = false;
};

/// Sweeps the edge on one combination of sides after the other, in the order of preference, until a result is
/// accepted or most_side_tries were made.
template <int D, class Accept>
void sweep_on_all_sides(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                        const Chain& before, Walk_counts& counts, std::optional<double> until,
                        const Accept& accept) {
  std::vector<Edge_choice<D>> choices;
  for (int tries = 0; tries < most_side_tries; ++tries) {
    const Sweep_result<D> result = Event_sweep<D>(snapshot, path, q, counts, until, &choices).run(before);
    if (accept(result)) return;
    // Sides taken after a contact do not matter.
    const auto is_exhausted = [&](const Edge_choice<D>& choice) {
      return !choice.has_more() || (result.contact && result.contact->time < choice.time.exact());
    };
    while (!choices.empty() && is_exhausted(choices.back())) choices.pop_back();
    if (choices.empty()) return;
    ++choices.back().taken;
  }
}

}  // namespace

template <int D>
Sweep_result<D> follow_events(const Snapshot<D>& snapshot, const Vertex_path<D>& path, const Particle<D>& q,
                              const Chain& before, Walk_counts& counts, std::optional<double> until) {
  if (are_collinear(path.from.position, path.to.position, q.position))
    return collinear_sweep(snapshot, path, q, before, counts, until);
  Event_sweep<D> sweep(snapshot, path, q, counts, until);
  Sweep_result<D> result = sweep.run(before);
  if (!result.contact || !sweep.was_relinked()) return result;
  sweep_on_all_sides(snapshot, path, q, before, counts, until, [&](const Sweep_result<D>& other) {
    if (!other.contact || result.contact->time < other.contact->time) result = other;
    return !other.contact;
  });
  return result;
}

#define CELLWALK_INSTANTIATE(D)                                                                            \
  template Sweep_result<D> follow_events<D>(const Snapshot<D>&, const Vertex_path<D>&, const Particle<D>&, \
                                            const Chain&, Walk_counts&, std::optional<double>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
