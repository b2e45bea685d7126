// SPDX-License-Identifier: LGPL-3.0-or-later
// The answers to a table of motions of edges.
#ifndef CELLWALK_CLI_QUERY_SWEEPS_H
#define CELLWALK_CLI_QUERY_SWEEPS_H

#include <cellwalk/edge/sweep.h>

#include <vector>

#include "cli/query_answers.h"

namespace cellwalk::cli {

/// Answers every motion, in parallel; the answers do not depend on the number of threads. Outside: an end is not in free
/// space, or the edge crosses a wall before it moves. A row is an edge and has no face: Sweep::faces is Sweep::triangle.
///
/// An end that stands on a wall with free space on several sides belongs to any of them: of the sides between which the
/// edge has a chain, those are taken with which the motion gets furthest by exact times, the cell of p of lowest index
/// first, then that of q. What is searched otherwise, is searched there.
/// \pre options.tolerance lies in (0,1]
/// Cost: that of locating two points, finding a chain and sweep_edge(), for each pair of sides.
template <int D>
std::vector<Answer<D>> answer_sweeps(const Snapshot<D>& snapshot, const std::vector<Sweep_query<D>>& sweeps,
                                     const Sweep_options& options, Edge_counts& counts);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_SWEEPS_H
