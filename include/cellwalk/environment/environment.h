// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment: a certified convex cell complex, stored as a combinatorial map (for edits) and compiled
// into a snapshot (for walks). This header does not include CGAL; <cellwalk/environment/map.h> gives access
// to the map.
#ifndef CELLWALK_ENVIRONMENT_ENVIRONMENT_H
#define CELLWALK_ENVIRONMENT_ENVIRONMENT_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/held_snapshot.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/cell_soup.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk {

template <int D>
struct Map_storage;  // <cellwalk/environment/map.h>

namespace detail {
template <int D>
class Boundary_index;
template <int D>
class Cell_patcher;
template <int D>
class Environment_image;
template <int D>
class Star_index;
template <int D>
class Vertex_mover;
template <int D>
class Wall_editor;
}  // namespace detail

/// The treatment of different points with equal coordinates. Boundary facets of free cells that overlap in
/// a plane (Facing_walls) are refused as well, unless duplicates are kept: the walls there are unintended.
enum class Duplicate_vertices { refuse, merge, keep };

struct Build_options {
  Duplicate_vertices duplicates = Duplicate_vertices::refuse;
  bool split = true;  ///< split cells that are not exactly convex; otherwise they are refused
  /// Split all cells that are not tetrahedra (2D: triangles), as walls that move among bodies need. Implies
  /// `split`.
  bool simplicial = false;
  bool keep_map = true;  ///< false: build no map; the environment is frozen until thaw()
};

/// Everything that building changed. Nothing is repaired silently.
struct Build_report {
  std::size_t cells_read = 0, points_read = 0;
  std::size_t unused_points = 0;  ///< dropped
  std::size_t merged_points = 0;  ///< duplicates merged (Duplicate_vertices::merge)
  bool flipped = false;           ///< every cell was inverted; all were flipped
  Split_report split;
  /// Input cell of each cell if cells were split; otherwise empty (unchanged).
  std::vector<std::uint32_t> origin;
  Certificate certificate;  ///< counts, volumes, components, walls
  /// Walls between free cells that nothing parts; cells by their index in the input.
  Facing_walls facing;
};

/// The new names of an environment that was compacted.
struct Compaction {
  static constexpr std::uint32_t none = 0xffffffffu;

  std::vector<std::uint32_t> points;    ///< by the old index; `none` for those that no cell had
  std::vector<Cell> cells;              ///< by the old name; Cell::none for names that no cell had
  std::vector<Half_facet> half_facets;  ///< by the old name; Half_facet::none for slots without a facet
};

/// A certified cell complex. Cells are identified by Snapshot's Cell. Their indices are those of the soup
/// (after a split, of the split soup); point indices are those of the soup without the dropped points.
///
/// It can be moved, in a struct or a vector with all that lies in it: the snapshot stays where it is, so that
/// bodies, particles and locators go on. An environment that was moved from throws Error(usage), but can be
/// assigned to. No Reshaping of it may be open. Assigning to an environment ends it, as its destructor does.
template <int D>
class Environment {
 public:
  /// Drops unused points, merges or refuses duplicate ones, flips a mesh whose cells are all inverted, splits
  /// cells that are not exactly convex, glues, builds the map, compiles the snapshot from it and certifies
  /// that. Facets on the boundary and between solid and free cells become impassable. If building fails,
  /// `report` is filled up to the point of failure.
  /// \param report if not null, receives all changes and the counts
  /// \throw Error(input) for a malformed soup, Error(not_certified) with the cell and the reason
  /// Cost: about 2.5 us a tetrahedron on two cores (1.6 us without the map), up to twice as much if cells and
  /// points are in random order.
  static Environment build(Cell_soup<D> soup, const Build_options& options = {},
                           Build_report* report = nullptr);

  Environment(Environment&&) noexcept;
  Environment& operator=(Environment&&) noexcept;
  ~Environment();

