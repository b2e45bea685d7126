// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for a path of a segment through cells, in the order of sides that a walk prefers. Theory:
// docs/sweep.md, choices.
#ifndef CELLWALK_EDGE_CHAIN_CHAIN_SEARCH_H
#define CELLWALK_EDGE_CHAIN_CHAIN_SEARCH_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/kernel/next_double.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

/// Searches for a chain of a segment that a rule accepts. Where the segment runs along walls from their rims
/// on, it can continue on several sides: first that of the displaced segment is tried, see displaced_side(),
/// then the others in the order of the rule.
///
/// Rule: is_wrong(chain, end) rejects the beginning of a chain, which leads to the parameter `end`;
/// limit_of(cell, facet, border) is that parameter if the segment passes the border; is_accepted(chain)
/// decides about a whole chain; comes_before(cell, cell) orders the cells of sides that are not preferred. It
/// may have forbids(facet), for facets that are not to be passed although they are no walls, and
/// admits(cell, t, end): whether the piece of the segment from t to end may lie in a cell that holds it.
template <int D, class Rule>
class Chain_search {
 public:
  Chain_search(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, const Particle<D>& q,
               Rule& rule, Walk_counts& counts)
      : snapshot_(snapshot), segment_(segment), q_(q), rule_(rule), counts_(counts) {
    const Point<D> p = segment.at(0).rounded();  // less than an ulp off
    for (int k = 0; k < D; ++k) {
      low_[k] = std::min(next_below(p[k]), q.position[k]);
      high_[k] = std::max(next_above(p[k]), q.position[k]);
    }
  }

  /// True if there is a chain from a cell linked with `start` to that of q.
  /// Cost: exact numbers for all facets of the cells along the segment, once for each parameter at which they
  /// begin and end.
  bool find(Cell start) { return from(start, 0, 0); }

  /// The same, but a place is tried again whichever way led there, so that a rule may reject chains that end
  /// alike. Where several cells hold the next piece on one side of all walls, only the first of them is
  /// tried.
  bool find_by_sides(Cell start) {
    by_sides_ = true;
    return from(start, 0, 0);
  }

  const Chain& chain() const { return chain_; }

 private:
  /// A cell in which the segment may continue.
  struct Place {
    bool holds_more = true, is_displaced = true;
    Fraction end{1};  ///< up to here the segment meets the same facets of the cell
    std::size_t end_facet = 0;
    int end_border = -1;  ///< of that facet, at which it ends; -1 if it ends at q
  };

  /// Continues from a cell that contains the point at t. A cell is tried only once for each t.
  bool from(Cell c, const Fraction& t, const Fraction& limit) {
    if (rule_.is_wrong(chain_, limit) || (!by_sides_ && !seen_.emplace(c, t).second)) return false;
    Link_search<D> links(snapshot_, c);
    const std::vector<Place> places = find_places(links, t);
    const bool is_end = t == Fraction(1);
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < places.size(); ++k)
      if (is_end ? links.cell(k) == q_.cell : places[k].holds_more && admits(links.cell(k), t, places[k]))
        order.push_back(k);
    if (!is_end)
      std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
        if (places[x].is_displaced != places[y].is_displaced) return places[x].is_displaced;
        return !places[x].is_displaced &&
               rule_.comes_before(snapshot_.view(links.cell(x)), snapshot_.view(links.cell(y)));
      });
    if (by_sides_ && !is_end) keep_one_on_each_side(links, t, order);
    for (const std::size_t k : order) {
      const std::size_t before = chain_.size();
      links.append_path(k, chain_);
      if (is_end ? rule_.is_accepted(chain_) : goes_on(links.cell(k), places[k])) return true;
      chain_.resize(before);
    }
    return false;
  }

  bool goes_on(Cell c, const Place& place) {
    const Fraction limit = place.end_border < 0
                               ? Fraction(1)
                               : rule_.limit_of(snapshot_.view(c), place.end_facet, place.end_border);
    return from(c, place.end, limit);
  }

  /// Of cells that are linked all along the next piece, leaves the first one.
  void keep_one_on_each_side(const Link_search<D>& links, const Fraction& t,
                             std::vector<std::size_t>& order) const {
    std::vector<std::size_t> kept;
    std::vector<Cell> covered;
    for (const std::size_t k : order) {
      if (std::ranges::find(covered, links.cell(k)) != covered.end()) continue;
      kept.push_back(k);
      const auto side = linked_cells(snapshot_, links.cell(k), [&](const Cell_view<D>& cell, std::size_t i) {
        const std::optional<Span> met = segment_.in_facet(cell, i);
        return met && met->low <= t && t < met->high;
      });
      covered.insert(covered.end(), side.begin(), side.end());
    }
    order = std::move(kept);
  }

  bool admits(Cell c, const Fraction& t, const Place& place) const {
    if constexpr (requires { rule_.admits(c, t, t); })
      return rule_.admits(c, t, place.end);
    else
      return true;
  }

  bool may_pass(const Link_search<D>& links, std::size_t i) const {
    if constexpr (requires { rule_.forbids(Half_facet::none); })
      return !rule_.forbids(Snapshot<D>::half_facet(links.cell(), i));
    else
      return true;
  }

  /// Finds the cells linked with the start of `links` at the point at t.
  std::vector<Place> find_places(Link_search<D>& links, const Fraction& t) {
    std::vector<Place> places;
    const auto holds = [&](const Cell_view<D>& cell, std::size_t i) {
      if (is_apart(cell, i)) return false;
      const std::optional<Span> met = segment_.in_facet(cell, i);
      if (!met) return false;
      Place& place = places.back();
      for (const auto& [end, border] :
           {std::pair(met->low, met->low_border), {met->high, met->high_border}}) {
        if (!(t < end && end < place.end)) continue;
        place.end = end;
        place.end_facet = i;
        place.end_border = border;
      }
      if (t < met->low || met->high < t) return false;
      const int side_of_q = side<Exact>(cell, i, q_.position, counts_);
      place.holds_more &= side_of_q <= 0;
      place.is_displaced &= side_of_q < 0 || (side_of_q == 0 && displaced_side(cell, i) < 0);
      return may_pass(links, i);
    };
    while (links.next()) {
      places.emplace_back();
      links.expand_all(holds, [](const Cell_view<D>&, std::size_t, Half_facet) {});
    }
    return places;
  }

  /// True if all vertices of a facet have smaller, or all have greater coordinates than the segment on an
  /// axis.
  bool is_apart(const Cell_view<D>& cell, std::size_t i) const {
    const auto loop = cell.loop(i);
    for (int k = 0; k < D; ++k) {
      const auto is_below = [&](std::uint16_t v) { return cell.point(v)[k] < low_[k]; };
      const auto is_above = [&](std::uint16_t v) { return cell.point(v)[k] > high_[k]; };
      if (std::all_of(loop.begin(), loop.end(), is_below) || std::all_of(loop.begin(), loop.end(), is_above))
        return true;
    }
    return false;
  }

  const Snapshot<D>& snapshot_;
  const Rational_segment<D>& segment_;
  const Particle<D>& q_;
  Rule& rule_;
  Walk_counts& counts_;
  Point<D> low_{}, high_{};  ///< of a box that contains the segment
  bool by_sides_ = false;
  std::set<std::pair<Cell, Fraction>> seen_;
  Chain chain_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_CHAIN_CHAIN_SEARCH_H
