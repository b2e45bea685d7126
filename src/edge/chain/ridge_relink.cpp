// SPDX-License-Identifier: LGPL-3.0-or-later
// The signs and bounded times of the ridges of a chain, and the exchange of facets at each event.
#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "ridge.h"
#include "rounded_orientation.h"

namespace cellwalk::detail {
namespace {

/// When an affine function has its root, if its values at 0 and 1 have different signs.
struct Root_bounds {
  Root_bounds(const Signed_size& at_0, const Signed_size& at_1)
      : least(at_0.least / (at_0.least + at_1.most) * (1 - slack)),
        most(at_0.most / (at_0.most + at_1.least) * (1 + slack)) {}

  /// The roundings of these lines are far below it.
  static constexpr double slack = 0x1p-48;
  double least, most;
};

template <int D>
class Ridge_relink {
 public:
  using Event = typename Relink_scratch<D>::Event;
  using Passed_facet = typename Relink_scratch<D>::Passed_facet;

  Ridge_relink(const Snapshot<D>& snapshot, const Moving_edge<D>& edge, Relink_scratch<D>& scratch)
      : snapshot_(snapshot), edge_(edge), all_(scratch) {
    all_.word.clear();
    all_.corners.clear();
    all_.events.clear();
  }

  Relink_answer run() {
    if (!read_chain()) return Relink_answer::open;
    std::size_t next = 0;
    std::optional<Root_bounds> crossing;
    for (std::size_t turns = 0; turns <= most_turns;) {
      // In the plane of a facet an edge without a chain may have a wall.
      if (all_.word.empty() && !edge_.has_inner_end) return Relink_answer::open;
      const bool crosses = next < edge_.crossed.size();
      if (!crossing && (crosses || edge_.wall != Half_facet::none)) {
        crossing = time_of_crossing(crosses ? edge_.crossed[next] : edge_.wall);
        if (!crossing) return Relink_answer::open;
      }
      const Event* event = first_event();
      if (event == nullptr && !crossing) return Relink_answer::free;
      if (crossing && (event == nullptr || crossing->most < least_time_)) {
        if (!crosses) return leads_forwards() ? Relink_answer::free : Relink_answer::open;
        now_ =
            crossing->most;  // it may be less than that of an earlier event, which came before all the same
        if (!cross(edge_.crossed[next++])) return Relink_answer::open;
        crossing.reset();
        continue;
      }
      const double next_least = crossing ? std::min(crossing->least, others_least_) : others_least_;
      if (!(event->most < next_least)) return Relink_answer::open;
      now_ = event->most;
      ++turns;
      const Event turned = *event;
      if (const Relink_answer answer = turn_round({turned.u, turned.v}); answer != Relink_answer::free)
        return answer;
    }
    return Relink_answer::open;
  }

  void write(Chain& chain, std::vector<Facet_corners<D>>& corners) const {
    chain.clear();
    corners.clear();
    for (const Passed_facet& f : all_.word) {
      chain.push_back(f.facet);
      const auto its_corners = corners_of(f);
      corners.insert(corners.end(), its_corners.begin(), its_corners.end());
    }
  }

 private:
  /// More are seldom, and swept as fast.
  static constexpr std::size_t most_turns = 64, most_facets_round = 16;

  bool read_chain() {
    all_.corners.assign(edge_.corners.begin(), edge_.corners.end());
    std::size_t begin = 0;
    for (const Half_facet f : edge_.chain) {
      std::size_t end = begin;
      bool is_passed = true;
      do is_passed &= edge_.to.passes(all_.corners[end]);
      while (all_.corners[end++].continues);
      // Corners that were read from behind may begin with another one than the loop of the facet.
      const auto passed = is_passed ? std::optional(Passed_facet{f, begin, end, 0, 0}) : read(f);
      if (!passed) return false;
      all_.word.push_back(*passed);
      begin = end;
    }
    return true;
  }

