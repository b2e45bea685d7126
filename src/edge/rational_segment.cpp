// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rational_segment.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

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

}  // namespace

template <int D>
std::optional<Span> Rational_segment<D>::in_facet(const Cell_view<D>& cell, std::size_t i) const {
  Span span{0, 1};
  for (const Half_space<D>& h : half_spaces(cell, i))
    if (!clip(span, h.at(p_), h.at(q_))) return {};
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
      const auto edge = minus(v, u), to_x = minus(x, u);
      const auto off = exact_cross(edge, to_x);
      // Other edges of the facet may lie on the same line.
      if (exact_dot(off, off) == 0 && exact_dot(edge, to_x) >= 0 && exact_dot(edge, minus(v, x)) >= 0)
        return {Contact_kind::edge, static_cast<std::uint16_t>(k)};
    }
  }
  return {};
}

template class Rational_segment<2>;
template class Rational_segment<3>;
template Facet_feature lowest_feature<2>(const Cell_view<2>&, std::size_t, const Rational_point<2>&);
template Facet_feature lowest_feature<3>(const Cell_view<3>&, std::size_t, const Rational_point<3>&);

}  // namespace cellwalk::detail
