// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that yield to bodies that press against them, and recover. See docs/scenes.md.
#ifndef CELLWALK_INTERNAL_SIMULATION_ELASTIC_FOUNDATION_H
#define CELLWALK_INTERNAL_SIMULATION_ELASTIC_FOUNDATION_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/saved_parts.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk {

/// Each vertex of a wall hangs on a spring of its own (a Winkler foundation), and so yields by the compliance
/// times the force on it. A body that a wall held back in a step presses it like a spring of compliance 1: of
/// the rest of the motion against the wall, the wall yields by the share c/(1 + c) for its compliance c. That
/// is divided among the corners of the facet met by their weights there, and spread over their neighbours. In
/// each step a share of the yield is recovered.
/// Unconditionally stable: walls go no further than the target of the body, and a motion that something
/// blocks is no yield.
template <int D>
class Elastic_foundation {
 public:
  /// Reads where the walls are now.
  /// \param fixed vertices in these do not yield
  /// Cost: linear.
  Elastic_foundation(const Snapshot<D>& snapshot, const Soft_walls& soft,
                     std::span<const Scene_shape<D>> fixed);

  /// Recovers, and yields to the contacts of bodies in the last step of a world.
  /// \throw Error(input) naming a vertex if yields or forces are not finite
  void press(const World<D>& world);

  /// Where a vertex that yields is to be if without yielding it were elsewhere.
  Point<D> yielding(std::uint32_t point, const Point<D>& otherwise) const {
    return otherwise + yields_[point];
  }
  /// Vertices that yield now or did so in the step before, with where they are to be if the walls do not move
  /// otherwise. Ascending.
  std::vector<Vertex_move<D>> targets() const;
  /// Takes note of where walls got: the rest of their way is no yield.
  /// \param moves those that were requested
  void follow(std::span<const Vertex_move<D>> moves, const Move_report<D>& report);

  /// The yield of a vertex.
  const Vector<D>& yield(std::uint32_t point) const { return yields_[point]; }
  std::size_t yielding_count() const { return active_.size(); }
  double largest_yield() const;
  /// The sum of the sizes of the forces on all vertices.
  double force() const;

 private:
  using Increments = std::vector<std::pair<std::uint32_t, Vector<D>>>;
  void spread(Increments& increments) const;
  /// One without vertices yet.
  Elastic_foundation(const Snapshot<D>& snapshot, const Soft_walls& soft)
      : snapshot_(&snapshot), soft_(soft) {}
  /// True if all that was read refers to something.
  bool is_consistent() const;

  const Snapshot<D>* snapshot_;
  Soft_walls soft_;
  double least_yield_ = 0;
  std::vector<Point<D>> starts_;
  std::vector<Vector<D>> yields_;
  std::vector<char> may_yield_;
  std::vector<std::uint32_t> first_, neighbours_;  ///< of each point, those along its walls
  std::vector<std::uint32_t> active_;              ///< that yield, or did in the step before; ascending

  friend detail::State_access<D>;
};

extern template class Elastic_foundation<2>;
extern template class Elastic_foundation<3>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_SIMULATION_ELASTIC_FOUNDATION_H
