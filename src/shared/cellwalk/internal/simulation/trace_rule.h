// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of traces in a grid (docs/formats.md) for bodies of the library: their steps, and the answers
// to their moves.
#ifndef CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H
#define CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/trace.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// The options of steps by that rule: a vertex that hits or touches a wall stays in place. Steps
/// report the rejected moves.
/// \pre the sweep is three_segments or triangle; the latter answers bits 4 to 6 too
Body_options trace_options(Sweep sweep);

/// The answer to a rejected move.
std::uint8_t trace_answer(const Rejected_move<3>& blocked, Sweep sweep);

/// Appends the answers to the moves of one body in one step.
/// \pre the rejected moves are in the order of vertices
void append_answers(std::span<const Rejected_move<3>> blocked, Sweep sweep,
                    std::vector<std::uint8_t>& answers);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H
