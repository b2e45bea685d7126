// SPDX-License-Identifier: LGPL-3.0-or-later
#include "oracle/exact_world.h"

#include <cellwalk/internal/environment/cell_check.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace cellwalk::oracle {
namespace {

template <class N>
std::array<N, 3> cross_product(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {N(a[1] * b[2] - a[2] * b[1]), N(a[2] * b[0] - a[0] * b[2]), N(a[0] * b[1] - a[1] * b[0])};
}

template <class N, std::size_t D>
N scalar_product(const std::array<N, D>& a, const std::array<N, D>& b) {
  N r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

template <class N, std::size_t D>
std::array<N, D> difference(const std::array<N, D>& a, const std::array<N, D>& b) {
  std::array<N, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

/// The function that vanishes at x and grows along the normal. Its coefficients are made as small as they go
/// where bits are scarce.
template <class N, std::size_t D>
Affine<static_cast<int>(D), N> affine_through(std::array<N, D> normal, const std::array<N, D>& x) {
  if (std::all_of(normal.begin(), normal.end(), [](const N& n) { return n == 0; }))
    throw std::invalid_argument("a facet without extent");
  if constexpr (std::is_same_v<N, Int128>) {
    N divisor = 0;
    for (const N& n : normal) divisor = greatest_common_divisor(divisor, n);
    for (N& n : normal) n /= divisor;
  }
  return {normal, scalar_product(normal, x)};
}

/// A fraction given by the values of an affine function at 0 and at 1: where it vanishes.
template <class N>
Fraction<N> root(const N& at_start, const N& at_end) {
  if (at_start > at_end) return {at_start, N(at_start - at_end)};
  return {N(-at_start), N(at_end - at_start)};
}

/// Narrows [first,last] to where the function with these end values is <= 0; false if nothing is left.
template <class N>
bool clip(const N& at_start, const N& at_end, Fraction<N>& first, Fraction<N>& last) {
  if (at_start <= 0 && at_end <= 0) return true;
  if (at_start > 0 && at_end > 0) return false;
  const Fraction<N> t = root(at_start, at_end);
  if (at_start > 0) {
    if (compare(t, first) > 0) first = t;
  } else {
    if (compare(t, last) < 0) last = t;
  }
  return compare(first, last) <= 0;
}

}  // namespace

template <int D, class N>
struct Exact_world<D, N>::Motion {
  std::array<N, D> a, b;
  N weight;  // the points are a/weight and b/weight in the integers of the world

  N at_start(const Affine<D, N>& f) const { return scalar_product(f.normal, a) - f.offset * weight; }
  N at_end(const Affine<D, N>& f) const { return scalar_product(f.normal, b) - f.offset * weight; }
};

template <int D, class N>
Exact_world<D, N>::Exact_world(const Cell_soup<D>& soup, const Facet_table& facets, int shift)
    : soup_(soup), table_(facets), shift_(shift) {
  points_.resize(soup.points.size());
  for (std::size_t p = 0; p < points_.size(); ++p)
    for (int i = 0; i < D; ++i) points_[p][i] = scaled<N>(soup.points[p][i], shift);
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    facets_.push_back(make_facet(soup.facet(f)));
    const auto note = [&](const Affine<D, N>& g) {
      for (const N& n : g.normal) normal_bits_ = std::max(normal_bits_, bit_length<N>(n));
      offset_bits_ = std::max(offset_bits_, bit_length<N>(g.offset));
    };
    note(facets_.back().plane);
    for (const auto& rim : facets_.back().rims) note(rim);
  }
  for (std::size_t c = 0; c < soup.cell_count(); ++c) check_cell(c);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const Point<D>& any = soup.points[soup.vertices[soup.facet_begin[soup.cell_begin[c]]]];
    std::array<Point<D>, 2> box{any, any};
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      for (std::uint32_t v : soup.facet(f))
        for (int i = 0; i < D; ++i) {
          box[0][i] = std::min(box[0][i], soup.points[v][i]);
          box[1][i] = std::max(box[1][i], soup.points[v][i]);
        }
    boxes_.push_back(box);
  }
}

