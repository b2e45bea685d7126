// SPDX-License-Identifier: LGPL-3.0-or-later
#include "relink.h"

#include <algorithm>
#include <set>
#include <utility>

#include "equal_chains.h"
#include "link.h"
#include "may_meet.h"

namespace cellwalk::detail {
namespace {

/// True if a facet of a cell does.
template <int D>
bool holds_triangle(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell c) {
  const Cell_view<D> cell = snapshot.view(c);
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (line.holds_triangle(cell, i)) return true;
  return false;
}

template <int D>
class Relinking {
 public:
  Relinking(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start, const Particle<D>& q,
            const Chain& chain)
      : snapshot_(snapshot),
        line_(line),
        start_(start),
        q_(q),
        chain_(chain),
        now_(at(line.time().value())),
        pieces_(pieces_of<D>(snapshot, now_, start, {chain.data(), chain.size()}, 1)) {}

  std::optional<Chain> run() {
    find_cells();
    if (!lies_in_plane()) return {};
    const Rational_segment<D> after = at(middle(line_.time().value(), next_root().value()));
    if (!from(after, start_, 0)) return {};
    return found_;
  }

 private:
  Rational_segment<D> at(const Fraction& time) const { return {line_.triangle(), time}; }

  /// All cells linked with the chain somewhere on the edge.
  void find_cells() {
    cells_.push_back(start_);
    for (std::size_t head = 0; head < cells_.size(); ++head) {
      const Cell_view<D> cell = snapshot_.view(cells_[head]);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(cells_[head], i);
        if (snapshot_.is_impassable(f)) continue;
        const Cell next = snapshot_.neighbor(f);
        if (std::find(cells_.begin(), cells_.end(), next) == cells_.end() && now_.in_facet(cell, i))
          cells_.push_back(next);
      }
    }
  }

  bool lies_in_plane() const {
    return std::any_of(cells_.begin(), cells_.end(),
                       [&](Cell c) { return holds_triangle(snapshot_, line_, c); });
  }

  /// Until then, the edge passes the facets of these cells in the same way.
  Moment<D> next_root() const {
    Moment<D> end(1.0);
    const auto note = [&](const Moment<D>& root) {
      if (root < end) end = root;
    };
    for (const Cell c : cells_) {
      const Cell_view<D> cell = snapshot_.view(c);
      for (std::size_t i = 0; i < cell.facet_count(); ++i) line_.for_all_roots(cell, i, note);
    }
    return end;
  }

  /// Goes on from a cell in which the edge is at t; true once at q. Ways to the same place are as good as each other, since
  /// all are equal to the chain.
  bool from(const Rational_segment<D>& after, Cell c, const Fraction& t) {
    if (parts() || !seen_.emplace(c, t).second) return false;
    if (arrive(c)) return true;
    const Cell_view<D> cell = snapshot_.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot_.is_impassable(f)) continue;
      const std::optional<Span> met = after.in_facet(cell, i);
      if (!met || met->high < t) continue;
      found_.push_back(f);
      if (from(after, snapshot_.neighbor(f), std::max<Fraction>(t, met->low))) return true;
      found_.pop_back();
    }
    return false;
  }

  /// True if what is found so far is not equal to the chain up to where its last cell begins.
  bool parts() const {
    auto pieces = pieces_of<D>(snapshot_, now_, start_, {found_.data(), found_.size()}, 1);
    pieces.pop_back();
    return !pieces.empty() && parting_of(snapshot_, now_, pieces_, pieces);
  }

  bool arrive(Cell c) {
    const Cell_view<D> cell = snapshot_.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i)
      if (side<Exact>(cell, i, q_.position, line_.counts()) > 0) return false;
    const std::size_t before = found_.size();
    Half_facet wall = append_link(snapshot_, found_, c, q_.cell, q_.position, line_.counts());
    if (wall == Half_facet::none && are_equal(snapshot_, now_, start_, chain_, found_, wall)) return true;
    found_.resize(before);
    return false;
  }

  const Snapshot<D>& snapshot_;
  const Moving_line<D>& line_;
  const Cell start_;
  const Particle<D>& q_;
  const Chain& chain_;
  const Rational_segment<D> now_;
  const std::vector<Piece> pieces_;  ///< of the chain
  std::vector<Cell> cells_;
  std::set<std::pair<Cell, Fraction>> seen_;
  Chain found_;
};

/// False proves that no facet of cells linked with the edge holds the triangle.
template <int D>
bool may_lie_in_plane(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start) {
  Flooded cells{start};
  for (std::size_t head = 0; head < cells.size(); ++head) {
    const Cell c = cells[head];
    if (holds_triangle(snapshot, line, c)) return true;
    const Cell_view<D> cell = snapshot.view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      if (snapshot.is_impassable(f)) continue;
      const Cell next = snapshot.neighbor(f);
      if (std::find(cells.begin(), cells.end(), next) == cells.end() &&
          may_be_near(cell, i, line.triangle(), line.counts()))
        cells.push_back(next);
    }
  }
  return false;
}

}  // namespace

template <int D>
std::optional<Chain> relink(const Snapshot<D>& snapshot, const Moving_line<D>& line, Cell start,
                            const Particle<D>& q, const Chain& chain) {
  if (!may_lie_in_plane(snapshot, line, start)) return {};
  return Relinking<D>(snapshot, line, start, q, chain).run();
}

template std::optional<Chain> relink<2>(const Snapshot<2>&, const Moving_line<2>&, Cell, const Particle<2>&,
                                        const Chain&);
template std::optional<Chain> relink<3>(const Snapshot<3>&, const Moving_line<3>&, Cell, const Particle<3>&,
                                        const Chain&);

}  // namespace cellwalk::detail
