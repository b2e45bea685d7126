// SPDX-License-Identifier: LGPL-3.0-or-later
// Spans of a segment clipped by half-spaces, and the lowest feature at a parameter.
#include "rational_segment.h"

#include <algorithm>
#include <cmath>

namespace cellwalk::detail {
namespace {

bool are_zero(const auto& vector) {
  return std::all_of(vector.begin(), vector.end(), [](const Ring& x) { return CGAL::is_zero(x); });
}

/// True proves that a point, given by its coordinates rounded towards 0, is not on the line uv: a component
/// of (v - u) x (x - u) is not 0. With w = 2^-53, the differences and products have relative errors w each,
/// and a coordinate of x one of 2w or 2^-1074: together less than 16w times the magnitude below.
bool is_off(const Point<3>& u, const Point<3>& v, const Point<3>& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double e_i = v[i] - u[i], e_j = v[j] - u[j];
    const double left = e_i * (x[j] - u[j]), right = e_j * (x[i] - u[i]);
    const double magnitude = std::abs(left) + std::abs(right) +
                             std::abs(e_i) * (std::abs(x[j]) + underflow_allowance) +
                             std::abs(e_j) * (std::abs(x[i]) + underflow_allowance);
    if (magnitude > smallest_magnitude && magnitude < largest_magnitude &&
        std::abs(left - right) > orientation_error * magnitude)
      return true;
  }
  return false;
}

}  // namespace

template <int D>
Exact_point<D> Rational_segment<D>::at(const Fraction& t) const {
  const Ring rest = t.denominator() - t.numerator(), part = t.numerator() * p_.denominator;
  Exact_point<D> x;
  for (int i = 0; i < D; ++i) x.numerator[i] = rest * p_.numerator[i] + part * q_[i];
  x.denominator = t.denominator() * p_.denominator;
  return x;
}

bool clip(Span& span, const Ring& at_p, const Ring& at_q, int border) {
  const auto begin_at = [&](const Fraction& t) {
    if (t <= span.low) return;
    span.low = t;
    span.low_border = border;
  };
  const auto end_at = [&](const Fraction& t) {
    if (span.high <= t) return;
    span.high = t;
    span.high_border = border;
  };
  const int sign_p = CGAL::sign(at_p), sign_q = CGAL::sign(at_q);
  if (sign_p >= 0 && sign_q >= 0) return true;
  if (sign_p <= 0 && sign_q <= 0) {
    // At most one end is left.
    if (sign_p == 0)
      end_at(0);
    else if (sign_q == 0)
      begin_at(1);
    else
      return false;
    return span.low <= span.high;
  }
  const Fraction root(at_p, at_p - at_q);
  if (sign_p < 0)
    begin_at(root);
  else
    end_at(root);
  return span.low <= span.high;
}

/// Keeps the part of a span in a half-space. Returns false if nothing is left.
template <int D>
bool Rational_segment<D>::clip(Span& span, const Half_space<D>& h, int border) const {
  return detail::clip(span, h.at(p_), p_.denominator * h.at(q_), border);
}

template <int D>
std::optional<Span> Rational_segment<D>::in_facet(const Cell_view<D>& cell, std::size_t i) const {
  const Half_space<D> plane = plane_of(cell, i);
  Span span{0, 1};
  if (!clip(span, plane, 0) || !clip(span, {plane.point, negative(plane.normal)}, 1)) return {};
  const std::size_t sides = cell.loop(i).size();
  for (std::size_t k = 0; k < sides; ++k)
    if (!clip(span, side_space(cell, i, k, plane), 2 + static_cast<int>(k))) return {};
  return span;
}

template <int D>
Fraction Rational_segment<D>::at_border(const Cell_view<D>& cell, std::size_t i, int border) const {
  const Half_space<D> plane = plane_of(cell, i);
  const Half_space<D> h =
      border < 2 ? plane : side_space(cell, i, static_cast<std::size_t>(border - 2), plane);
  const Ring at_p = h.at(p_), at_q = p_.denominator * h.at(q_);
  if (CGAL::is_zero(at_q)) return 1;
  return {at_p, at_p - at_q};
}

template <int D>
Fraction Rational_segment<D>::in_plane(const Cell_view<D>& cell, std::size_t i) const {
  const Half_space<D> plane = plane_of(cell, i);
  const Ring at_p = plane.at(p_);
  return {at_p, at_p - p_.denominator * plane.at(q_)};
}

template <int D>
Facet_feature lowest_feature(const Cell_view<D>& cell, std::size_t i, const Exact_point<D>& x) {
  const auto loop = cell.loop(i);
  const Point<D> rounded = x.rounded();
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (cell.point(loop[k]) == rounded && are_zero(x.from(exact<D>(cell.point(loop[k])))))
      return {Contact_kind::vertex, static_cast<std::uint16_t>(k)};
  if constexpr (D == 3) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point<3>&from = cell.point(loop[k]), &to = cell.point(loop[k + 1 == loop.size() ? 0 : k + 1]);
      if (is_off(from, to, rounded)) continue;
      const auto u = exact<3>(from), v = exact<3>(to), edge = minus(v, u), from_u = x.from(u);
      // Other edges of the facet may lie on the same line.
      if (are_zero(exact_cross(edge, from_u)) && CGAL::sign(exact_dot(edge, from_u)) != CGAL::NEGATIVE &&
          CGAL::sign(exact_dot(edge, x.from(v))) != CGAL::POSITIVE)
        return {Contact_kind::edge, static_cast<std::uint16_t>(k)};
    }
  }
  return {};
}

template class Rational_segment<2>;
template class Rational_segment<3>;
template Facet_feature lowest_feature<2>(const Cell_view<2>&, std::size_t, const Exact_point<2>&);
template Facet_feature lowest_feature<3>(const Cell_view<3>&, std::size_t, const Exact_point<3>&);

}  // namespace cellwalk::detail
