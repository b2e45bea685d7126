// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of vertices of an environment, one after the other, for a layer that keeps the residents of the cells
// around them. Theory: docs/moving.md.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_VERTEX_MOVER_H
#define CELLWALK_INTERNAL_ENVIRONMENT_VERTEX_MOVER_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/cell_check.h>

#include <cstdint>
#include <span>
#include <vector>

namespace cellwalk::detail {

/// The reasons for which the shape of the environment alone forbids the move of a vertex.
enum class Star_defect : std::uint8_t {
  none,
  cell,     ///< a cell would be flat or inverted
  boundary  ///< the boundary of the environment would run into itself, or into another point
};

struct Star_check {
  Star_defect defect = Star_defect::none;
  Cell cell = Cell::none;  ///< that would be flat or inverted: the one that is so first
  double share = 1;        ///< of the move, rounded, at which it is flat
};

/// Moves vertices of an environment around which all cells are simplices. From the first move on, planes of
/// the cells around moved vertices certify nothing, and all is decided exactly there, until restore().
/// Nothing else reads the environment meanwhile.
template <int D>
class Vertex_mover {
 public:
  explicit Vertex_mover(Environment<D>& environment) : environment_(environment) {}
  Vertex_mover(const Vertex_mover&) = delete;
  Vertex_mover& operator=(const Vertex_mover&) = delete;
  ~Vertex_mover();

  const Snapshot<D>& snapshot() const { return *environment_.snapshot_; }

  /// \throw Error(usage) if there is no such point; Error(input) for a target that is not finite
  void check(std::uint32_t point, const Point<D>& target) const { environment_.check_move(point, target); }
  /// Looks at the cells around a point and decides whether it may move to a target, as far as the shape of
  /// the environment goes. Its whole way is looked at: no cell is flat or inverted on it, and no boundary
  /// facet at the point meets another one. Nothing is changed.
  /// \throw Error(usage) if there is no such point, or a cell around it is not a simplex; Error(input) for a
  ///        target that is not finite
  /// Cost: a sign a cell; on the boundary a comparison while the point stays in its zone, a few us for a new
  /// zone, and some 50 us or more where exact tests decide.
  Star_check begin(std::uint32_t point, const Point<D>& target);
  /// All cells around the point of begin().
  std::span<const Cell> star() const { return star_; }
  /// Its position when the move began.
  const Point<D>& from() const { return from_; }
  /// Puts the point to its target, in the snapshot only.
  /// \pre begin() found no defect
  void place();
  /// Puts it back.
  void take_back();
  /// Makes the move, after place(). Epochs rise with it.
  void commit();
  /// Makes certificates anew. If memory runs out, some stay withdrawn, and walks there slow.
  /// Cost: about 0.3 us a cell around the points moved.
  void restore();

 private:
  Star_check check_cells() const;
  bool runs_into_boundary();

  Environment<D>& environment_;
  std::uint32_t point_ = 0;
  Point<D> from_{}, target_{};
  std::vector<Cell> star_;
  bool is_on_boundary_ = false;
  std::vector<Cell> withdrawn_;     ///< cells, in any order
  std::vector<bool> is_withdrawn_;  ///< by the name of a cell
};

extern template class Vertex_mover<2>;
extern template class Vertex_mover<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_VERTEX_MOVER_H
