// SPDX-License-Identifier: LGPL-3.0-or-later
// Times computed when they are first compared exactly; rounded ones decide most comparisons.
#include <cellwalk/internal/kernel/crossing.h>

#include <algorithm>

namespace cellwalk {
namespace {

template <int D>
bool are_same(const Crossing<D>& s, const Crossing<D>& t) {
  return s.a == t.a && s.b == t.b && std::is_permutation(s.plane.begin(), s.plane.end(), t.plane.begin());
}

const Fraction& as_fraction(const Fraction& fraction) { return fraction; }
template <int D>
Fraction as_fraction(const Crossing<D>& crossing) {
  return fraction_of(crossing);
}

/// True if two times come from one motion and one plane, which no arithmetic is needed for.
bool have_same_source(const Exact_fraction& s, const Exact_fraction& t) {
  const auto is_same = [&t]<class Source>(const Source& source) {
    if constexpr (std::is_same_v<Source, Fraction>) {
      return false;
    } else {
      const auto* other = std::get_if<Source>(&t.source);
      return other && are_same(source, *other);
    }
  };
  return std::visit(is_same, s.source);
}

}  // namespace

std::strong_ordering operator<=>(const Exact_time& s, const Exact_time& t) {
  // rounded() is one function of the time and never falls: where it differs, it decides.
  if (s.rounded_ != t.rounded_)
    return s.rounded_ < t.rounded_ ? std::strong_ordering::less : std::strong_ordering::greater;
  if (s.fraction_ == t.fraction_) return std::strong_ordering::equal;
  // A time with a fraction is later than its rounded one.
  if (!s.fraction_) return std::strong_ordering::less;
  if (!t.fraction_) return std::strong_ordering::greater;
  if (have_same_source(*s.fraction_, *t.fraction_)) return std::strong_ordering::equal;
  return to_fraction(s) <=> to_fraction(t);
}

Exact_time to_time(const Fraction& fraction) {
  const Rounded rounded = rounded_down(fraction);
  if (rounded.is_exact) return Exact_time(rounded.value);
  return {rounded.value, std::make_shared<const Exact_fraction>(Exact_fraction{fraction})};
}

Fraction to_fraction(const Exact_time& time) {
  if (!time.fraction()) return Fraction(time.rounded());
  return std::visit([](const auto& source) -> Fraction { return as_fraction(source); },
                    time.fraction()->source);
}

Rational to_rational(const Exact_time& time) { return to_rational(to_fraction(time)); }

}  // namespace cellwalk
