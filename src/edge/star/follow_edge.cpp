// SPDX-License-Identifier: LGPL-3.0-or-later
// Classes of equal chains from one interval of time to the next, and the way back through them.
#include <cellwalk/internal/edge/follow_edge.h>
#include <cellwalk/internal/edge/path_within_cells.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <set>
#include <utility>

#include "star_cut.h"

namespace cellwalk::detail {
namespace {

/// More classes than that at once are not followed.
constexpr std::size_t most_classes = 64;

/// A class of equal chains: the class of cells along each piece of a cut.
using Chain_class = std::vector<int>;

/// The end of a piece in a cut at the end of an interval: pieces [first, last) of that.
struct Range {
  std::size_t first, last;
};

template <int D>
struct Cut_at {
  Cut_at(const Still_segment<D>& still, const Fraction& time, Cell start)
      : segment(still, time), cut(segment, start) {}

  Star_segment<D> segment;
  Star_cut<D> cut;
};

/// Where the pieces of a cut in an interval go at its end; fewer if some go to no pieces.
template <int D>
std::optional<std::vector<Range>> limits(const Star_cut<D>& open, const Cut_at<D>& closing) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k <= open.pieces(); ++k) {
    const Fraction at = open.limit(k, closing.segment);
    std::size_t n = 0;
    while (n <= closing.cut.pieces() && closing.cut.point(n) < at) ++n;
    if (n > closing.cut.pieces() || closing.cut.point(n) != at) return {};
    if (!numbers.empty() && n < numbers.back()) return {};
    numbers.push_back(n);
  }
  std::vector<Range> ranges;
  for (std::size_t k = 0; k + 1 < numbers.size(); ++k) ranges.push_back({numbers[k], numbers[k + 1]});
  return ranges;
}

template <int D>
class Edge_search {
 public:
  Edge_search(const Moving_star<D>& star, const Followed_vertex<D>& p, const Followed_vertex<D>& q)
      : star_(star),
        snapshot_(star.snapshot()),
        still_(star, p.before.position, q.before.position),
        p_(p),
        q_(q) {
    still_.clock().add_passings(p.before.position, times_);
    still_.clock().add_passings(q.before.position, times_);
    add_ridges();
    complete_times(times_);
  }

  Followed_edge run(const Chain& before, std::size_t choice) {
    Followed_edge result;
    std::optional<Cut_at<D>> here(std::in_place, still_, times_[0], p_.before.cell);
    std::set<Chain_class> states;
    if (auto start = class_of(here->cut, before)) states.insert(std::move(*start));
    const Fraction end = std::min(p_.until(), q_.until());
    for (std::size_t k = 0; k + 1 < times_.size() && times_[k] < end; ++k) {
      const Fraction middle = time_between(times_[k], times_[k + 1]);
      const Cell first = p_.cell_at(middle), last = q_.cell_at(middle);
      const Cut_at<D> open(still_, middle, first);
      std::optional<Cut_at<D>> next(std::in_place, still_, times_[k + 1], first);
      const auto from = limits(open.cut, *here), to = limits(open.cut, *next);
      if (!from || !to) return result;  // never: points of a cut go to points of a cut
      std::set<Chain_class> next_states;
      for (const Chain_class& state : states) extend(open.cut, here->cut, *from, state, first, last);
      for (const Chain_class& chain : found_)
        if (auto closed = closed_by(next->cut, open.cut, *to, chain)) next_states.insert(std::move(*closed));
      found_.clear();
      if (next_states.empty()) {
        result.collision = collision(*here, times_[k]);
        return result;
      }
      states = std::move(next_states);
      here.emplace(still_, times_[k + 1], first);
    }
    if (end < Fraction(1)) return result;
    // On a side of walls first, and then on others, as for vertices.
    std::vector<std::pair<Order, Chain>> ends;
    for (const Chain_class& state : states)
      if (Chain word; find_word(here->cut, state, word))
        ends.emplace_back(states.size() > 1 ? order_of(here->cut, state) : Order{}, word);
    std::ranges::sort(ends, {}, &std::pair<Order, Chain>::first);
    result.choices = ends.size();
    if (!ends.empty()) result.chain = ends[choice % ends.size()].second;
    return result;
  }

