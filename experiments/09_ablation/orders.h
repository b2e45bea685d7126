// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges both ends of which move: one end after the other, in either order, and both at the same time.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_ORDERS_H
#define CELLWALK_EXPERIMENTS_ABLATION_ORDERS_H

#include <array>
#include <cstdint>
#include <string>

namespace cellwalk::ablation {

/// How the ends move.
enum class Motion_kind {
  shift,       ///< both alike
  turn,        ///< against each other
  independent  ///< each in a direction of its own
};
inline constexpr std::array motion_names{"shift", "turn", "independent"};

/// One row. Lengths in cubes.
struct Order_setting {
  std::string world;   ///< "boxes", one in each cube, or "cubes", some of which are solid
  double size = 0.25;  ///< of a box
  Motion_kind motion = Motion_kind::shift;
  double edge = 0.5;
  double step_over_edge = 1;
  std::uint64_t seed = 1;
  std::uint64_t draws = 0;  ///< motions drawn; those of edges that meet a wall at the start are not made
};

struct Order_tally {
  std::uint64_t made = 0;
  std::uint64_t together = 0;                         ///< blocked if both ends move at the same time
  std::uint64_t p_first = 0, q_first = 0;             ///< blocked if they move one after the other
  std::uint64_t together_only = 0, p_first_only = 0;  ///< of together and p_first, blocked by one of them
  std::uint64_t orders_differ = 0;                    ///< blocked by one order only
  std::uint64_t any_order_only = 0;                   ///< blocked by both orders, free together
  std::uint64_t no_order = 0;                         ///< free by both orders, blocked together
  std::uint64_t wrong = 0;                            ///< sweeps of one end that the judge answers otherwise
  std::uint64_t undecided = 0;                        ///< by the judge
};

/// Draws the motions of a row and makes each in all ways.
/// Cost: some 0.1 ms a motion.
Order_tally run_orders(const Order_setting& setting);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_ORDERS_H
