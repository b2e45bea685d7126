// SPDX-License-Identifier: LGPL-3.0-or-later
// Roots are compared by signs of polynomials at one of them: numbers of the form x + y sqrt(D), which are not
// nested, and whose signs take ring operations only. A root in doubles is but where the search for the
// greatest double below it starts.
#include <cellwalk/internal/kernel/exact_root.h>
#include <cellwalk/internal/kernel/greatest_double.h>
#include <cellwalk/internal/kernel/next_double.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk {
namespace {

int sign_of_ring(const Ring& x) { return static_cast<int>(CGAL::sign(x)); }

std::strong_ordering ordering(int sign) { return sign <=> 0; }

Quadratic derivative(const Quadratic& p) { return {Ring(0), Ring(Ring(2) * p.square), p.linear}; }

Ring discriminant(const Quadratic& p) { return Ring(p.linear * p.linear - Ring(4) * p.square * p.constant); }

/// The order of a number and a root.
/// \param side see Exact_root
/// \param sign_at gives the sign of a polynomial at the number
template <class Sign_at>
std::strong_ordering order(const Quadratic& polynomial, int side, Sign_at sign_at) {
  const int value = sign_at(polynomial);
  if (side == 0) return ordering(value);
  if (value < 0) return ordering(-side);  // between both roots
  // Elsewhere the polynomial falls up to the lower root, and rises from the upper one.
  const int slope = sign_at(derivative(polynomial));
  return value == 0 && slope == side ? std::strong_ordering::equal : ordering(slope);
}

/// The polynomial with a factor that brings its greatest coefficient into the middle of the range of doubles.
Quadratic scaled(Quadratic p) {
  constexpr double largest = 0x1p100, factor = 0x1p200;
  const auto size = [&p] {
    return std::max({std::abs(CGAL::to_double(p.square)), std::abs(CGAL::to_double(p.linear)),
                     std::abs(CGAL::to_double(p.constant))});
  };
  while (size() > largest) p = Ring(1 / factor) * p;
  while (size() < 1 / largest) p = Ring(factor) * p;
  return p;
}

/// A root in doubles; any number, or none, if coefficients differ by more than their range.
double in_doubles(const Quadratic& polynomial, int side) {
  const Quadratic p = scaled(polynomial);
  // Exact, since else all digits of roots that are close to each other might cancel.
  const double root = std::sqrt(CGAL::to_double(discriminant(p)));
  const double b = CGAL::to_double(p.linear), sum = b + std::copysign(root, b);
  return std::signbit(b) == (side > 0) ? -sum / (2 * CGAL::to_double(p.square))
                                       : -2 * CGAL::to_double(p.constant) / sum;
}

}  // namespace

bool Quadratic::is_zero() const {
  return sign_of_ring(square) == 0 && sign_of_ring(linear) == 0 && sign_of_ring(constant) == 0;
}

bool are_proportional(const Quadratic& p, const Quadratic& q) {
  if (p.square == q.square && p.linear == q.linear && p.constant == q.constant) return true;
  const auto agree = [&](const auto& i, const auto& j) { return Ring(p.*i * q.*j) == Ring(p.*j * q.*i); };
  return agree(&Quadratic::square, &Quadratic::linear) && agree(&Quadratic::square, &Quadratic::constant) &&
         agree(&Quadratic::linear, &Quadratic::constant) && p.is_zero() == q.is_zero();
}

std::optional<Exact_root> Exact_root::of(const Quadratic& polynomial, Which which) {
  const int sign_of_square = sign_of_ring(polynomial.square);
  if (sign_of_square == 0) {
    const int sign_of_linear = sign_of_ring(polynomial.linear);
    if (sign_of_linear == 0) return {};
    return Exact_root(Ring(sign_of_linear) * polynomial, 0);
  }
  const int sign_of_discriminant = sign_of_ring(discriminant(polynomial));
  if (sign_of_discriminant < 0) return {};
  Quadratic positive = Ring(sign_of_square) * polynomial;
  if (sign_of_discriminant == 0) return Exact_root(derivative(positive), 0);
  return Exact_root(std::move(positive), which == Which::lower ? -1 : 1);
}

Exact_root::Exact_root(const Fraction& fraction)
    : polynomial_{Ring(0), fraction.denominator(), Ring(-fraction.numerator())} {}

int Exact_root::sign_of(const Quadratic& other) const {
  const auto& [a, b, c] = polynomial_;
  if (side_ == 0) {
    // At -c/b, with b > 0; times b, or its square.
    const Ring value(other.constant * b - other.linear * c);
    if (sign_of_ring(other.square) == 0) return sign_of_ring(value);
    return sign_of_ring(Ring(value * b + other.square * c * c));
  }
  // At (-b + side sqrt(D)) / 2a the other polynomial is (x + side y sqrt(D)) / 2a^2.
  const Ring u(other.constant * a - other.square * c), y(other.linear * a - other.square * b);
  const int sign_of_x = sign_of_ring(Ring(Ring(2) * a * u - b * y)), sign_of_term = side_ * sign_of_ring(y);
  if (sign_of_term == 0 || sign_of_term == sign_of_x) return sign_of_x;
  if (sign_of_x == 0) return sign_of_term;
  // x^2 - y^2 D is the resultant of both polynomials times 4a^2.
  const Ring resultant(u * u - y * Ring(other.constant * b - other.linear * c));
  return sign_of_x * sign_of_ring(resultant);
}

std::optional<Fraction> Exact_root::as_fraction() const {
  if (side_ != 0) return {};
  return Fraction(Ring(-polynomial_.constant), polynomial_.linear);
}

std::strong_ordering operator<=>(const Exact_root& x, const Exact_root& y) {
  if (are_proportional(x.polynomial_, y.polynomial_)) return x.side_ <=> y.side_;
  return order(y.polynomial_, y.side_, [&x](const Quadratic& p) { return x.sign_of(p); });
}

std::strong_ordering operator<=>(const Exact_root& x, double y) {
  const auto sign_at_y = [at = Ring(y)](const Quadratic& p) {
    return sign_of_ring(Ring(Ring(p.square * at + p.linear) * at + p.constant));
  };
  return 0 <=> order(x.polynomial_, x.side_, sign_at_y);
}

Rounded rounded_down(const Exact_root& root) {
  if (const auto fraction = root.as_fraction()) return rounded_down(*fraction);
  const auto& [a, b, c] = root.polynomial_;
  const bool is_negative = root < 0.0;
  const Exact_root opposite({a, Ring(-b), c}, -root.side_);
  const Exact_root& size = is_negative ? opposite : root;
  const double below =
      detail::greatest_double(in_doubles(size.polynomial_, size.side_), std::numeric_limits<double>::max(),
                              [&size](double x) { return size >= x; });
  const bool is_exact = size == below;
  if (!is_negative) return {below, is_exact};
  return {is_exact ? -below : detail::next_below(-below), is_exact};
}

}  // namespace cellwalk
