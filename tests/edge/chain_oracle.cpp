// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/chain_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace cellwalk::oracle {
namespace {

/// A cut with the classes of its points and pieces.
struct Linked_cut {
  Cut cut;
  std::vector<std::vector<int>> at, along;  ///< at each point; along each piece

  explicit Linked_cut(Cut c) : cut(std::move(c)) {
    for (int i = 0; i <= cut.pieces(); ++i) at.push_back(cut.classes(i, i));
    for (int i = 0; i < cut.pieces(); ++i) along.push_back(cut.classes(i, i + 1));
  }

  std::size_t pieces() const { return along.size(); }
};

/// Some of these classes are not the same: there is free space on several sides.
bool parts(const std::vector<std::vector<int>>& classes) {
  return std::any_of(classes.begin(), classes.end(), [](const std::vector<int>& here) {
    int first = -1;
    return std::any_of(here.begin(), here.end(), [&](int c) {
      if (first < 0) first = c;
      return c >= 0 && c != first;
    });
  });
}

/// Pieces [first, last) of one cut, to which a piece of another shrinks or grows.
struct Range {
  std::size_t first, last;
};

/// Where the pieces of the cut of an open interval end up in the cut at one of its ends.
template <int D>
std::vector<Range> limits(const Linked_cut& open, const Linked_cut& closing, const Share& time) {
  std::vector<std::size_t> numbers;
  for (int i = 0; i <= open.cut.pieces(); ++i) {
    // All points of a segment that is a point are one.
    if (closing.pieces() == 0) {
      numbers.push_back(0);
      continue;
    }
    const Share share = Moving_segment<D>::limit(open.cut, i, time);
    const auto& points = closing.cut.points;
    const auto found = std::lower_bound(points.begin(), points.end(), share);
    if (found == points.end() || !(*found == share)) throw std::logic_error("a cut without a limit");
    numbers.push_back(static_cast<std::size_t>(found - points.begin()));
    if (i > 0 && numbers[numbers.size() - 2] > numbers.back()) throw std::logic_error("cuts changed places");
  }
  std::vector<Range> ranges;
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i) ranges.push_back({numbers[i], numbers[i + 1]});
  return ranges;
}

/// All classes of chains of an open interval that lead from the cell of p to that of q and continue one at
/// its beginning.
class Continuations {
 public:
  Continuations(const Linked_cut& open, const Linked_cut& before, const std::vector<Range>& ranges,
                const Chain_class& state, int p_cell, int q_cell)
      : open_(open), before_(before), ranges_(ranges), state_(state), q_cell_(q_cell) {
    if (open_.pieces() == 0) {
      if (are_linked(0, p_cell, q_cell)) found_.emplace_back();
      return;
    }
    extend(p_cell);
  }

  const std::vector<Chain_class>& found() const { return found_; }

 private:
  bool are_linked(std::size_t point, int cell, int other) const {
    const auto& at = open_.at[point];
    const int c = at[static_cast<std::size_t>(cell)];
    return c >= 0 && c == at[static_cast<std::size_t>(other)];
  }

  /// A cell that holds the piece also holds its limit, and what it is linked with along it, it is there.
  bool continues(std::size_t piece, std::size_t cell) const {
    for (std::size_t k = ranges_[piece].first; k < ranges_[piece].last; ++k)
      if (before_.along[k][cell] != state_[k]) return false;
    return true;
  }

  void extend(int last) {
    const std::size_t piece = chain_.size();
    if (piece == open_.pieces()) {
      if (are_linked(piece, last, q_cell_)) found_.push_back(chain_);
      if (found_.size() > most) throw std::length_error("too many chains to follow");
      return;
    }
    const auto& classes = open_.along[piece];
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const int cell = static_cast<int>(c);
      // Each class by its least cell.
      if (classes[c] != cell || !are_linked(piece, last, cell) || !continues(piece, c)) continue;
      chain_.push_back(cell);
      extend(cell);
      chain_.pop_back();
    }
  }

  static constexpr std::size_t most = 4096;  ///< far above what worlds of tests have: a few
  const Linked_cut& open_;
  const Linked_cut& before_;
  const std::vector<Range>& ranges_;
  const Chain_class& state_;
  const int q_cell_;
  Chain_class chain_;
  std::vector<Chain_class> found_;
};

