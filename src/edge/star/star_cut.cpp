// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells along an edge in order, their classes, and the walls between neighbouring ones.
#include "star_cut.h"

#include <algorithm>

namespace cellwalk::detail {

template <int D>
Star_cut<D>::Star_cut(const Star_segment<D>& segment, Cell start) {
  const Snapshot<D>& snapshot = segment.still().star().snapshot();
  struct Met {
    std::size_t from, to;
    Half_facet facet;
    Span span;
  };
  std::vector<Cell> cells{start};
  std::vector<Span> spans;
  std::vector<Met> met;
  points_ = {{Fraction(0)}, {Fraction(1)}};
  for (std::size_t head = 0; head < cells.size(); ++head) {
    const Cell c = cells[head];
    spans.push_back(segment.in_cell(c).value());
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const std::optional<Span> span = segment.in_facet(f);
      if (!span) continue;
      const Half_facet moving = segment.still().star().has(f) ? f : Half_facet::none;
      points_.push_back({span->low, span->low_border < 0 ? Half_facet::none : moving, span->low_border});
      points_.push_back({span->high, span->high_border < 0 ? Half_facet::none : moving, span->high_border});
      if (snapshot.is_impassable(f)) {
        walls_.emplace_back(f, *span);
        continue;
      }
      const Cell next = snapshot.neighbour(f);
      const auto found = std::ranges::find(cells, next);
      met.push_back({head, static_cast<std::size_t>(found - cells.begin()), f, *span});
      if (found == cells.end()) cells.push_back(next);
    }
  }
  // Of points that coincide, first those that stay.
  std::ranges::stable_sort(points_, [](const Point_of_cut& x, const Point_of_cut& y) {
    const auto order = x.at <=> y.at;
    return order != 0 ? order < 0 : (x.facet == Half_facet::none) > (y.facet == Half_facet::none);
  });
  points_.erase(std::unique(points_.begin(), points_.end(),
                            [](const Point_of_cut& x, const Point_of_cut& y) { return x.at == y.at; }),
                points_.end());
  const auto first_in = [&](const Span& span) {
    return static_cast<std::size_t>(std::ranges::lower_bound(points_, span.low, {}, &Point_of_cut::at) -
                                    points_.begin());
  };
  const auto last_in = [&](const Span& span) {
    return static_cast<std::size_t>(std::ranges::upper_bound(points_, span.high, {}, &Point_of_cut::at) -
                                    points_.begin()) -
           1;
  };
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells_.push_back({cells[c], first_in(spans[c]), last_in(spans[c])});
  for (const Met& m : met) links_.push_back({m.from, m.to, m.facet, first_in(m.span), last_in(m.span)});
  for (std::size_t k = 0; k < points_.size(); ++k) at_.push_back(classes(k, k));
  for (std::size_t k = 0; k < pieces(); ++k) along_.push_back(classes(k, k + 1));
}

template <int D>
Fraction Star_cut<D>::limit(std::size_t k, const Star_segment<D>& then) const {
  const Point_of_cut& point = points_[k];
  return point.facet == Half_facet::none ? point.at : then.at_border(point.facet, point.border, point.at);
}

template <int D>
std::size_t Star_cut<D>::number_of(Cell c) const {
  return static_cast<std::size_t>(std::ranges::find(cells_, c, &Cell_met::cell) - cells_.begin());
}

template <int D>
std::vector<int> Star_cut<D>::classes(std::size_t first, std::size_t last) const {
  std::vector<int> result(cells_.size(), -1);
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].first <= first && last <= cells_[c].last) result[c] = static_cast<int>(c);
  for (const Link& link : links_) {
    if (link.first > first || last > link.last) continue;
    const int from = result[link.from], to = result[link.to];
    if (from != to) std::ranges::replace(result, std::max(from, to), std::min(from, to));
  }
  return result;
}

template <int D>
std::optional<std::pair<std::size_t, std::size_t>> Star_cut<D>::met(Half_facet f) const {
  const auto link = std::ranges::find(links_, f, &Link::facet);
  if (link == links_.end()) return {};
  return std::pair(link->first, link->last);
}

template <int D>
void Star_cut<D>::append_way(std::size_t from, std::size_t to, std::size_t point, Chain& chain) const {
  if (from == to) return;
  std::vector<const Link*> by(cells_.size(), nullptr);
  std::vector<std::size_t> reached{from};
  for (std::size_t head = 0; head < reached.size() && !by[to]; ++head)
    for (const Link& link : links_) {
      if (link.from != reached[head] || link.first > point || point > link.last) continue;
      if (link.to == from || by[link.to]) continue;
      by[link.to] = &link;
      reached.push_back(link.to);
    }
  Chain way;
  for (std::size_t c = to; c != from; c = by[c]->from) way.push_back(by[c]->facet);
  std::ranges::reverse(way);
  chain.insert(chain.end(), way.begin(), way.end());
}

template class Star_cut<2>;
template class Star_cut<3>;

}  // namespace cellwalk::detail
