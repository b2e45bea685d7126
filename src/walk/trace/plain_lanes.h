// SPDX-License-Identifier: LGPL-3.0-or-later
// The arithmetic of lane_lengths.h for any processor: one plane at a time.
#ifndef CELLWALK_WALK_TRACE_PLAIN_LANES_H
#define CELLWALK_WALK_TRACE_PLAIN_LANES_H

#include <cellwalk/internal/kernel/twofold.h>

#include <cmath>

#include "lane_functions.h"

namespace cellwalk::detail {

struct Plain_lanes {
  using Vector = double;
  static constexpr unsigned long width = 1;

  static double all(double x) { return x; }
  static double load(const double* from) { return *from; }
  static void store(double* to, double x) { *to = x; }
  static double product_error(double a, double b, double) { return exact_product(a, b).low; }
  static double multiply_add(double a, double b, double c) { return a * b + c; }
  static double square_root(double x) { return std::sqrt(x); }
  static double magnitude(double x) { return std::abs(x); }
  static void load(const Lane_plane* planes, const unsigned* of_lane, unsigned long, double* high,
                   double* low) {
    for (int k = 0; k < 4; ++k) {
      high[k] = planes[*of_lane].high[k];
      low[k] = planes[*of_lane].low[k];
    }
  }
  static double shift(double before, double) { return before; }
  static unsigned store_certain(double* to, double length, double low, double error, unsigned long) {
    const bool is_certain =
        length + (low + error) == length && length + (low - error) == length && length > 0;
    *to = is_certain ? length : 0;
    return is_certain;
  }
};

inline constexpr Lane_functions plain_lane_functions{&set_directions_in_lanes<Plain_lanes>,
                                                     &place_in_lanes<Plain_lanes>,
                                                     &measure_in_lanes<Plain_lanes>, nullptr, nullptr};

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_PLAIN_LANES_H
