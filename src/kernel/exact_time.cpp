// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/exact_value.h>

#include <cmath>
#include <limits>

namespace cellwalk {

std::strong_ordering operator<=>(const Exact_time& s, const Exact_time& t) {
  // rounded() is one function of the time and never falls: where it differs, it decides.
  if (s.rounded_ != t.rounded_)
    return s.rounded_ < t.rounded_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (s.fraction_ == t.fraction_) return std::strong_ordering::equal;
  const Rational difference = to_rational(s) - to_rational(t);
  return static_cast<int>(CGAL::sign(difference)) <=> 0;
}

Exact_time to_time(const Rational& fraction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double rounded = CGAL::to_double(fraction);
  while (Rational(rounded) > fraction) rounded = std::nextafter(rounded, -infinity);
  for (double next = std::nextafter(rounded, infinity); Rational(next) <= fraction;
       next = std::nextafter(rounded, infinity))
    rounded = next;
  if (Rational(rounded) == fraction) return Exact_time(rounded);
  return {rounded, std::make_shared<const Exact_fraction>(Exact_fraction{fraction})};
}

Rational to_rational(const Exact_time& time) {
  return time.fraction() ? time.fraction()->value : Rational(time.rounded());
}

}  // namespace cellwalk
