// SPDX-License-Identifier: LGPL-3.0-or-later
#include "equal_chains.h"

#include <algorithm>
#include <vector>

namespace cellwalk::detail {
namespace {

template <int D>
class Comparison {
 public:
  Comparison(const Snapshot<D>& snapshot, const Rational_segment<D>& segment)
      : snapshot_(snapshot), segment_(segment) {}

  bool are_equal(Cell start, const Chain& chain, const Chain& other) const {
    const std::vector<Piece> pieces = cut(start, chain), others = cut(start, other);
    // Both run from 0 to 1: go through them together.
    std::size_t i = 0, j = 0;
    for (;;) {
      const Rational low = std::max<Rational>(pieces[i].low, others[j].low);
      const Rational high = std::min<Rational>(pieces[i].high, others[j].high);
      if (!are_linked(pieces[i].cell, others[j].cell, low, high)) return false;
      const bool is_last = i + 1 == pieces.size(), other_is_last = j + 1 == others.size();
      if (is_last && other_is_last) return true;
      if (!is_last && (other_is_last || pieces[i].high <= others[j].high))
        ++i;
      else
        ++j;
    }
  }

  Half_facet wall() const { return wall_; }

 private:
  /// A part of the segment, and the cell that a chain passes there.
  struct Piece {
    Cell cell;
    Rational low, high;
  };

  std::vector<Piece> cut(Cell start, const Chain& chain) const {
    std::vector<Piece> pieces;
    Cell cell = start;
    Rational last = 0;
    for (const Half_facet f : chain) {
      const std::optional<Span> met = span(f);
      Rational next = last;
      if (met) next = std::min<Rational>(1, std::max<Rational>(last, met->low));
      pieces.push_back({cell, last, next});
      cell = snapshot_.neighbor(f);
      last = next;
    }
    pieces.push_back({cell, last, 1});
    return pieces;
  }

  std::optional<Span> span(Half_facet f) const {
    return segment_.in_facet(snapshot_.view(snapshot_.cell_of(f)), snapshot_.facet_of(f));
  }

  /// True if two cells that hold the closed piece are linked at all its points: at its middle, first; then on both sides of
  /// the part on which the facets found there go on. A single point needs no test: the facets that a chain passes in it link
  /// the cells before and after, which are compared themselves.
  bool are_linked(Cell cell, Cell other, const Rational& low, const Rational& high) const {
    if (cell == other || !(low < high)) return true;
    const Rational middle = (low + high) / 2;
    std::vector<Cell> found{cell};
    Span part{low, high};
    for (std::size_t head = 0; head < found.size() && found[head] != other; ++head) {
      const Cell c = found[head];
      for (std::size_t i = 0; i < snapshot_.facet_count(c); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        const std::optional<Span> met = span(f);
        if (!met || met->low > middle || met->high < middle) continue;
        if (snapshot_.is_impassable(f)) {
          wall_ = f;
          continue;
        }
        const Cell next = snapshot_.neighbor(f);
        if (std::find(found.begin(), found.end(), next) != found.end()) continue;
        found.push_back(next);
        part.low = std::max<Rational>(part.low, met->low);
        part.high = std::min<Rational>(part.high, met->high);
      }
    }
    if (std::find(found.begin(), found.end(), other) == found.end()) return false;
    return are_linked(cell, other, low, part.low) && are_linked(cell, other, part.high, high);
  }

  const Snapshot<D>& snapshot_;
  const Rational_segment<D>& segment_;
  mutable Half_facet wall_ = Half_facet::none;
};

}  // namespace

template <int D>
bool are_equal(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
               const Chain& chain, const Chain& other, Half_facet& wall) {
  if (chain == other) return true;
  const Comparison<D> comparison(snapshot, segment);
  if (comparison.are_equal(start, chain, other)) return true;
  wall = comparison.wall();
  return false;
}

template bool are_equal<2>(const Snapshot<2>&, const Rational_segment<2>&, Cell, const Chain&, const Chain&,
                           Half_facet&);
template bool are_equal<3>(const Snapshot<3>&, const Rational_segment<3>&, Cell, const Chain&, const Chain&,
                           Half_facet&);

}  // namespace cellwalk::detail
