// SPDX-License-Identifier: LGPL-3.0-or-later
// When an object first meets closed walls, by brute force over all of them in rational numbers.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_TOUCH_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_TOUCH_H

#include <cellwalk/internal/edge/sweep_along.h>

#include <optional>
#include <span>

#include "case.h"

namespace cellwalk::corpus {

/// True if the closed object meets a wall where it stands.
template <int D>
bool meets_walls(const World<D>& world, std::span<const Point<D>> points);

/// The infimum of the times at which a wall meets a point of the object that was not in it at the start of a
/// move, or the moving vertex elsewhere than at its start.
/// \pre at most three points; three meet no wall before they move
template <int D>
std::optional<Rational> first_touch(const World<D>& world, std::span<const Point<D>> points,
                                    const Move<D>& move);

/// The first time at which walls at a vertex that moves meet what stands still.
/// \pre two points, which meet no wall before it moves
template <int D>
std::optional<Rational> first_touch_of_walls(const World<D>& world, std::span<const Point<D>> points,
                                             const Move<D>& move);

/// What the object meets at a time of a move.
template <int D>
Meeting meeting(const World<D>& world, const Case<D>& c, std::uint32_t move, const Rational& time);

/// Sets `at_start`, and `touch` to the first touch or crossing of all moves.
/// \pre the crossings are known
template <int D>
void find_touch(const World<D>& world, Case<D>& c);

/// A name for what is degenerate, as far as walls tell.
/// \pre all else is known
template <int D>
std::string degeneracy(const World<D>& world, const Case<D>& c);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_TOUCH_H