  /// A facet with the events of its ridges, which come after all that happened; none if one is not certain.
  std::optional<Passed_facet> read(Half_facet f) {
    const std::size_t corners = all_.corners.size();
    append_corners(snapshot_, f, all_.corners);
    const std::size_t corners_end = all_.corners.size();
    constexpr std::size_t ridges_a_part = 3;
    Passed_facet passed{f, corners, corners_end, all_.events.size(), all_.events.size()};
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(f));
    for (std::size_t part = 0; corners + part < corners_end; ++part) {
      const Facet_corners<D>& some = all_.corners[corners + part];
      for (unsigned open = edge_.to.open_ridges(some); open != 0; open &= open - 1) {
        const std::size_t k = part * ridges_a_part + static_cast<std::size_t>(std::countr_zero(open));
        const Ridge ridge = ridge_of(cell, snapshot_.facet_of(f), k);
        const Signed_size after = turn(cell, ridge, k, edge_.to.from());
        if (after.sign > 0) continue;
        const Signed_size before = turn(cell, ridge, k, edge_.from);
        if (before.sign <= 0 || after.sign == 0) return {};
        const Root_bounds time(before, after);
        if (!(now_ <= time.least)) return {};
        all_.events.push_back(
            {std::min(ridge.u, ridge.v), std::max(ridge.u, ridge.v), time.least, time.most});
      }
    }
    passed.events_end = all_.events.size();
    return passed;
  }

  /// The sign of ridge k of a facet, positive if the line from a point to the other end of the edge passes on
  /// its inner side.
  Signed_size turn(const Cell_view<D>& cell, const Ridge& ridge, std::size_t k, const Point<D>& start) const {
    Signed_size turned = turn_of_line(cell, ridge, k, start, edge_.other);
    if (edge_.is_reversed) turned.sign = -turned.sign;
    return turned;
  }
  /// The same for the line to any point, as facets are seen from the cells before them.
  static Signed_size turn_of_line(const Cell_view<D>& cell, const Ridge& ridge, std::size_t k,
                                  const Point<D>& start, const Point<D>& end) {
    const Point<D>& u = cell.points[ridge.u];
    if constexpr (D == 3) {
      return signed_orientation<D>(start, end, u, cell.points[ridge.v]);
    } else {
      Signed_size turned = signed_orientation<D>(start, end, u);
      if (k == 0) turned.sign = -turned.sign;
      return turned;
    }
  }

  /// Positive if a point lies on the inner side of a facet.
  Signed_size side_of(Half_facet f, const Point<D>& p) const {
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(f));
    const auto seen_from_p = [&](const auto&... corner) { return signed_orientation<D>(p, *corner...); };
    return std::apply(seen_from_p, spanning_corners(cell, snapshot_.facet_of(f)));
  }

  /// True proves that the chain passes no facet backwards, as it may at a vertex: then the signs of its
  /// ridges are not negative before the move. If an edge is free to its end, this follows.
  bool leads_forwards() const {
    return std::ranges::all_of(edge_.chain, [&](Half_facet f) {
      const int side = side_of(f, edge_.other).sign;
      return edge_.is_reversed ? side > 0 : side < 0;
    });
  }

  std::optional<Root_bounds> time_of_crossing(Half_facet f) const {
    const Signed_size before = side_of(f, edge_.from), after = side_of(f, edge_.to.from());
    return before.sign * after.sign < 0 ? std::optional(Root_bounds(before, after)) : std::nullopt;
  }

