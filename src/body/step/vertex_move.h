// SPDX-License-Identifier: LGPL-3.0-or-later
// The move of one vertex with all that it sweeps, and steps of such moves.
#ifndef CELLWALK_BODY_STEP_VERTEX_MOVE_H
#define CELLWALK_BODY_STEP_VERTEX_MOVE_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/body_state.h"

namespace cellwalk::detail {

/// Moves a vertex to a target, or leaves everything as it is and returns the first contact; with `any` set
/// some contact, which need not have a place.
template <int D>
std::optional<Contact<D>> try_move(Body_state<D>& body, Move_scratch<D>& scratch, std::uint32_t vertex,
                                   const Point<D>& target, const Sweep_options& options, Body_counts& counts,
                                   bool any = false);

/// Only looks for it. If there is none, the scratch holds all that the move needs to be made, and `to` the
/// vertex at its target.
template <int D>
std::optional<Contact<D>> find_contact(Body_state<D>& body, Move_scratch<D>& scratch, std::uint32_t vertex,
                                       const Point<D>& target, const Sweep_options& options,
                                       Body_counts& counts, bool any, Particle<D>& to);

/// Moves a vertex towards a target by Step_rule::slide or reject: it stops at walls, and goes on along them.
template <int D>
void move_along_walls(Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                      const Body_options& options, std::vector<Contact<D>>& contacts, Body_counts& counts);

/// Moves vertex by vertex by these rules, those that the region holds without a test.
template <int D>
void move_each(Body_state<D>& body, std::span<const Point<D>> targets, const Body_options& options,
               std::vector<Contact<D>>& contacts, Body_counts& counts);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_STEP_VERTEX_MOVE_H
