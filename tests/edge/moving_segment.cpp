// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/moving_segment.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "edge/segment_passings.h"

namespace cellwalk::oracle {
namespace {

template <std::size_t D>
using Vec = std::array<Big, D>;

Big at(const Values& f, const Share& time) {
  return (time.denominator - time.numerator) * f.at_a + time.numerator * f.at_b;
}

struct Span {
  Share low{0, 1}, high{1, 1};
  const Values *low_maker = nullptr, *high_maker = nullptr;
};

/// Cuts off where a function is positive; false if nothing is left.
bool clip(Span& span, const Big& at_0, const Big& at_1, const Values* maker) {
  if (at_0 <= 0 && at_1 <= 0) return true;
  if (at_0 > 0 && at_1 > 0) return false;
  const Share t = root(at_0, at_1);
  if (at_0 > 0 && span.low < t) {
    span.low = t;
    span.low_maker = maker;
  } else if (at_1 > 0 && t < span.high) {
    span.high = t;
    span.high_maker = maker;
  }
  return !(span.high < span.low);
}

/// The sign that a function has all along the triangle, its corners included; 2 if it changes. 0 counts as
/// negative.
int common_sign(const Values& f) {
  const int positive = (f.at_a > 0) + (f.at_b > 0) + (f.at_q > 0);
  return positive == 0 ? -1 : positive == 3 ? 1 : 2;
}

bool clip(Span& span, const std::vector<Values>& functions, const Share& time) {
  return std::all_of(functions.begin(), functions.end(), [&](const Values& f) {
    const int sign = common_sign(f);
    return sign == 2 ? clip(span, at(f, time), time.denominator * f.at_q, &f) : sign < 0;
  });
}

/// The times at which p is where no function is positive.
bool clip_way(Span& span, const std::vector<Values>& functions) {
  return std::all_of(functions.begin(), functions.end(),
                     [&](const Values& f) { return clip(span, f.at_a, f.at_b, &f); });
}

}  // namespace

bool Cut::is_like(const Cut& other) const {
  const auto same = [](const Facet& f, const Facet& g) { return f.met == g.met; };
  return pieces() == other.pieces() && cells == other.cells &&
         std::equal(facets.begin(), facets.end(), other.facets.begin(), other.facets.end(), same);
}

std::vector<int> Cut::classes(int first, int last) const {
  std::vector<int> parent(cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int c) {
    while (parent[c] != c) c = parent[c];
    return c;
  };
  for (const Facet& f : facets) {
    if (!f.met.covers(first, last)) continue;
    const int c = root(f.cells[0]), d = root(f.cells[1]);
    parent[std::max(c, d)] = std::min(c, d);
  }
  std::vector<int> result(cells.size(), -1);
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (cells[c].covers(first, last)) result[c] = root(static_cast<int>(c));
  return result;
}

template <int D>
Moving_segment<D>::Moving_segment(const Integer_complex<D>& complex, const Point<D>& a, const Point<D>& b,
                                  const Point<D>& q)
    : complex_(complex) {
  for (const Point<D>* x : {&a, &b, &q}) extra_shift_ = std::max(extra_shift_, shift_of(*x) - complex.shift);
  a_ = integer(a, complex.shift + extra_shift_);
  b_ = integer(b, complex.shift + extra_shift_);
  q_ = integer(q, complex.shift + extra_shift_);
  const auto is_near = [&](std::size_t c) {
    for (int i = 0; i < D; ++i)
      if (std::max({a[i], b[i], q[i]}) < complex.boxes[c][0][i] ||
          std::min({a[i], b[i], q[i]}) > complex.boxes[c][1][i])
        return false;
    return true;
  };
  const Cell_soup<D>& soup = complex.soup;
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) {
    if (soup.solid[c] || !is_near(c)) continue;
    std::vector<Values> planes;
    bool is_apart = false;
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1] && !is_apart; ++f) {
      const Values v = values(complex.planes[f]);
      is_apart = v.at_a > 0 && v.at_b > 0 && v.at_q > 0;
      planes.push_back(v);
    }
    if (is_apart) continue;
    cells_.push_back(c);
    planes_.push_back(std::move(planes));
  }
  for (std::size_t n = 0; n < cells_.size(); ++n)
    for (std::uint32_t f = soup.cell_begin[cells_[n]]; f < soup.cell_begin[cells_[n] + 1]; ++f) {
      if (!complex.table.passable[f] || complex.table.opposite[f] < f) continue;
      const int other = number_of(complex.table.cell[static_cast<std::size_t>(complex.table.opposite[f])]);
      if (other < 0) continue;  // then the triangle does not meet the facet either
      const Values& plane = planes_[n][f - soup.cell_begin[cells_[n]]];
      Facet facet{f, {static_cast<int>(n), other}, {plane, {-plane.at_a, -plane.at_b, -plane.at_q}}};
      for (const auto& rim : complex.rims[f]) facet.sides.push_back(values(rim));
      facets_.push_back(std::move(facet));
    }
}

template <int D>
Values Moving_segment<D>::values(const Affine<D, Big>& f) const {
  const Big offset = f.offset << extra_shift_;
  return {dot(f.normal, a_) - offset, dot(f.normal, b_) - offset, dot(f.normal, q_) - offset};
}