template <int D, class N>
typename Exact_world<D, N>::Facet Exact_world<D, N>::make_facet(std::span<const std::uint32_t> loop) const {
  Facet facet;
  const auto& origin = points_[loop[0]];
  if constexpr (D == 2) {
    const auto& end = points_[loop[1]];
    const std::array<N, 2> along = difference(end, origin), back = difference(origin, end);
    facet.plane = affine_through<N, 2>({along[1], N(-along[0])}, origin);
    facet.rims = {affine_through<N, 2>(back, origin), affine_through<N, 2>(along, end)};
  } else {
    std::array<N, 3> normal{0, 0, 0};
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const auto triangle =
          cross_product(difference(points_[loop[i]], origin), difference(points_[loop[i + 1]], origin));
      for (int k = 0; k < 3; ++k) normal[k] += triangle[k];
    }
    facet.plane = affine_through(normal, origin);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto& u = points_[loop[i]];
      const auto& v = points_[loop[(i + 1) % loop.size()]];
      facet.rims.push_back(affine_through(cross_product(difference(v, u), facet.plane.normal), u));
    }
  }
  for (std::uint32_t v : loop) {
    if (scalar_product(facet.plane.normal, points_[v]) != facet.plane.offset)
      throw std::invalid_argument("a facet that is not planar");
    for (const auto& rim : facet.rims)
      if (scalar_product(rim.normal, points_[v]) > rim.offset)
        throw std::invalid_argument("a facet that is not convex");
  }
  return facet;
}

template <int D, class N>
void Exact_world<D, N>::check_cell(std::size_t cell) const {
  for (std::size_t f = soup_.cell_begin[cell]; f < soup_.cell_begin[cell + 1]; ++f) {
    bool has_depth = false;
    for (std::size_t g = soup_.cell_begin[cell]; g < soup_.cell_begin[cell + 1]; ++g)
      for (std::uint32_t v : soup_.facet(g)) {
        const N height = scalar_product(facets_[f].plane.normal, points_[v]) - facets_[f].plane.offset;
        if (height > 0) throw std::invalid_argument("cell " + std::to_string(cell) + " is not convex");
        has_depth = has_depth || height < 0;
      }
    if (!has_depth) throw std::invalid_argument("cell " + std::to_string(cell) + " is flat");
  }
}

template <int D, class N>
int Exact_world<D, N>::value_bits(int point_bits, int extra_shift) const {
  // D products and the offset's, summed; one bit more for the difference of two values.
  return std::max(normal_bits_ + point_bits + 2, offset_bits_ + extra_shift + 1) + 2;
}

template <int D, class N>
bool Exact_world<D, N>::holds(const Facet& facet, const Motion& m, const Fraction<N>& t) const {
  const auto sign_of = [&](const Affine<D, N>& f) { return sign_between<N>(m.at_start(f), m.at_end(f), t); };
  return sign_of(facet.plane) == 0 && std::all_of(facet.rims.begin(), facet.rims.end(),
                                                  [&](const auto& rim) { return sign_of(rim) <= 0; });
}

template <int D, class N>
int Exact_world<D, N>::dimension_at(std::size_t cell, const Motion& m, const Fraction<N>& t) const {
  int dimension = D;
  for (std::size_t f = soup_.cell_begin[cell]; f < soup_.cell_begin[cell + 1]; ++f) {
    if (!holds(facets_[f], m, t)) continue;
    dimension = std::min(dimension, D - 1);
    for (const auto& rim : facets_[f].rims)
      if (sign_between<N>(m.at_start(rim), m.at_end(rim), t) == 0) dimension = std::min(dimension, D - 2);
    for (std::uint32_t v : soup_.facet(f)) {
      bool same = true;
      for (int i = 0; i < D && same; ++i)
        same = sign_between<N>(m.a[i] - points_[v][i] * m.weight, m.b[i] - points_[v][i] * m.weight, t) == 0;
      if (same) return 0;
    }
  }
  return dimension;
}

