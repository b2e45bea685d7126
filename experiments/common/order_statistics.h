// SPDX-License-Identifier: LGPL-3.0-or-later
// Medians and quantiles of measured values.
#ifndef CELLWALK_EXPERIMENTS_COMMON_ORDER_STATISTICS_H
#define CELLWALK_EXPERIMENTS_COMMON_ORDER_STATISTICS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cellwalk::experiments {

/// The median; of an even number of values the mean of the two in the middle; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/// The least value that a share of all does not exceed; 0 of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const auto count = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(count, 1, values.size()) - 1];
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_ORDER_STATISTICS_H
