// SPDX-License-Identifier: LGPL-3.0-or-later
#include "common/confidence.h"

#include <algorithm>
#include <cmath>

namespace cellwalk::experiments {

Share_interval confidence_interval(std::uint64_t failures, std::uint64_t trials) {
  constexpr double z = 1.959964;  // quantile of the normal distribution: 95 % lie within, on both sides
  if (trials == 0) return {};
  const auto n = static_cast<double>(trials);
  const double rule_of_three = std::min(1.0, 3 / n);
  if (failures == 0) return {0, rule_of_three};
  if (failures == trials) return {1 - rule_of_three, 1};
  const double share = static_cast<double>(failures) / n;
  const double centre = share + z * z / (2 * n), scale = 1 + z * z / n;
  const double half = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {std::max(0.0, (centre - half) / scale), std::min(1.0, (centre + half) / scale)};
}

}  // namespace cellwalk::experiments
