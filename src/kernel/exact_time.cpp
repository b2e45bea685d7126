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
Fraction as_fraction(const Exact_root& root) { return root.as_fraction().value(); }

template <int D>
bool are_one_crossing(const Exact_fraction& s, const Exact_fraction& t) {
  const auto *of_s = std::get_if<Crossing<D>>(&s.source), *of_t = std::get_if<Crossing<D>>(&t.source);
  return of_s && of_t && are_same(*of_s, *of_t);
}

/// True if two times come from one motion and one plane, which no arithmetic is needed for.
bool have_same_source(const Exact_fraction& s, const Exact_fraction& t) {
  return are_one_crossing<3>(s, t) || are_one_crossing<2>(s, t);
}

const Exact_root* root_of(const Exact_time& time) {
  return std::get_if<Exact_root>(&time.fraction()->source);
}

/// The order of two times that round to the same double, and are later than it. Not inlined, since comparing
/// the rounded times, which mostly decides, would otherwise take 15 % longer.
[[gnu::noinline]] std::strong_ordering exact_order(const Exact_time& s, const Exact_time& t) {
  const Exact_root *root_s = root_of(s), *root_t = root_of(t);
  if (root_s && root_t) return *root_s <=> *root_t;
  if (root_s) return *root_s <=> Exact_root(to_fraction(t));
  if (root_t) return Exact_root(to_fraction(s)) <=> *root_t;
  return to_fraction(s) <=> to_fraction(t);
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
  return exact_order(s, t);
}

Exact_time to_time(const Fraction& fraction) {
  const Rounded rounded = rounded_down(fraction);
  if (rounded.is_exact) return Exact_time(rounded.value);
  return {rounded.value, std::make_shared<const Exact_fraction>(Exact_fraction{fraction})};
}

Exact_time to_time(const Exact_root& root) {
  if (const auto fraction = root.as_fraction()) return to_time(*fraction);
  const Rounded rounded = rounded_down(root);
  if (rounded.is_exact) return Exact_time(rounded.value);
  return {rounded.value, std::make_shared<const Exact_fraction>(Exact_fraction{root})};
}

Fraction to_fraction(const Exact_time& time) {
  if (!time.fraction()) return Fraction(time.rounded());
  return std::visit([](const auto& source) -> Fraction { return as_fraction(source); },
                    time.fraction()->source);
}

Rational to_rational(const Exact_time& time) { return to_rational(to_fraction(time)); }

}  // namespace cellwalk
