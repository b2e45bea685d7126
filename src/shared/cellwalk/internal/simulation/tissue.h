// SPDX-License-Identifier: LGPL-3.0-or-later
// Solid cells as elastic tissue, which bodies press and cuts open. See docs/scenes.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_TISSUE_H
#define CELLWALK_INTERNAL_SIMULATION_TISSUE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/reshape/reshaping.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// The vertices of solid cells under the lengths of edges and the volumes of cells: extended position-based
/// dynamics (Macklin, Mueller, Chentanez 2016) with velocities from the positions that were reached. Vertices
/// of the boundary stay. Points between free cells follow those around them.
///
/// Reshaping carries its motion out as far as it is free: tissue tunnels through nothing.
template <int D>
class Tissue {
 public:
  /// Reads where the points are now: without tension they are at rest there, with tension edges are longer
  /// than they would be.
  /// \param fixed vertices in these stay
  /// \throw Error(usage) for a material whose numbers are out of the ranges of Tissue_material; Error(input)
  ///        if there is no solid cell, or one that is not a simplex
  /// Cost: that of sorting the edges.
  Tissue(const Snapshot<D>& snapshot, const Tissue_material& material, std::span<const Scene_shape<D>> fixed);

  /// Where points are to be after a step: tissue that bodies pressed in the last step of a world gives way,
  /// the rest follows. Ascending; points that hardly move are left out.
  /// \pre follow_changes() was called after changes
  /// \throw Error(usage) if it was not, and there are new points; Error(input) naming a point whose motion is
  ///        not finite
  /// Cost: about 50 ns for each sweep over an edge or a cell.
  std::vector<Vertex_move<D>> targets(const World<D>& world);
  /// Takes note of where the points got.
  void follow();
  /// Goes on with the cells as they are now, after some were cut, excavated or filled: cells that became
  /// solid are at rest where they were when the tissue was made. Where no solid cell is left, nothing moves.
  /// \param points that cuts made, in order; new points that are not among them are at rest where they are
  /// Cost: that of making it.
  void follow_changes(std::span<const Cut_point> points);

  /// The greatest ratio of the length of an edge to its length without tension. Edges of no length at rest do
  /// not count: those across a cut that was filled.
  double largest_stretch() const;
  std::size_t edge_count() const { return edges_.size(); }

 private:
  struct Edge {
    std::array<std::uint32_t, 2> ends;
    double rest;
  };
  struct Simplex {
    std::array<std::uint32_t, static_cast<std::size_t>(D) + 1> corners;
    double rest;  ///< D! times its volume
  };
  /// One without cells yet.
  Tissue(const Snapshot<D>& snapshot, const Tissue_material& material)
      : snapshot_(&snapshot), material_(material) {}
  /// True if all that was read refers to something.
  bool is_consistent() const;

  void find_constraints();
  void find_followers();
  void keep_lengths();
  void keep_volumes();
  void drag_followers();

  const Snapshot<D>* snapshot_;
  Tissue_material material_;
  std::vector<Scene_shape<D>> fixed_;
  double least_move_ = 0;
  std::vector<Point<D>> rest_;    ///< of each point, under tension
  std::vector<Point<D>> before_;  ///< where it was when targets() began
  std::vector<Point<D>> wanted_;
  std::vector<Vector<D>> velocities_;  ///< lengths a step
  std::vector<char> may_move_;         ///< vertices of solid cells that nothing holds
  std::vector<Edge> edges_;
  std::vector<double> multipliers_;  ///< of edges
  std::vector<Simplex> simplices_;
  std::vector<std::uint32_t> followers_;
  std::vector<std::uint32_t> first_, neighbours_;  ///< of each follower

  friend detail::State_access<D>;
};

extern template class Tissue<2>;
extern template class Tissue<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_TISSUE_H
