// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rational_segment.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

using Vector_3 = Rational_point<3>;

template <std::size_t D>
std::array<Rational, D> minus(const std::array<Rational, D>& a, const std::array<Rational, D>& b) {
  std::array<Rational, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

template <std::size_t D>
Rational dot(const std::array<Rational, D>& a, const std::array<Rational, D>& b) {
  Rational r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

Vector_3 cross(const Vector_3& a, const Vector_3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Keeps the part of a span where an affine function with these values at 0 and 1 is >= 0. False if none is left.
bool clip(Span& span, const Rational& at_0, const Rational& at_1) {
  if (at_0 == at_1) return at_0 >= 0;
  const Rational root = at_0 / (at_0 - at_1);
  if (at_0 < at_1)
    span.low = std::max<Rational>(span.low, root);
  else
    span.high = std::min<Rational>(span.high, root);
  return span.low <= span.high;
}

/// A half-space {x : (x - point) . normal >= 0}.
template <int D>
struct Half_space {
  Rational_point<D> point, normal;
};

/// Half-spaces whose intersection is a closed facet: its plane from both sides, then its sides.
std::vector<Half_space<2>> half_spaces(const Cell_view<2>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  const auto u = exact<2>(cell.point(loop[0])), v = exact<2>(cell.point(loop[1]));
  const auto e = minus(v, u), back = minus(u, v);
  return {{u, {-e[1], e[0]}}, {u, {e[1], -e[0]}}, {u, e}, {v, back}};
}

std::vector<Half_space<3>> half_spaces(const Cell_view<3>& cell, std::size_t i) {
  const auto loop = cell.loop(i);
  std::vector<Vector_3> points;
  for (const std::uint16_t v : loop) points.push_back(exact<3>(cell.point(v)));
  const Vector_3 normal = cross(minus(points[1], points[0]), minus(points[2], points[0]));
  std::vector<Half_space<3>> result{{points[0], normal}, {points[0], {-normal[0], -normal[1], -normal[2]}}};
  for (std::size_t k = 0; k < points.size(); ++k)
    result.push_back({points[k], cross(normal, minus(points[(k + 1) % points.size()], points[k]))});
  return result;
}

}  // namespace

template <int D>
std::optional<Span> Rational_segment<D>::in_facet(const Cell_view<D>& cell, std::size_t i) const {
  Span span{0, 1};
  for (const Half_space<D>& h : half_spaces(cell, i))
    if (!clip(span, dot(h.normal, minus(p_, h.point)), dot(h.normal, minus(q_, h.point)))) return {};
  return span;
}

template <int D>
Facet_feature lowest_feature(const Cell_view<D>& cell, std::size_t i, const Rational_point<D>& x) {
  const auto loop = cell.loop(i);
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (exact<D>(cell.point(loop[k])) == x) return {Contact_kind::vertex, static_cast<std::uint16_t>(k)};
  if constexpr (D == 3) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto u = exact<3>(cell.point(loop[k])), v = exact<3>(cell.point(loop[(k + 1) % loop.size()]));
      const auto off = cross(minus(v, u), minus(x, u));
      if (dot(off, off) == 0) return {Contact_kind::edge, static_cast<std::uint16_t>(k)};
    }
  }
  return {};
}

template class Rational_segment<2>;
template class Rational_segment<3>;
template Facet_feature lowest_feature<2>(const Cell_view<2>&, std::size_t, const Rational_point<2>&);
template Facet_feature lowest_feature<3>(const Cell_view<3>&, std::size_t, const Rational_point<3>&);

}  // namespace cellwalk::detail