  /// The vertex crosses a facet: the first one of the chain seen from it, or another one.
  bool cross(Half_facet f) {
    auto& word = all_.word;
    const Half_facet behind = snapshot_.opposite(f);
    const Half_facet undone = edge_.is_reversed ? behind : f;
    if (!word.empty() && (edge_.is_reversed ? word.back() : word.front()).facet == undone) {
      const auto place = edge_.is_reversed ? std::prev(word.end()) : word.begin();
      const bool is_crossed = is_crossed_inside(f);
      word.erase(place);
      return is_crossed;
    }
    const auto passed = read(edge_.is_reversed ? f : behind);
    if (!passed || !is_crossed_inside(f)) return false;
    word.insert(edge_.is_reversed ? word.end() : word.begin(), *passed);
    return true;
  }
  /// True if the vertex crosses the interior of a facet.
  bool is_crossed_inside(Half_facet f) const {
    if (edge_.crosses_inside) return true;
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(f));
    const std::size_t i = snapshot_.facet_of(f), ridges = cell.loop(i).size();
    for (std::size_t k = 0; k < ridges; ++k)
      if (turn_of_line(cell, ridge_of(cell, i, k), k, edge_.from, edge_.to.from()).sign <= 0) return false;
    return true;
  }

  std::span<const Facet_corners<D>> corners_of(const Passed_facet& f) const {
    return std::span(all_.corners).subspan(f.corners, f.corners_end - f.corners);
  }

  std::span<const Event> events_of(const Passed_facet& f) const {
    return std::span(all_.events).subspan(f.events, f.events_end - f.events);
  }

  /// The event that is over first, if there is one; the least times are noted.
  const Event* first_event() {
    const Event* first = nullptr;
    least_time_ = others_least_ = std::numeric_limits<double>::infinity();
    for (const Passed_facet& f : all_.word)
      for (const Event& event : events_of(f)) {
        least_time_ = std::min(least_time_, event.least);
        if (first != nullptr && is_at(event, {first->u, first->v})) continue;
        const Event* later = &event;
        if (first == nullptr || event.most < first->most) std::swap(first, later);
        if (later != nullptr) others_least_ = std::min(others_least_, later->least);
      }
    return first;
  }
  static bool is_at(const Event& event, const Ridge& ridge) {
    return event.u == ridge.u && event.v == ridge.v;
  }

  /// Exchanges the facets at a ridge for those on the other way round it.
  Relink_answer turn_round(const Ridge& ridge) {
    auto& word = all_.word;
    const auto has_ridge = [&](const Passed_facet& f) {
      return std::ranges::any_of(events_of(f), [&](const Event& e) { return is_at(e, ridge); });
    };
    const auto first = std::ranges::find_if(word, has_ridge);
    const auto rest = std::find_if_not(first, word.end(), has_ridge);
    if (std::any_of(rest, word.end(), has_ridge)) return Relink_answer::open;
    auto& exchanged = all_.exchanged;
    exchanged.clear();
    bool is_at_wall = false;
    const bool is_round = go_round(snapshot_, first->facet, ridge,
                                   snapshot_.neighbour(std::prev(rest)->facet), [&](Half_facet f) {
                                     is_at_wall = snapshot_.is_impassable(f);
                                     if (is_at_wall || exchanged.size() == most_facets_round) return false;
                                     const auto passed = read(f);
                                     if (passed) exchanged.push_back(*passed);
                                     return passed.has_value();
                                   });
    if (is_at_wall) {
      if (!leads_forwards()) return Relink_answer::open;
      note_wall(ridge, first->facet, std::prev(rest)->facet);
      return Relink_answer::blocked;
    }
    if (!is_round) return Relink_answer::open;
    const auto place = word.erase(first, rest);
    word.insert(place, exchanged.begin(), exchanged.end());
    return Relink_answer::free;
  }

  /// The first wall round a ridge seen from the vertex, which one of the walls there blocks.
  /// \param first, last the facets at the ridge that the edge passes until then, seen from its first end
  void note_wall(const Ridge& ridge, Half_facet first, Half_facet last) {
    all_.u = ridge.u;
    all_.v = ridge.v;
    const auto until_wall = [&](Half_facet f) {
      all_.wall = f;
      return !snapshot_.is_impassable(f);
    };
    if (edge_.is_reversed)
      go_round(snapshot_, snapshot_.opposite(last), ridge, snapshot_.cell_of(first), until_wall);
    else
      go_round(snapshot_, first, ridge, snapshot_.neighbour(last), until_wall);
  }

  const Snapshot<D>& snapshot_;
  const Moving_edge<D>& edge_;
  Relink_scratch<D>& all_;
  double now_ = 0;                            ///< all that happened did so until then
  double least_time_ = 0, others_least_ = 0;  ///< of all events, and of those at other ridges than the first
};

}  // namespace

template <int D>
Relink_answer relink_at_ridges(const Snapshot<D>& snapshot, const Moving_edge<D>& edge,
                               Relink_scratch<D>& scratch, Chain& chain,
                               std::vector<Facet_corners<D>>& its_corners) {
  Ridge_relink<D> relink(snapshot, edge, scratch);
  const Relink_answer answer = relink.run();
  if (answer == Relink_answer::free) relink.write(chain, its_corners);
  return answer;
}

#define CELLWALK_INSTANTIATE(D)                                                                          \
  template Relink_answer relink_at_ridges(const Snapshot<D>&, const Moving_edge<D>&, Relink_scratch<D>&, \
                                          Chain&, std::vector<Facet_corners<D>>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
