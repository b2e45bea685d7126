// SPDX-License-Identifier: LGPL-3.0-or-later
// Better places for points between walls. Doubles choose here; nothing is decided by them.
#ifndef CELLWALK_SIMULATION_WALLS_STAR_SMOOTHER_H
#define CELLWALK_SIMULATION_WALLS_STAR_SMOOTHER_H

#include <cellwalk/environment/snapshot.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// The quality of a simplex is 1 if it is regular, 0 if it is flat, and negative if it is inverted:
/// 6 sqrt(2) V / l^3 in 3D, 4 A / (sqrt(3) l^2) in 2D, for the volume V, the area A and the quadratic mean l
/// of its edges.
template <int D>
class Star_smoother {
 public:
  /// \param may_move per point. Points of cells that are no simplices do not move.
  Star_smoother(const Snapshot<D>& snapshot, std::vector<char> may_move);

  /// Moves points, one after the other in turns, so that the least quality around each of them grows. Points
  /// at which it is at least `floor` stay.
  /// \return per point: whether it moved
  /// Cost: about 5 us a point and sweep, for points below the floor only.
  std::vector<char> smooth(std::vector<Point<D>>& places, int sweeps, double floor) const;

  /// The least quality of all simplices.
  double least_quality(const std::vector<Point<D>>& places) const;

 private:
  using Simplex = std::array<std::uint32_t, D + 1>;  ///< in positive order

  /// With point `moved` at x.
  double quality(const Simplex& simplex, const std::vector<Point<D>>& places, std::uint32_t moved,
                 const Point<D>& x) const;
  /// The least of those around a point at x, and the simplex that has it.
  double least_at(std::uint32_t point, const Point<D>& x, const std::vector<Point<D>>& places,
                  std::uint32_t* worst = nullptr) const;
  bool improve(std::uint32_t point, std::vector<Point<D>>& places, double floor) const;

  std::vector<Simplex> simplices_;
  std::vector<std::size_t> first_;     ///< of the simplices around each point
  std::vector<std::uint32_t> around_;  ///< the simplices around points
  std::vector<char> may_move_;
};

extern template class Star_smoother<2>;
extern template class Star_smoother<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_WALLS_STAR_SMOOTHER_H