template <int D, class N>
Trace Exact_world<D, N>::trace(const Point<D>& from, const Point<D>& to, int extra_shift) const {
  Motion m;
  m.weight = N(1) << extra_shift;
  Point<D> low, high;
  for (int i = 0; i < D; ++i) {
    m.a[i] = scaled<N>(from[i], shift_ + extra_shift);
    m.b[i] = scaled<N>(to[i], shift_ + extra_shift);
    low[i] = std::min(from[i], to[i]);
    high[i] = std::max(from[i], to[i]);
  }
  const bool moves = m.a != m.b;
  const Fraction<N> zero{0, 1}, one{1, 1};

  struct Span {
    Fraction<N> first, last;
  };
  Trace trace;
  std::vector<Span> visit_spans, incidence_spans;
  std::vector<std::int64_t> incidence_half_facets;
  std::vector<std::pair<N, N>> values;  // of the facets of a cell at both ends
  for (std::uint32_t c = 0; c < soup_.cell_count(); ++c) {
    bool apart = false;
    for (int i = 0; i < D; ++i) apart = apart || boxes_[c][0][i] > high[i] || boxes_[c][1][i] < low[i];
    if (apart) continue;
    Span span{zero, one};
    bool met = true;
    values.clear();
    for (std::size_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1] && met; ++f) {
      values.emplace_back(m.at_start(facets_[f].plane), m.at_end(facets_[f].plane));
      met = clip(values.back().first, values.back().second, span.first, span.last);
    }
    if (!met) continue;
    if (!moves) span.last = span.first;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t f = soup_.cell_begin[c] + i;
      const auto& [at_start, at_end] = values[i];
      Span meets = span;
      if (at_start == 0 && at_end == 0) {
        bool any = true;
        for (const auto& rim : facets_[f].rims)
          any = any && clip(m.at_start(rim), m.at_end(rim), meets.first, meets.last);
        if (!any) continue;
      } else {
        if ((at_start > 0 && at_end > 0) || (at_start < 0 && at_end < 0)) continue;
        meets.first = meets.last = root(at_start, at_end);
        if (compare(meets.first, span.first) < 0 || compare(meets.first, span.last) > 0) continue;
        if (!holds(facets_[f], m, meets.first)) continue;
      }
      trace.incidences.push_back({static_cast<int>(trace.visits.size()), static_cast<std::uint32_t>(i), -1,
                                  static_cast<bool>(table_.passable[f]), 0, 0});
      incidence_spans.push_back(meets);
      incidence_half_facets.push_back(static_cast<std::int64_t>(f));
    }
    trace.visits.push_back({c, static_cast<bool>(soup_.solid[c]), 0, 0, dimension_at(c, m, span.last)});
    visit_spans.push_back(span);
  }

  std::vector<Fraction<N>> events{zero};
  if (moves) events.push_back(one);
  for (const auto* spans : {&visit_spans, &incidence_spans})
    for (const Span& s : *spans) {
      events.push_back(s.first);
      events.push_back(s.last);
    }
  const auto before = [](const Fraction<N>& s, const Fraction<N>& t) { return compare(s, t) < 0; };
  std::sort(events.begin(), events.end(), before);
  events.erase(std::unique(events.begin(), events.end(),
                           [](const Fraction<N>& s, const Fraction<N>& t) { return compare(s, t) == 0; }),
               events.end());
  const auto rank = [&](const Fraction<N>& t) {
    return static_cast<int>(std::lower_bound(events.begin(), events.end(), t, before) - events.begin());
  };
  for (const auto& e : events) trace.events.push_back({Wide(e.numerator), Wide(e.denominator)});
  for (std::size_t v = 0; v < trace.visits.size(); ++v) {
    trace.visits[v].first = rank(visit_spans[v].first);
    trace.visits[v].last = rank(visit_spans[v].last);
  }
  for (std::size_t i = 0; i < trace.incidences.size(); ++i) {
    trace.incidences[i].first = rank(incidence_spans[i].first);
    trace.incidences[i].last = rank(incidence_spans[i].last);
    const std::int64_t opposite = table_.opposite[incidence_half_facets[i]];
    if (opposite >= 0) trace.incidences[i].neighbour = trace.visit_of(table_.cell[opposite]);
  }
  return trace;
}

template class Exact_world<2, Int128>;
template class Exact_world<3, Int128>;
template class Exact_world<2, Wide>;
template class Exact_world<3, Wide>;

}  // namespace cellwalk::oracle
