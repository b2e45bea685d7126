// SPDX-License-Identifier: LGPL-3.0-or-later
// The rule of traces in a grid, docs/formats.md, for bodies of the library: how they are moved, and the answers to that.
#ifndef CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H
#define CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H

#include <cellwalk/body/body.h>
#include <cellwalk/internal/records/trace.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// Steps by that rule: what hits a wall, or touches one, stays. They report what blocks.
/// \pre three_segments or triangle: with the latter, bits 4 to 6 are answered too
Body_options trace_options(Sweep sweep);

/// The answer to a move of which this is reported.
std::uint8_t trace_answer(const Rejected_move<3>& blocked, Sweep sweep);

/// Appends the answers to the moves of one body in one step. \pre what blocks was reported, vertex by vertex
void append_answers(std::span<const Rejected_move<3>> blocked, Sweep sweep,
                    std::vector<std::uint8_t>& answers);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TRACE_RULE_H
