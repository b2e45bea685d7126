// SPDX-License-Identifier: LGPL-3.0-or-later
// Queries of motions of points without a known cell: the point is located, and then walked.
#ifndef CELLWALK_QUERY_MOVE_H
#define CELLWALK_QUERY_MOVE_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/query/answer.h>
#include <cellwalk/walk/locate.h>

namespace cellwalk {

enum class Kernel_choice {
  exact,
  lazy,
  rational,
  double_precision,
  double_tolerance_9,
  double_tolerance_6,
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
    case Kernel_choice::double_tolerance_9:
      return work(Tolerant<9>{});
    case Kernel_choice::double_tolerance_6:
      return work(Tolerant<6>{});
    case Kernel_choice::float_precision:
      break;
  }
  return work(Float{});
}

struct Move_options {
  Kernel_choice kernel = Kernel_choice::exact;
  Walk_strategy strategy = Walk_strategy::certified;  ///< for other kernels than exact, exit_rule at most
  Touch touch = Touch::pass;
};

/// Answers a motion from one point to another. A start on a wall with free space on several sides may belong
/// to each of them: the side on which the motion gets furthest is chosen, in ties the one with the cell of
/// lowest index. With an exact kernel the time of a contact is exact; otherwise it is that of the walk,
/// rounded.
/// \param snapshot of the environment
/// \param locator finds the cells of the start
/// \param from,to the ends of the motion, finite
/// \param options the kernel, the strategy and the rule for touches
/// \param counts raised by the query
/// \pre the locator is that of the snapshot; Touch::stop only with the exact kernel
/// \throw Error(input) for a point that is not finite; Error(usage) as Locator::locate()
/// Cost: that of locating the start and of the walk, for each side. Thread-safe, if each thread has its own
/// counts.
template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, const Move_options& options, Edge_counts& counts);

}  // namespace cellwalk

#endif  // CELLWALK_QUERY_MOVE_H
