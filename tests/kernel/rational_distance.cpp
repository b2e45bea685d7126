// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/rational_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cellwalk::test {
namespace {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

template <std::size_t D>
using Integers = std::array<Integer, D>;

template <std::size_t D>
Integer dot(const Integers<D>& a, const Integers<D>& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < D; ++k) sum += a[k] * b[k];
  return sum;
}

template <std::size_t D>
Integers<D> minus(const Integers<D>& a, const Integers<D>& b) {
  Integers<D> r;
  for (std::size_t k = 0; k < D; ++k) r[k] = a[k] - b[k];
  return r;
}

/// The least common denominator of the coordinates.
template <std::size_t D>
void multiply_by_denominators(Integer& scale, const std::vector<Rational_point<D>>& points) {
  for (const auto& x : points)
    for (const Fraction& c : x) scale = lcm(scale, Integer(denominator(c)));
}

template <std::size_t D>
Integers<D> scaled(const Rational_point<D>& x, const Integer& scale) {
  Integers<D> r;
  for (std::size_t k = 0; k < D; ++k)
    r[k] = Integer(numerator(x[k])) * Integer(scale / Integer(denominator(x[k])));
  return r;
}

/// Integer weights of the solution of a linear system by Cramer's rule; the last is the determinant.
using Matrix = std::array<std::array<Integer, 3>, 3>;

Integer determinant(const Matrix& m, std::size_t n) {
  if (n == 0) return 1;
  if (n == 1) return m[0][0];
  if (n == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// A point sum / weight, and the corners that span the simplex which has it inside.
template <std::size_t D>
struct Candidate {
  Integers<D> sum;
  Integer weight = 1, square;  // of the sum
  std::vector<Integers<D>> corners;
};

/// The point of least norm of the affine hull of independent points, if it lies in their simplex.
template <std::size_t D>
std::optional<Candidate<D>> least_of_simplex(const std::vector<Integers<D>>& points) {
  const std::size_t n = points.size() - 1;
  std::array<Integers<D>, 3> edges;
  for (std::size_t i = 0; i < n; ++i) edges[i] = minus(points[i + 1], points[0]);
  Matrix gram;
  std::array<Integer, 3> right;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) gram[i][j] = dot(edges[i], edges[j]);
    right[i] = -dot(edges[i], points[0]);
  }
  Candidate<D> result;
  result.weight = determinant(gram, n);
  if (result.weight == 0) return {};
  std::array<Integer, 4> weights;
  weights[0] = result.weight;
  for (std::size_t i = 0; i < n; ++i) {
    Matrix replaced = gram;
    for (std::size_t k = 0; k < n; ++k) replaced[k][i] = right[k];
    weights[i + 1] = determinant(replaced, n);
    if (weights[i + 1] < 0) return {};
    weights[0] -= weights[i + 1];
  }
  if (weights[0] < 0) return {};
  for (std::size_t k = 0; k < D; ++k)
    for (std::size_t i = 0; i <= n; ++i) result.sum[k] += weights[i] * points[i][k];
  for (std::size_t i = 0; i <= n; ++i)
    if (weights[i] > 0) result.corners.push_back(points[i]);
  Integer divisor = result.weight;
  for (const Integer& x : result.sum) divisor = gcd(divisor, x);
  result.weight /= divisor;
  for (Integer& x : result.sum) x /= divisor;
  result.square = dot(result.sum, result.sum);
  return result;
}

template <std::size_t D>
bool is_shorter(const Candidate<D>& x, const Candidate<D>& y) {
  return x.square * y.weight * y.weight < y.square * x.weight * x.weight;
}

template <std::size_t D>
Candidate<D> least_norm(const std::vector<Integers<D>>& corners) {
  Candidate<D> x = *least_of_simplex<D>({corners[0]});
  for (;;) {
    const Integers<D>* furthest = nullptr;
    Integer least;
    for (const Integers<D>& v : corners) {
      const Integer product = dot(v, x.sum);
      if (furthest != nullptr && product >= least) continue;
      least = product;
      furthest = &v;
    }
    if (least * x.weight >= x.square) return x;
    // A shorter one lies in a simplex at that corner.
    std::optional<Candidate<D>> best;
    for (std::size_t subset = 0; subset < std::size_t{1} << x.corners.size(); ++subset) {
      std::vector<Integers<D>> points{*furthest};
      for (std::size_t i = 0; i < x.corners.size(); ++i)
        if (subset >> i & 1) points.push_back(x.corners[i]);
      auto candidate = least_of_simplex(points);
      if (candidate && (!best || is_shorter(*candidate, *best))) best = std::move(candidate);
    }
    x = std::move(*best);
  }
}

/// The greatest double that is not above the square root of x, or one beside it.
double near_root(const Fraction& x) {
  // So many bits that the integer root has at least 64.
  const Integer n(numerator(x)), d(denominator(x));
  const int missing = 130 + static_cast<int>(msb(d)) - static_cast<int>(msb(n));
  const int shift = missing >= 0 ? (missing + 1) / 2 : -(-missing / 2);
  const Integer root =
      shift >= 0 ? sqrt(Integer((n << (2 * shift)) / d)) : sqrt(Integer(n / (d << (-2 * shift))));
  const int cut = static_cast<int>(msb(root)) - 52;
  return std::ldexp(static_cast<double>(Integer(root >> cut)), cut - shift);
}

}  // namespace

template <int D>
Shortest<D> shortest_vector(const Hull<D>& a, const Hull<D>& b) {
  constexpr auto dimension = static_cast<std::size_t>(D);
  Integer scale = 1;
  multiply_by_denominators(scale, a);
  multiply_by_denominators(scale, b);
  std::vector<Integers<dimension>> starts, differences;
  for (const auto& x : a) starts.push_back(scaled(x, scale));
  for (const auto& y : b) {
    const Integers<dimension> end = scaled(y, scale);
    for (const auto& start : starts) differences.push_back(minus(end, start));
  }
  const Candidate<dimension> least = least_norm(differences);
  const Integer unit = scale * least.weight;
  Shortest<D> result;
  for (std::size_t k = 0; k < dimension; ++k)
    result.vector[k] =
        Fraction(boost::multiprecision::mpz_int(least.sum[k]), boost::multiprecision::mpz_int(unit));
  result.square = Fraction(boost::multiprecision::mpz_int(least.square),
                           boost::multiprecision::mpz_int(Integer(unit * unit)));
  return result;
}

template Shortest<2> shortest_vector<2>(const Hull<2>&, const Hull<2>&);
template Shortest<3> shortest_vector<3>(const Hull<3>&, const Hull<3>&);

double root_rounded_down(const Fraction& x) {
  if (x == 0) return 0;
  constexpr double most = std::numeric_limits<double>::max();
  double root = std::min(near_root(x), most);
  while (!root_is_at_least(x, root)) root = std::nextafter(root, 0.);
  while (root < most && root_is_at_least(x, std::nextafter(root, most))) root = std::nextafter(root, most);
  return root;
}

std::optional<double> double_root(const Fraction& x) {
  const double root = root_rounded_down(x);
  if (Fraction(root) * Fraction(root) != x) return {};
  return root;
}

}  // namespace cellwalk::test
