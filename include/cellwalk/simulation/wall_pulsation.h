// SPDX-License-Identifier: LGPL-3.0-or-later
// The periodic motion of the walls of a scene: where each point of its environment is to be. See
// docs/scenes.md.
#ifndef CELLWALK_SIMULATION_WALL_PULSATION_H
#define CELLWALK_SIMULATION_WALL_PULSATION_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/records/scene.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// A wall vertex goes to and fro along its normal, the mean of those of the walls around it weighted by their
/// sizes. Points between walls follow smoothly, so that cells keep their shapes; parts of the scene that are
/// fixed, and points on the boundary of the environment that belong to solid cells only, stay. Toward the
/// fixed parts, the motion fades over ten amplitudes; it also grows from nothing during the first period.
/// Positions are those of the start, moved: they do not drift, whatever walls have met.
///
/// At time t, a point x with the direction d moves by A min(1, t/T) sin(2 pi (t/T - x.w/w.w)) d, for the
/// amplitude A, the period T and the wave w.
template <int D>
class Wall_pulsation {
 public:
  /// Reads where the walls are now.
  /// Cost: linear, about 10 us a point.
  Wall_pulsation(const Snapshot<D>& snapshot, const Pulsation<D>& pulsation,
                 std::span<const Scene_shape<D>> fixed);

  /// Where the points that move are to be at a time.
  /// Cost: linear in their number.
  std::vector<Vertex_move<D>> targets(double time) const;

 private:
  struct Mover {
    std::uint32_t point;
    Point<D> start;
    Vector<D> direction;  ///< of length 1 at walls, less between them
  };
  Pulsation<D> pulsation_;
  std::vector<Mover> movers_;
};

extern template class Wall_pulsation<2>;
extern template class Wall_pulsation<3>;

}  // namespace cellwalk

#endif  // CELLWALK_SIMULATION_WALL_PULSATION_H