/// The class at the closing time of an interval of a chain valid on it.
Chain_class closed(const Chain_class& chain, const std::vector<Range>& ranges, const Linked_cut& closing) {
  Chain_class state;
  for (std::size_t piece = 0; piece < chain.size(); ++piece)
    for (std::size_t k = ranges[piece].first; k < ranges[piece].last; ++k)
      state.push_back(closing.along[k][static_cast<std::size_t>(chain[piece])]);
  if (state.size() != closing.pieces() || std::count(state.begin(), state.end(), -1) > 0)
    throw std::logic_error("a chain without a limit");
  return state;
}

/// The class of a chain given by its facets; nothing if the segment does not pass them in order, or they do
/// not lead from the cell of p to that of q.
template <int D>
std::optional<Chain_class> class_of(const Integer_complex<D>& complex, const Moving_segment<D>& segment,
                                    const Linked_cut& cut, std::span<const std::uint32_t> chain,
                                    std::uint32_t p_cell, std::uint32_t q_cell) {
  Chain_class state;
  int point = 0;
  std::uint32_t cell = p_cell;
  const auto pass = [&](int end) {
    const int number = segment.number_of(cell);
    for (; point < end; ++point) {
      const int c =
          number < 0 ? -1 : cut.along[static_cast<std::size_t>(point)][static_cast<std::size_t>(number)];
      if (c < 0) return false;
      state.push_back(c);
    }
    return true;
  };
  for (const std::uint32_t f : chain) {
    const int facet = complex.table.cell[f] == cell && complex.table.passable[f] ? segment.facet_of(f) : -1;
    if (facet < 0) return {};
    const Cut::Stretch& met = cut.cut.facets[static_cast<std::size_t>(facet)].met;
    if (met.first > met.last || met.last < point || !pass(std::max(point, met.first))) return {};
    cell = complex.table.cell[static_cast<std::size_t>(complex.table.opposite[f])];
  }
  if (cell != q_cell || !pass(cut.cut.pieces())) return {};
  return state;
}

/// The way of p: its cells, and when it changes from each to the next, or leaves the last one.
template <int D>
class Timetable {
 public:
  Timetable(const Moving_segment<D>& segment, const Edge_motion<D>& motion) {
    for (const std::uint32_t c : motion.path) {
      const int cell = segment.number_of(c);
      if (cell < 0) throw std::invalid_argument("p is never in its cell");
      cells_.push_back(cell);
    }
    for (std::size_t i = 0; i + 1 < cells_.size(); ++i) {
      const Share since = changes_.empty() ? Share{0, 1} : changes_.back();
      const std::optional<Share> change = segment.first_time_in(motion.passed[i], since);
      if (!change) throw std::invalid_argument("p is never where its cells are linked");
      changes_.push_back(*change);
      const Linked_cut cut(segment.cut(*change));
      const int here = cut.at[0][static_cast<std::size_t>(cells_[i])];
      if (here < 0 || here != cut.at[0][static_cast<std::size_t>(cells_[i + 1])])
        throw std::invalid_argument("the cells of p are not linked where it changes them");
    }
    end_ = segment.exit_time(cells_.back());
    if (!motion.blocked && end_ < Share{1, 1}) throw std::invalid_argument("p does not arrive");
  }

  /// When p leaves the last cell.
  const Share& end() const { return end_; }
  /// The cell of p at a time at which it changes none.
  int cell_at(const Share& time) const {
    std::size_t i = 0;
    while (i + 1 < cells_.size() && changes_[i] < time) ++i;
    return cells_[i];
  }

 private:
  std::vector<int> cells_;
  std::vector<Share> changes_;
  Share end_;
};

}  // namespace

bool Outcomes::may_be_blocked_at(double time) const {
  const Share low = exact_share(time),
              high = exact_share(std::nextafter(time, std::numeric_limits<double>::infinity()));
  return std::any_of(blocks.begin(), blocks.end(), [&](const Share& s) { return !(s < low) && s < high; });
}

