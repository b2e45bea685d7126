// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers to a table of motions of particles.
#ifndef CELLWALK_CLI_QUERY_MOVES_H
#define CELLWALK_CLI_QUERY_MOVES_H

#include <cellwalk/edge/sweep.h>

#include <initializer_list>
#include <utility>
#include <vector>

#include "cli/query_answers.h"

namespace cellwalk::cli {

enum class Kernel_choice {
  exact,
  lazy,
  rational,
  double_precision,
  double_tolerance_9,
  double_tolerance_6,
  float_precision
};

/// The words of --kernel and --strategy, here and in records of motions.
inline constexpr std::initializer_list<std::pair<const char*, Kernel_choice>> kernel_words{
    {"exact", Kernel_choice::exact},
    {"lazy", Kernel_choice::lazy},
    {"rational", Kernel_choice::rational},
    {"double", Kernel_choice::double_precision},
    {"double_1e-9", Kernel_choice::double_tolerance_9},
    {"double_1e-6", Kernel_choice::double_tolerance_6},
    {"float", Kernel_choice::float_precision}};
inline constexpr std::initializer_list<std::pair<const char*, Walk_strategy>> strategy_words{
    {"certified", Walk_strategy::certified},
    {"exit_rule", Walk_strategy::exit_rule},
    {"predictive_simplex", Walk_strategy::predictive_simplex}};

/// Calls work(policy) with the number policy that a word stands for.
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
  Walk_strategy strategy = Walk_strategy::certified;
  Touch touch = Touch::pass;
};

/// Answers every motion, in parallel; the answers do not depend on the number of threads.
/// A start on a wall with free space on several sides belongs to any of them: the side on which the motion gets furthest
/// is taken, the cell of lowest index first.
/// \pre Touch::stop only with the exact kernel
template <int D>
std::vector<Answer<D>> answer_moves(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& moves,
                                    const Move_options& options, Edge_counts& counts);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_MOVES_H