  /// Lives as long as the environment, wherever that is moved: not beyond the statement of a temporary one.
  const Snapshot<D>& snapshot() const& { return *snapshot_; }
  const Snapshot<D>& snapshot() const&& = delete;

  /// The map and the dart of each half-facet.
  /// \throw Error(usage) once frozen
  const Map_storage<D>& storage() const&;
  const Map_storage<D>& storage() const&& = delete;
  bool is_frozen() const { return !storage_; }
  /// Drops the map: vertices can still be moved, but no facet be opened or closed, no cell be filled or
  /// excavated, and no point inserted.
  void freeze();
  /// Builds the map again from the snapshot, which stays as it is, with all names: functions that refused a
  /// frozen environment work from then on. Does nothing unless it is frozen.
  /// \throw Error(input) for 2^29 half-facets or more, with nothing changed
  /// Cost: about 1 us a tetrahedron; memory 681 bytes a tetrahedron.
  void thaw();

  /// Gives back the memory that edits left behind, and puts cells that they added beside their neighbours, as
  /// if the environment had just been built: all indices and names in use, in order. Cells and points keep
  /// their order; geometry and walls stay. For long runs of edits: without it, later edits reuse the memory
  /// that earlier ones left. With or without the map. It is an edit: bodies go on after
  /// Body::register_again(), particles are located again, and a Locator is made anew. Until the next
  /// compaction the new names are kept for bodies, in 20 bytes a tetrahedron.
  /// \throw Error(input) for 2^29 half-facets or more, with nothing changed
  /// Cost: linear, about as much as building; for a moment, the memory of both.
  Compaction compact();

  /// All cells that have a point, solid ones too; of a pinched point part after part. Works without the map.
  /// \throw Error(usage) if there is no such point
  /// Cost: that of the cells found; the first time about 1 us for each point of the environment.
  std::vector<Cell> cells_around(std::uint32_t point);

  /// The cells as a soup, with their indices and walls: the content of an .ovm file.
  /// Cost: linear.
  Cell_soup<D> soup() const;

  // Edits change map and snapshot consistently; only affected cells are recompiled. An edit that throws
  // changes nothing. It throws Error(usage) if the environment is frozen, unless a vertex moves, or for a
  // facet, point or cell that does not exist; Error(input) for a position that is not finite;
  // Error(not_certified), with the reason, if the result would not be certified.
  //
  // Edits ignore objects that move in the environment. Each edit that changes anything raises
  // Snapshot::epoch(), and a Body that was registered before throws Error(usage) until
  // Body::register_again(). Locate your own particles again after move_vertex and insert_point. Do not edit
  // while anything moves.

  /// Makes a facet impassable or passable. Facets of the boundary, and between a solid and a free cell,
  /// cannot be made passable.
  /// \param wall true: impassable
  /// Cost: constant.
  void set_impassable(Half_facet facet, bool wall);

  /// Makes a solid cell free: its facets to free cells become passable, those to solid ones walls. A cell
  /// that is free already stays as it is.
  /// Cost: constant.
  void excavate(Cell cell);
  /// Makes a free cell solid: its facets to free cells become walls. A cell that is solid already stays as it
  /// is. The residents of the cell are not looked at: see Reshaping for that.
  /// Cost: constant.
  void fill(Cell cell);

  /// Moves a vertex. Every cell of its star must stay exactly convex and positive, with exactly planar
  /// facets. Only the end position is checked: the path of a boundary vertex may lead through other cells.
  /// Names of cells and facets are kept; the loop of a facet may start at another vertex. Works without the
  /// map. Bodies and particles are not looked at: see Reshaping for that.
  /// Cost: about 2 us for each cell around the vertex; on the boundary also the cost of the boundary facets
  /// near them; the first time linear in the number of facets, as where it goes far out of all others.
  void move_vertex(std::uint32_t point, const Point<D>& position);

  /// Splits a cell into the star of a new point strictly inside it, with one cell for each facet. Returns the
  /// new cells; the first takes the index of the old cell, the others new indices. Names of other cells and
  /// facets are kept. The name of the old cell becomes invalid, and later edits may reuse it.
  /// Cost: constant.
  std::vector<Cell> insert_point(Cell cell, const Point<D>& position);

