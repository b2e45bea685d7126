// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment: a certified convex cell complex, held as a combinatorial map (the editable truth) and
// compiled into a snapshot (what is walked). This header does not include CGAL; <cellwalk/environment/map.h>
// gives the map.
#ifndef CELLWALK_ENVIRONMENT_ENVIRONMENT_H
#define CELLWALK_ENVIRONMENT_ENVIRONMENT_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/environment/split.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace cellwalk {

template <int D>
struct Map_storage;  // <cellwalk/environment/map.h>

namespace detail {
template <int D>
class Boundary_index;
}

/// What to do with points of equal coordinates that are not the same vertex.
enum class Duplicate_vertices { refuse, merge, keep };

struct Build_options {
  Duplicate_vertices duplicates = Duplicate_vertices::refuse;
  bool split = true;     ///< split cells that are not exactly convex; otherwise they are refused
  bool keep_map = true;  ///< false: build no map at all; the environment is frozen from the start
};

/// Everything that building changed or noticed. Nothing is repaired silently.
struct Build_report {
  std::size_t cells_read = 0, points_read = 0;
  std::size_t unused_points = 0;  ///< dropped
  std::size_t merged_points = 0;  ///< duplicates merged (Duplicate_vertices::merge)
  bool flipped = false;           ///< every cell was inverted; all were flipped
  Split_report split;
  std::vector<std::uint32_t>
      origin;               ///< input cell of each cell, if cells were split; otherwise empty: the same
  Certificate certificate;  ///< counts, volumes, components, walls
};

/// A certified cell complex. Cells are named by Snapshot's Cell; their indices are those of the soup (after a split, of
/// the split soup), and point indices those of the soup less the points that were dropped.
template <int D>
class Environment {
 public:
  /// Drops unused points, merges or refuses duplicate ones, flips a mesh that is inverted throughout, splits cells that
  /// are not exactly convex, glues, builds the map, compiles the snapshot from it and certifies that.
  /// Facets on the boundary and between solid and free cells become impassable. `report` is filled as far as building
  /// got, also if it throws.
  /// \throw Error(input) for a malformed soup, Error(not_certified) with the cell and the reason
  /// Cost: about 2.5 us a tetrahedron on two cores (1.6 us without the map), up to twice that if cells and
  /// points come in random order.
  static Environment build(Cell_soup<D> soup, const Build_options& options = {},
                           Build_report* report = nullptr);

  Environment(Environment&&) noexcept;
  Environment& operator=(Environment&&) noexcept;
  ~Environment();

  const Snapshot<D>& snapshot() const { return snapshot_; }

  /// The map and the dart of each half-facet. \throw Error(usage) once frozen
  const Map_storage<D>& storage() const;
  bool is_frozen() const { return !storage_; }
  /// Drops the map: the environment can be walked but no longer edited.
  void freeze();

  /// The cells as a soup, cell indices and walls kept: what an .ovm file holds. Cost: linear.
  Cell_soup<D> soup() const;

  // Edits keep map and snapshot in step; only touched cells are recompiled. They change nothing if they throw an Error:
  // Error(usage) if frozen, or for a facet, point or cell that is not there; Error(input) for a position that is not
  // finite; Error(not_certified) if the result would not be certified, with the reason.
  //
  // They ask nobody: what moves in the environment does not know of them, nor they of it. Each that changes anything raises
  // Snapshot::epoch(), and a Body that was registered before throws Error(usage) until Body::register_again(). Particles of one's
  // own must be located again after move_vertex and insert_point. Not to be called while anything moves.

  /// Makes a facet impassable, or passable: not on the boundary, nor between a solid and a free cell.
  /// Cost: constant.
  void set_impassable(Half_facet facet, bool wall);

  /// Moves a vertex. Every cell that has it must stay exactly convex and positive, its facets exactly planar. What counts is
  /// where it ends: a vertex on the boundary may go there through other cells of the environment. Names of cells and facets stay;
  /// the loop of a facet may start at another vertex.
  /// Cost: that of the cells around it (about 2 us each); on the boundary that of the boundary facets near them too, the first
  /// time a look at all facets.
  void move_vertex(std::uint32_t point, const Point<D>& position);

  /// Splits a cell into the star of a new point strictly inside it: one cell a facet, the first of which takes the index
  /// of the old cell, the others new indices. Returns them. Names of other cells and facets stay; that of the old cell is gone,
  /// and later edits may give it to another.
  /// Cost: constant.
  std::vector<Cell> insert_point(Cell cell, const Point<D>& position);

  /// Certifies again from scratch: the map, the snapshot, and that they agree.
  /// \throw Error(not_certified); Error(other) if map and snapshot disagree
  Certificate certify() const;

 private:
  Environment();
  Map_storage<D>& editable();
  void check_half_facet(Half_facet facet) const;
  void check_cell_name(Cell cell) const;
  void check_moved_star(std::uint32_t point, const std::vector<Cell>& star, bool on_boundary) const;
  void check_moved_boundary(std::uint32_t point, const std::vector<Cell>& star) const;

  std::unique_ptr<Map_storage<D>> storage_;
  Snapshot<D> snapshot_;
  std::unique_ptr<detail::Boundary_index<D>>
      boundary_;  ///< made when a vertex of the boundary moves for the first time
  bool allow_duplicates_ = false;
};

extern template class Environment<2>;
extern template class Environment<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_ENVIRONMENT_H
