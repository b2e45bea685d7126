// SPDX-License-Identifier: LGPL-3.0-or-later
// Loops over indices by several threads, with errors that do not depend on their number.
#ifndef CELLWALK_ENVIRONMENT_SOUP_PARALLEL_H
#define CELLWALK_ENVIRONMENT_SOUP_PARALLEL_H

#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace cellwalk {

/// Calls f(i) for i in [0, n), in any order and on any thread.
template <class F>
void for_each_parallel(std::size_t n, const F& f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) f(i);
  });
}

/// The same for an f that throws an Error where i is unsound. Whatever the number of threads, the error of
/// the lowest such i is thrown.
template <class F>
void check_each(std::size_t n, const F& f) {
  try {
    for_each_parallel(n, f);
  } catch (const Error&) {
    for (std::size_t i = 0; i < n; ++i) f(i);
    throw;
  }
}

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_SOUP_PARALLEL_H