  /// Lets its user change the map by any operations of CGAL, and certifies the result. If that is refused, or
  /// the user's function throws, nothing has changed, but darts are new: find them by storage() again.
  ///
  /// Where CGAL makes darts, they belong to free cells and passable facets: a facet is a wall if any of its
  /// darts is marked so, on the boundary, and between a solid and a free cell; a cell is solid if any of its
  /// darts is. Vertices may move. Facets that are not sewn are walls. Cells that stay as they are keep their
  /// order, as do points; others follow. Defined, with a function that marks facets, in
  /// <cellwalk/environment/map_edit.h>.
  /// Bodies that go on are registered again after each edit(): of new names only the last ones are kept.
  /// \param change called with a Map<D>&
  /// \pre `change` does not edit the environment in another way, nor freeze it
  /// \return the new names of what stays, for all names change
  /// \throw Error(not_certified) with the place or the cell, by its index in the edited map; Error(usage) if
  ///        the environment is frozen; what the user's function throws
  /// Cost: linear: that of building, about 4 us a tetrahedron; for a moment, the memory of two snapshots.
  template <class Change>
  Compaction edit(Change&& change);

  /// Certifies again from scratch: the map, the snapshot, and that they agree.
  /// \param facing as in cellwalk::certify()
  /// \throw Error(not_certified); Error(other) if map and snapshot disagree
  Certificate certify(Facing_walls* facing = nullptr) const;

 private:
  Environment();
  Map_storage<D>& editable();
  Compaction edit_storage(const std::function<void(Map_storage<D>&)>& change);
  void check_half_facet(Half_facet facet) const;
  void check_cell_name(Cell cell) const;
  void check_moved_star(std::uint32_t point, const std::vector<Cell>& star, bool may_overlap) const;
  void check_moved_boundary(std::uint32_t point, const std::vector<Cell>& star) const;
  void check_point(std::uint32_t point) const;
  void check_move(std::uint32_t point, const Point<D>& position) const;
  bool is_on_boundary(std::uint32_t point, const std::vector<Cell>& star) const;
  detail::Star_index<D>& stars();
  detail::Boundary_index<D>& boundary();
  void follow_move(std::uint32_t point, bool on_boundary);

  std::unique_ptr<Map_storage<D>> storage_;
  detail::Held_snapshot<D> snapshot_;
  /// Built when a vertex of the boundary first moves.
  std::unique_ptr<detail::Boundary_index<D>> boundary_;
  /// Built when a vertex first moves.
  std::unique_ptr<detail::Star_index<D>> stars_;
  bool allow_duplicates_ = false;

  friend detail::Cell_patcher<D>;
  friend detail::Environment_image<D>;
  friend detail::Vertex_mover<D>;
  friend detail::Wall_editor<D>;
};

extern template class Environment<2>;
extern template class Environment<3>;

/// The value held, such as the environment of an import, if it has dimension D.
/// \throw Error(input) if it has the other dimension
template <int D, template <int> class Kind>
const Kind<D>& of_dimension(const std::variant<Kind<2>, Kind<3>>& any) {
  if (const Kind<D>* held = std::get_if<Kind<D>>(&any)) return *held;
  throw Error(Error_code::input, "this has dimension " + std::to_string(5 - D) + ", where " +
                                     std::to_string(D) + " is expected: give one of that dimension");
}
template <int D, template <int> class Kind>
Kind<D>& of_dimension(std::variant<Kind<2>, Kind<3>>& any) {
  return const_cast<Kind<D>&>(of_dimension<D>(std::as_const(any)));
}
/// The same of a temporary, which is moved from.
template <int D, template <int> class Kind>
Kind<D> of_dimension(std::variant<Kind<2>, Kind<3>>&& any) {
  return std::move(of_dimension<D>(any));
}

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_ENVIRONMENT_H
