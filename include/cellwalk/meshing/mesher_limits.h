// SPDX-License-Identifier: GPL-3.0-or-later
// How long a mesher may run. TetGen and Mesh_3 run in processes of their own, so that their crashes are
// errors.
#ifndef CELLWALK_MESHING_MESHER_LIMITS_H
#define CELLWALK_MESHING_MESHER_LIMITS_H

#include <functional>

namespace cellwalk {

struct Mesher_limits {
  /// The longest that a mesher may take, greater than 0. TetGen may run several times in it, with finer and
  /// finer tolerances.
  double seconds = 600;
  /// Called at least every tenth of a second while a mesher runs. An exception that it throws ends the mesher
  /// and passes through.
  std::function<void()> on_wait{};
};

}  // namespace cellwalk

#endif  // CELLWALK_MESHING_MESHER_LIMITS_H