template <int D>
int Moving_segment<D>::number_of(std::uint32_t cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell);
  return found != cells_.end() && *found == cell ? static_cast<int>(found - cells_.begin()) : -1;
}

template <int D>
int Moving_segment<D>::facet_of(std::uint32_t half_facet) const {
  const std::int64_t opposite = complex_.table.opposite[half_facet];
  for (std::size_t f = 0; f < facets_.size(); ++f)
    if (facets_[f].half_facet == half_facet || facets_[f].half_facet == opposite) return static_cast<int>(f);
  return -1;
}

template <int D>
std::vector<Share> Moving_segment<D>::critical_times() const {
  std::vector<Share> times{{0, 1}, {1, 1}};
  add_passings(times, complex_, cells_, extra_shift_, {a_, b_, q_});
  const auto add_way = [&](const std::vector<Values>& functions) {
    Span span;
    if (!clip_way(span, functions)) return;
    times.push_back(span.low);
    times.push_back(span.high);
  };
  for (const auto& planes : planes_) add_way(planes);
  for (const Facet& f : facets_) add_way(f.sides);
  // p is at q where their distance along each axis is 0; a time at which one of these vanishes will do.
  for (int i = 0; i < D; ++i) add_root(times, a_[i] - q_[i], b_[i] - q_[i]);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

template <int D>
bool Moving_segment<D>::is_point(const Share& time) const {
  for (int i = 0; i < D; ++i)
    if (at({a_[i], b_[i], q_[i]}, time) != time.denominator * q_[i]) return false;
  return true;
}

template <int D>
Cut Moving_segment<D>::cut(const Share& time) const {
  Cut cut;
  const bool point = is_point(time);
  std::vector<Span> cells(cells_.size()), facets(facets_.size());
  std::vector<std::pair<Share, const Values*>> ends{{{0, 1}, nullptr}};
  if (!point) ends.push_back({{1, 1}, nullptr});
  const auto note = [&](const Span& span) {
    if (span.low_maker) ends.push_back({span.low, span.low_maker});
    if (span.high_maker) ends.push_back({span.high, span.high_maker});
  };
  std::vector<char> meets_cell(cells_.size()), meets_facet(facets_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    meets_cell[c] = clip(cells[c], planes_[c], time);
    if (meets_cell[c]) note(cells[c]);
  }
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!meets_cell[static_cast<std::size_t>(facets_[f].cells[0])]) continue;
    meets_facet[f] = clip(facets[f], facets_[f].sides, time);
    if (meets_facet[f]) note(facets[f]);
  }
  // The ends of the segment come first among equals, since they have no maker.
  std::stable_sort(ends.begin(), ends.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  for (const auto& [share, maker] : ends) {
    if (!cut.points.empty() && cut.points.back() == share) continue;
    cut.points.push_back(share);
    cut.makers.push_back(maker);
  }
  const auto number = [&](const Share& t) {
    return static_cast<int>(std::lower_bound(cut.points.begin(), cut.points.end(), t) - cut.points.begin());
  };
  const auto stretch = [&](bool met, const Span& span) {
    if (!met) return Cut::Stretch{};
    return point ? Cut::Stretch{0, 0} : Cut::Stretch{number(span.low), number(span.high)};
  };
  for (std::size_t c = 0; c < cells_.size(); ++c) cut.cells.push_back(stretch(meets_cell[c], cells[c]));
  for (std::size_t f = 0; f < facets_.size(); ++f)
    cut.facets.push_back({facets_[f].cells, stretch(meets_facet[f], facets[f])});
  return cut;
}

template <int D>
Share Moving_segment<D>::limit(const Cut& cut, int point, const Share& time) {
  const Values* maker = cut.makers[static_cast<std::size_t>(point)];
  if (!maker) return cut.points[static_cast<std::size_t>(point)];
  // A function that vanishes at q, but not at p on the open interval, has its root at q until the end.
  if (maker->at_q == 0) return {1, 1};
  return root(at(*maker, time), time.denominator * maker->at_q);
}

template <int D>
Share Moving_segment<D>::exit_time(int cell) const {
  Span span;
  if (!clip_way(span, planes_[static_cast<std::size_t>(cell)]))
    throw std::invalid_argument("p is never in its cell");
  return span.high;
}

template <int D>
std::optional<Share> Moving_segment<D>::first_time_in(const std::vector<std::uint32_t>& half_facets,
                                                      const Share& since) const {
  Share first = since;
  std::vector<Span> spans;
  for (const std::uint32_t f : half_facets) {
    const int facet = facet_of(f);
    Span span;
    if (facet < 0 || !clip_way(span, facets_[static_cast<std::size_t>(facet)].sides)) return {};
    if (first < span.low) first = span.low;
    spans.push_back(span);
  }
  if (std::any_of(spans.begin(), spans.end(), [&](const Span& span) { return span.high < first; })) return {};
  return first;
}

template class Moving_segment<2>;
template class Moving_segment<3>;

}  // namespace cellwalk::oracle