template <int D>
Outcomes Chain_oracle<D>::judge(const Edge_motion<D>& motion) const {
  const Moving_segment<D> segment(complex_, motion.a, motion.b, motion.q);
  const Timetable<D> timetable(segment, motion);
  const int q_cell = segment.number_of(motion.q_cell);
  if (q_cell < 0) throw std::invalid_argument("q is not in its cell");
  Outcomes outcomes;
  if (motion.blocked) outcomes.end = timetable.end();
  std::vector<Share> times = segment.critical_times();
  times.erase(std::remove_if(times.begin(), times.end(), [&](const Share& t) { return outcomes.end < t; }),
              times.end());
  outcomes.critical = static_cast<int>(times.size());

  Linked_cut here(segment.cut(times[0]));
  const auto start = class_of(complex_, segment, here, motion.chain, motion.path.front(), motion.q_cell);
  if (!start) throw std::invalid_argument("the chain before is none");
  std::set<Chain_class> states{*start};
  for (std::size_t i = 0; i + 1 < times.size() && !states.empty(); ++i) {
    const Share middle = between(times[i], times[i + 1]);
    const Linked_cut open(segment.cut(middle));
    Linked_cut next(segment.cut(times[i + 1]));
    for (const Linked_cut* cut : {&std::as_const(here), &open, &std::as_const(next)}) {
      outcomes.touches = outcomes.touches || parts(cut->at);
      outcomes.lies_in_wall = outcomes.lies_in_wall || parts(cut->along);
    }
    const auto before = limits<D>(open, here, times[i]), after = limits<D>(open, next, times[i + 1]);
    std::set<Chain_class> next_states;
    for (const Chain_class& state : states) {
      const Continuations continuations(open, here, before, state, timetable.cell_at(middle), q_cell);
      const auto& found = continuations.found();
      if (found.empty() && (outcomes.blocks.empty() || outcomes.blocks.back() < times[i]))
        outcomes.blocks.push_back(times[i]);
      outcomes.choices += found.size() > 1;
      for (const Chain_class& chain : found) next_states.insert(closed(chain, after, next));
    }
    states = std::move(next_states);
    here = std::move(next);
  }
  outcomes.ends = std::move(states);
  return outcomes;
}

template <int D>
bool Chain_oracle<D>::is_end(const Edge_motion<D>& motion, const Outcomes& outcomes,
                             std::span<const std::uint32_t> chain) const {
  const Moving_segment<D> segment(complex_, motion.a, motion.b, motion.q);
  const Linked_cut cut(segment.cut(outcomes.end));
  const auto state = class_of(complex_, segment, cut, chain, motion.path.back(), motion.q_cell);
  return state && outcomes.ends.contains(*state);
}

template <int D>
bool Chain_oracle<D>::are_equal(const Point<D>& p, const Point<D>& q, const Placed_chain& x,
                                const Placed_chain& y) const {
  const Moving_segment<D> segment(complex_, p, p, q);
  const Linked_cut cut(segment.cut({0, 1}));
  const auto one = class_of(complex_, segment, cut, x.facets, x.p_cell, x.q_cell),
             two = class_of(complex_, segment, cut, y.facets, y.p_cell, y.q_cell);
  const auto are_linked = [&](const std::vector<int>& classes, std::uint32_t c, std::uint32_t d) {
    const int i = segment.number_of(c), j = segment.number_of(d);
    if (i < 0 || j < 0) return false;
    const int of_c = classes[static_cast<std::size_t>(i)];
    return of_c >= 0 && of_c == classes[static_cast<std::size_t>(j)];
  };
  return one && two && *one == *two && are_linked(cut.at.front(), x.p_cell, y.p_cell) &&
         are_linked(cut.at.back(), x.q_cell, y.q_cell);
}

template <int D>
bool Chain_oracle<D>::has_chain(const Point<D>& p, const Point<D>& q, std::uint32_t p_cell,
                                std::uint32_t q_cell) const {
  const Moving_segment<D> segment(complex_, p, p, q);
  const Linked_cut cut(segment.cut({0, 1}));
  const auto number = [&](std::uint32_t c) { return static_cast<std::size_t>(segment.number_of(c)); };
  std::set<std::size_t> reached{number(p_cell)};
  // From each point the cells linked there with one reached, and of these those that hold the next piece.
  const auto link = [&](const std::vector<int>& at) {
    std::set<std::size_t> linked;
    for (std::size_t c = 0; c < at.size(); ++c)
      if (at[c] >= 0 &&
          std::any_of(reached.begin(), reached.end(), [&](std::size_t r) { return at[r] == at[c]; }))
        linked.insert(c);
    reached = std::move(linked);
  };
  for (std::size_t piece = 0; piece < cut.pieces(); ++piece) {
    link(cut.at[piece]);
    std::erase_if(reached, [&](std::size_t c) { return cut.along[piece][c] < 0; });
  }
  link(cut.at.back());
  return reached.contains(number(q_cell));
}

template class Chain_oracle<2>;
template class Chain_oracle<3>;

}  // namespace cellwalk::oracle
