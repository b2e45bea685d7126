// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions of points by any number policy and strategy, for those who repeat the paper.
#ifndef CELLWALK_INTERNAL_QUERY_KERNEL_CHOICE_H
#define CELLWALK_INTERNAL_QUERY_KERNEL_CHOICE_H

#include <cellwalk/kernel/policies.h>
#include <cellwalk/query/query.h>
#include <cellwalk/walk/strategy.h>

namespace cellwalk {

enum class Kernel_choice {
  exact,
  lazy,
  rational,
  double_precision,
  double_tolerance,
  double_scale_free,
  float_precision
};

/// Calls work(policy) with the selected number policy.
template <class Work>
auto with_kernel(Kernel_choice kernel, Work&& work) {
  switch (kernel) {
    case Kernel_choice::exact:
      return work(Exact{});
    case Kernel_choice::lazy:
      return work(Lazy{});
    case Kernel_choice::rational:
      return work(Unfiltered{});
    case Kernel_choice::double_precision:
      return work(Double{});
    case Kernel_choice::double_tolerance:
      return work(Tolerant{});
    case Kernel_choice::double_scale_free:
      return work(Scale_free{});
    case Kernel_choice::float_precision:
      break;
  }
  return work(Float{});
}

/// How a motion is walked.
struct Walk_method {
  Kernel_choice kernel = Kernel_choice::exact;
  Walk_strategy strategy = Walk_strategy::certified;  ///< for other kernels than exact, exit_rule at most
};

/// As the other answer_move(), which walks by the default method. By an inexact kernel the time of a contact
/// is that of the walk, rounded.
/// \pre Touch::stop only with the exact kernel
template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, Touch touch, const Walk_method& method, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_QUERY_KERNEL_CHOICE_H
