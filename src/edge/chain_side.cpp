// SPDX-License-Identifier: LGPL-3.0-or-later
#include "chain_side.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

std::optional<Span> span_in(const Snapshot<3>& snapshot, const Rational_segment<3>& segment, Half_facet f) {
  return segment.in_facet(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f));
}

/// The cell in which the chain passes a point of the segment.
Cell cell_at(const Snapshot<3>& snapshot, const Rational_segment<3>& segment, Cell start, const Chain& chain,
             const Rational& t) {
  Cell cell = start;
  for (const Half_facet f : chain) {
    const std::optional<Span> met = span_in(snapshot, segment, f);
    if (met && t < met->low) break;
    cell = snapshot.neighbor(f);
  }
  return cell;
}

}  // namespace

std::vector<Cell> linked_cells(const Snapshot<3>& snapshot, const Rational_segment<3>& segment, Cell start,
                               const Chain& chain, const Rational& t) {
  std::vector<Cell> found{cell_at(snapshot, segment, start, chain, t)};
  for (std::size_t head = 0; head < found.size(); ++head) {
    const Cell c = found[head];
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<3>::half_facet(c, i);
      if (snapshot.is_impassable(f)) continue;
      const Cell next = snapshot.neighbor(f);
      if (std::find(found.begin(), found.end(), next) != found.end()) continue;
      const std::optional<Span> met = span_in(snapshot, segment, f);
      if (met && met->low <= t && t <= met->high) found.push_back(next);
    }
  }
  return found;
}

std::optional<Half_facet> passed_side(const Snapshot<3>& snapshot, const Rational_segment<3>& segment,
                                      Cell start, const Chain& chain, Half_facet wall) {
  const std::optional<Span> met = span_in(snapshot, segment, wall);
  if (!met) return {};
  const Rational t = (met->low + met->high) / 2;
  const std::vector<Cell> cells = linked_cells(snapshot, segment, start, chain, t);
  const auto is_linked = [&](Half_facet f) {
    return f != Half_facet::none && std::find(cells.begin(), cells.end(), snapshot.cell_of(f)) != cells.end();
  };
  const Half_facet other = snapshot.opposite(wall);
  if (is_linked(wall) == is_linked(other)) return {};
  return is_linked(wall) ? wall : other;
}

}  // namespace cellwalk::detail
