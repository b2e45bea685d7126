// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/integer_complex.h"

#include <cmath>
#include <optional>

namespace cellwalk::oracle {
namespace {

template <std::size_t D>
using Vec = std::array<Big, D>;

template <std::size_t D>
Affine<static_cast<int>(D), Big> through(const Vec<D>& normal, const Vec<D>& x) {
  return {normal, dot(normal, x)};
}

void add_functions(const std::vector<Vec<2>>& loop, Integer_complex<2>& complex) {
  const Vec<2> along = minus(loop[1], loop[0]), back = minus(loop[0], loop[1]);
  complex.planes.push_back(through<2>({along[1], -along[0]}, loop[0]));
  complex.rims.push_back({through(back, loop[0]), through(along, loop[1])});
}

void add_functions(const std::vector<Vec<3>>& loop, Integer_complex<3>& complex) {
  // Vertices may be collinear, all but the last with the first.
  Vec<3> normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vec<3> n = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += n[k];
  }
  complex.planes.push_back(through(normal, loop[0]));
  auto& rims = complex.rims.emplace_back();
  // Within the plane, functions of two coordinates will do.
  const std::size_t axis = normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec<3> e = minus(loop[(i + 1) % loop.size()], loop[i]);
    Vec<3> n{0, 0, 0};
    n[x] = normal[axis] > 0 ? e[y] : Big(-e[y]);
    n[y] = normal[axis] > 0 ? Big(-e[x]) : e[x];
    rims.push_back(through(n, loop[i]));
  }
}

constexpr int limb_bits = 64;
static_assert(sizeof(boost::multiprecision::limb_type) * 8 == limb_bits);

/// |x| / 2^(limb_bits * (limbs - 1)) by its two leading limbs. Its relative error is below 2^-51: one half is
/// the rounding of the limbs, the rest the limbs left out and the sum.
double leading(const Big& x) {
  const auto* limbs = x.backend().limbs();
  const auto size = x.backend().size();
  const auto top = static_cast<double>(limbs[size - 1]);
  return size == 1 ? top : top + std::ldexp(static_cast<double>(limbs[size - 2]), -limb_bits);
}

/// A fraction but for a share of 2^-49: those of two numbers and of their quotient. No value if it is very
/// large or small.
std::optional<double> estimate(const Share& s) {
  if (s.numerator == 0) return 0.0;
  constexpr int most_limbs = 8;  // far from where doubles end
  const int limbs =
      static_cast<int>(s.numerator.backend().size()) - static_cast<int>(s.denominator.backend().size());
  if (std::abs(limbs) > most_limbs) return {};
  const double size = std::ldexp(leading(s.numerator) / leading(s.denominator), limb_bits * limbs);
  return s.numerator < 0 ? -size : size;
}

}  // namespace

int order(const Share& s, const Share& t) {
  constexpr double error = 0x1p-47;  // more than those of both together
  const auto x = estimate(s), y = estimate(t);
  if (x && y && std::abs(*x - *y) > error * std::max(std::abs(*x), std::abs(*y))) return *x < *y ? -1 : 1;
  return Big(s.numerator * t.denominator).compare(Big(t.numerator * s.denominator));
}

Share exact_share(double x) {
  const Dyadic d = to_dyadic(x);
  if (d.exponent >= 0) return {Big(d.mantissa) << d.exponent, 1};
  return {d.mantissa, Big(1) << -d.exponent};
}

Share between(const Share& s, const Share& t) {
  return {s.numerator + t.numerator, s.denominator + t.denominator};
}

template <int D>
Integer_complex<D>::Integer_complex(const Cell_soup<D>& s) : soup(s), table(make_facet_table(s)) {
  for (const Point<D>& p : soup.points) shift = std::max(shift, shift_of(p));
  for (const Point<D>& p : soup.points) points.push_back(integer(p, shift));
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    std::vector<Vec<D>> loop;
    for (const std::uint32_t v : soup.facet(f)) loop.push_back(points[v]);
    add_functions(loop, *this);
  }
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const Point<D>& any = soup.points[soup.vertices[soup.facet_begin[soup.cell_begin[c]]]];
    std::array<Point<D>, 2> box{any, any};
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      for (const std::uint32_t v : soup.facet(f))
        for (int i = 0; i < D; ++i) {
          box[0][i] = std::min(box[0][i], soup.points[v][i]);
          box[1][i] = std::max(box[1][i], soup.points[v][i]);
        }
    boxes.push_back(box);
  }
}

template struct Integer_complex<2>;
template struct Integer_complex<3>;

}  // namespace cellwalk::oracle
