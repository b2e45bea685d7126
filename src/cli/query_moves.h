// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers to a table of motions of particles.
#ifndef CELLWALK_CLI_QUERY_MOVES_H
#define CELLWALK_CLI_QUERY_MOVES_H

#include <cellwalk/edge/sweep.h>

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
