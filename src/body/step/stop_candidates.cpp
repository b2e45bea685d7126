// SPDX-License-Identifier: LGPL-3.0-or-later
// Roundings of the point of contact, then points off the wall, then points back along the motion.
#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/kernel/next_double.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int largest_shift = 1024;  // ulp
constexpr int shrink_steps = 20;

}  // namespace

template <int D>
double ulp(const Point<D>& p) {
  double m = 0;
  for (const double x : p) m = std::max(m, std::abs(x));
  return next_above(m) - m;
}

template <int D>
bool try_stops(const Point<D>& p, const Point<D>& target, const Contact<D>& contact,
               const std::function<bool(const Point<D>&)>& try_at) {
  const Point_bounds<D> bounds = bounds_at<D>(p, target, contact.exact_time());
  Point<D> nearer, first;  // nearest to p; furthest from the wall
  for (int k = 0; k < D; ++k) {
    const bool is_upwards = target[k] >= p[k];
    nearer[k] = is_upwards ? bounds.below[k] : bounds.above[k];
    const double n = contact.normal[k];
    first[k] = n > 0 ? bounds.above[k] : n < 0 ? bounds.below[k] : nearer[k];
  }
  for (unsigned mask = 0; mask < 1u << D; ++mask) {
    Point<D> x = first;
    bool is_new = true;
    for (int k = 0; k < D; ++k)
      if (mask >> k & 1) {
        x[k] = first[k] == bounds.below[k] ? bounds.above[k] : bounds.below[k];
        is_new = is_new && x[k] != first[k];
      }
    if (is_new && try_at(x)) return true;
  }
  const double unit = ulp<D>(nearer == Point<D>{} ? p : nearer);
  for (int shift = 1; shift <= largest_shift; shift *= 2) {
    const Point<D> x = nearer + (shift * unit) * contact.normal;
    if (is_finite(x) && try_at(x)) return true;
  }
  for (int k = shrink_steps; k >= 1; --k) {
    const Point<D> x = p + contact.time * (1 - std::ldexp(1.0, -k)) * (target - p);
    if (is_finite(x) && try_at(x)) return true;
  }
  return false;
}

template double ulp<2>(const Point<2>&);
template double ulp<3>(const Point<3>&);
template bool try_stops<2>(const Point<2>&, const Point<2>&, const Contact<2>&,
                           const std::function<bool(const Point<2>&)>&);
template bool try_stops<3>(const Point<3>&, const Point<3>&, const Contact<3>&,
                           const std::function<bool(const Point<3>&)>&);

}  // namespace cellwalk::detail
