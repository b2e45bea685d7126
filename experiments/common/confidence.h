// SPDX-License-Identifier: LGPL-3.0-or-later
// How sure a counted share is.
#ifndef CELLWALK_EXPERIMENTS_COMMON_CONFIDENCE_H
#define CELLWALK_EXPERIMENTS_COMMON_CONFIDENCE_H

#include <cstdint>

namespace cellwalk::experiments {

/// Bounds of a probability.
struct Share_interval {
  double low = 0, high = 1;
};

/// The 95 % confidence interval of the probability of a failure, after `failures` of `trials` independent
/// ones: Wilson's score interval, which stays in [0,1]. Without any failure the rule of three is used, [0,
/// 3/trials], and the like above where all failed: one-sided bounds, (1 - 3/n)^n is about 5 %. Without any
/// trial: [0,1].
/// \pre failures <= trials. The same bits with every compiler.
Share_interval confidence_interval(std::uint64_t failures, std::uint64_t trials);

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_CONFIDENCE_H