 private:
  /// Adds the times at which the edge passes a ridge that has the vertex.
  void add_ridges() {
    std::set<std::uint32_t> seen;
    for (const Cell c : star_.cells()) {
      if (snapshot_.is_solid(c)) continue;
      const Cell_view<D> cell = snapshot_.view(c);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        if (!has_point(cell, i, star_.vertex())) continue;
        for (const std::uint16_t v : cell.loop(i)) {
          const std::uint32_t u = cell.point_index(v);
          // In the plane the vertex itself, in space its edge to u.
          if ((D == 2) == (u == star_.vertex()) && seen.insert(u).second) add_ridge(cell.point(v), f);
        }
      }
    }
  }

  void add_ridge(const Point<D>& u, Half_facet f) {
    const Point<D>&p = still_.p(), &q = still_.q();
    const auto sign = [&](const Point<D>& v) {
      if constexpr (D == 2)
        return Exact::orientation(star_.counts().predicates, p, q, v);
      else
        return Exact::orientation(star_.counts().predicates, p, q, v, u);
    };
    const auto value = [&](const Point<D>& v) {
      if constexpr (D == 2)
        return Exact_value::orientation(p, q, v);
      else
        return Exact_value::orientation(p, q, v, u);
    };
    if (sign(star_.from()) * sign(star_.to()) >= 0) return;
    const Ring before = value(star_.from()), after = value(star_.to());
    const Fraction root(before, before - after);
    if (std::ranges::find(times_, root) != times_.end()) return;
    if (Star_segment<D>(still_, root).in_facet(f)) times_.push_back(root);
  }

  static bool are_linked(const std::vector<int>& classes, std::size_t c, std::size_t d) {
    return c < classes.size() && d < classes.size() && classes[c] >= 0 && classes[c] == classes[d];
  }

  /// The class of the chain before.
  std::optional<Chain_class> class_of(const Star_cut<D>& cut, const Chain& chain) const {
    Chain_class state;
    std::size_t cell = cut.number_of(p_.before.cell);
    const auto pass = [&](std::size_t end) {
      for (; state.size() < end; state.push_back(cut.along(state.size())[cell]))
        if (cell == cut.cell_count() || cut.along(state.size())[cell] < 0) return false;
      return true;
    };
    for (const Half_facet f : chain) {
      const auto met = cut.met(f);
      if (!met || met->second < state.size() || !pass(std::max(state.size(), met->first))) return {};
      cell = cut.number_of(snapshot_.neighbour(f));
    }
    if (!pass(cut.pieces()) || cut.number_of(q_.before.cell) != cell) return {};
    return state;
  }

  /// Finds the classes of chains of an interval that continue one at its beginning.
  void extend(const Star_cut<D>& open, const Star_cut<D>& before, const std::vector<Range>& ranges,
              const Chain_class& state, Cell first, Cell last) {
    std::vector<std::vector<std::size_t>> fitting(open.pieces());
    for (std::size_t piece = 0; piece < open.pieces(); ++piece)
      for (std::size_t c = 0; c < open.cell_count(); ++c) {
        if (open.along(piece)[c] != static_cast<int>(c)) continue;  // each class by its least cell
        const std::size_t then = before.number_of(open.cell(c));
        bool fits = true;
        for (std::size_t k = ranges[piece].first; k < ranges[piece].last; ++k)
          fits &= then < before.cell_count() && before.along(k)[then] == state[k];
        if (fits) fitting[piece].push_back(c);
      }
    Chain_class chain;
    extend_from(open, fitting, open.number_of(first), open.number_of(last), chain);
  }

  void extend_from(const Star_cut<D>& open, const std::vector<std::vector<std::size_t>>& fitting,
                   std::size_t last, std::size_t goal, Chain_class& chain) {
    if (found_.size() == most_classes) return;
    const std::size_t piece = chain.size();
    if (piece == open.pieces()) {
      if (are_linked(open.at(piece), last, goal)) found_.insert(chain);
      return;
    }
    for (const std::size_t c : fitting[piece]) {
      if (!are_linked(open.at(piece), last, c)) continue;
      chain.push_back(static_cast<int>(c));
      extend_from(open, fitting, c, goal, chain);
      chain.pop_back();
    }
  }

  /// The class at the end of an interval of a chain in it.
  std::optional<Chain_class> closed_by(const Star_cut<D>& closing, const Star_cut<D>& open,
                                       const std::vector<Range>& ranges, const Chain_class& chain) const {
    Chain_class state;
    for (std::size_t piece = 0; piece < chain.size(); ++piece) {
      const std::size_t cell = closing.number_of(open.cell(static_cast<std::size_t>(chain[piece])));
      for (std::size_t k = ranges[piece].first; k < ranges[piece].last; ++k) {
        if (cell == closing.cell_count() || closing.along(k)[cell] < 0) return {};
        state.push_back(closing.along(k)[cell]);
      }
    }
    if (state.size() != closing.pieces()) return {};
    return state;
  }

  /// A word of facets of a class at the end of the move, between the cells of the ends.
  bool find_word(const Star_cut<D>& cut, const Chain_class& state, Chain& chain) const {
    Chain word;
    std::size_t cell = cut.number_of(p_.end);
    for (std::size_t k = 0; k <= cut.pieces(); ++k) {
      std::size_t next = cut.number_of(q_.end);
      if (k < cut.pieces()) {
        // It stays where it is as long as it can.
        if (cell < cut.cell_count() && cut.along(k)[cell] == state[k]) continue;
        next = static_cast<std::size_t>(state[k]);
      }
      if (!are_linked(cut.at(k), cell, next)) return false;
      cut.append_way(cell, next, k, word);
      cell = next;
    }
    for (const Half_facet f : word) append_reduced(snapshot_, chain, f);
    return true;
  }

  /// The key of the order of ends: for each piece whether the displaced edge passes it in other cells than
  /// those of its class, then the least corners of these.
  using Order = std::pair<std::vector<bool>, std::vector<std::vector<Point<D>>>>;

  Order order_of(const Star_cut<D>& cut, const Chain_class& state) const {
    const auto holds = [&](Cell c) {
      const Cell_view<D> cell = snapshot_.view(c);
      for (std::size_t i = 0; i < cell.facet_count(); ++i)
        if (side<Exact>(cell, i, still_.p(), star_.counts()) == 0 &&
            side<Exact>(cell, i, still_.q(), star_.counts()) == 0 && displaced_side(cell, i) > 0)
          return false;
      return true;
    };
    Order order;
    for (std::size_t piece = 0; piece < state.size(); ++piece) {
      bool is_elsewhere = true;
      std::vector<Point<D>> corners;
      for (std::size_t c = 0; c < cut.cell_count(); ++c) {
        if (cut.along(piece)[c] != state[piece]) continue;
        is_elsewhere &= !holds(cut.cell(c));
        take_least(snapshot_.view(cut.cell(c)), corners);
      }
      order.first.push_back(is_elsewhere);
      order.second.push_back(std::move(corners));
    }
    return order;
  }

  /// The collision at a time with the wall at the vertex that meets the edge with the lowest features.
  std::optional<Collision> collision(const Cut_at<D>& here, const Fraction& time) const {
    std::optional<Collision> first;
    for (const auto& [f, span] : here.cut.walls()) {
      if (!star_.has(f)) continue;
      for (const Fraction& t : {span.low, span.high}) {
        std::vector<Ring> weights{t.denominator() - t.numerator(), t.numerator()};
        keep_first(first, collision_at<D>(star_, star_.wall_of(f), time, still_.at(t), std::move(weights)));
      }
    }
    return first;
  }

  const Moving_star<D>& star_;
  const Snapshot<D>& snapshot_;
  Still_segment<D> still_;
  const Followed_vertex<D>&p_, &q_;
  std::vector<Fraction> times_;
  std::set<Chain_class> found_;
};

}  // namespace

template <int D>
Followed_edge follow_edge(const Moving_star<D>& star, const Followed_vertex<D>& p,
                          const Followed_vertex<D>& q, const Chain& before, std::size_t choice) {
  return Edge_search<D>(star, p, q).run(before, choice);
}

template Followed_edge follow_edge(const Moving_star<2>&, const Followed_vertex<2>&,
                                   const Followed_vertex<2>&, const Chain&, std::size_t);
template Followed_edge follow_edge(const Moving_star<3>&, const Followed_vertex<3>&,
                                   const Followed_vertex<3>&, const Chain&, std::size_t);

}  // namespace cellwalk::detail
