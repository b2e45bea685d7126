// SPDX-License-Identifier: LGPL-3.0-or-later
// The periodic motion of the walls of a scene: where each point of its environment is to be. See
// docs/scenes.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_WALL_PULSATION_H
#define CELLWALK_INTERNAL_SIMULATION_WALL_PULSATION_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// A wall vertex goes to and fro along its normal, the mean of the normals of the walls around it, weighted
/// by their sizes. Points between walls follow smoothly, so that cells keep their shapes; parts of the scene
/// that are fixed, and points on the boundary of the environment that belong to solid cells only, stay.
/// Toward the fixed parts, the motion fades over ten amplitudes; it also grows from nothing during the first
/// period. Positions are those of the start, moved: they do not drift, whatever walls have met.
///
/// With Pulsation::even, the normals are evened out along the walls before, so that walls beside each other
/// go alike and flat cells across edges of a wall are not inverted. With Pulsation::smooth, points between
/// walls go on parabolas instead, through three places at which the least quality of the cells around them is
/// better: those for no motion and for a way of A and of -A. They are at the first of these from the first
/// step on. The quality is that of docs/moving.md, in doubles; whether cells stay positive on the way is
/// decided by Reshaping, as always.
///
/// At time t, a point x with the direction d moves by A min(1, t/T) sin(2 pi (t/T - x.w/w.w)) d, for the
/// amplitude A, the period T and the wave w.
template <int D>
class Wall_pulsation {
 public:
  /// Reads where the walls are now.
  /// Cost: linear, about 10 us a point; with smoothing three times 5 us a sweep more for points at cells
  /// below the floor.
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
    Vector<D> bend;       ///< added at the ends of the motion
  };
  /// One that moves nothing yet.
  explicit Wall_pulsation(const Pulsation<D>& pulsation) : pulsation_(pulsation) {}
  void smooth_inside(const Snapshot<D>& snapshot, std::vector<char> may_move,
                     const std::vector<Vector<D>>& directions);

  Pulsation<D> pulsation_;
  std::vector<Mover> movers_;

  friend detail::State_access<D>;
};

extern template class Wall_pulsation<2>;
extern template class Wall_pulsation<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_WALL_PULSATION_H
