// SPDX-License-Identifier: LGPL-3.0-or-later
// The clock of what is timed.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PROCESSOR_TIME_H
#define CELLWALK_EXPERIMENTS_COMMON_PROCESSOR_TIME_H

#include <ctime>

namespace cellwalk::experiments {

/// Seconds of processor time of this thread: what others run at the same time counts little.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PROCESSOR_TIME_H
