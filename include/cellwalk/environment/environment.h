// SPDX-License-Identifier: LGPL-3.0-or-later
// The environment: a certified convex cell complex, held as a combinatorial map (the editable truth) and
// compiled into a snapshot (what is walked). This header does not include CGAL; <cellwalk/environment/map.h>
// gives the map.
#ifndef CELLWALK_ENVIRONMENT_ENVIRONMENT_H
#define CELLWALK_ENVIRONMENT_ENVIRONMENT_H

#include <cstdint>
#include <memory>

#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/environment/split.h>
#include <cellwalk/records/cell_soup.h>

namespace cellwalk {

template <int D>
struct Map_storage;  // <cellwalk/environment/map.h>

/// What to do with points of equal coordinates that are not the same vertex.
enum class Duplicate_vertices { refuse, merge, keep };

struct Build_options {
  Duplicate_vertices duplicates = Duplicate_vertices::refuse;
  bool split = true;     ///< split cells that are not exactly convex; otherwise they are refused
  bool keep_map = true;  ///< false: freeze at once
};

/// Everything that building changed or noticed. Nothing is repaired silently.
struct Build_report {
  std::size_t cells_read = 0, points_read = 0;
  std::size_t unused_points = 0;  ///< dropped
  std::size_t merged_points = 0;  ///< duplicates merged (Duplicate_vertices::merge)
  bool flipped = false;           ///< every cell was inverted; all were flipped
  Split_report split;
  Certificate certificate;  ///< counts, volumes, components, walls
};

template <int D>
class Environment {
 public:
  /// Merges or refuses duplicate points, flips a mesh that is inverted throughout, splits cells that are not
  /// exactly convex, glues, builds the map, compiles the snapshot and certifies it. \throw Error(input) for a
  /// malformed soup, Error(not_certified) with the cell and the reason
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

  /// The cells as a soup, cell indices and walls kept: what an .ovm file holds.
  Cell_soup<D> soup() const;

  // --- edits: map and snapshot stay in step, only touched cells are recompiled.
  //     \throw Error(usage) if frozen; Error(not_certified) if the result would not be certified (nothing is
  //     changed)
  void set_impassable(Half_facet facet, bool wall);
  /// Moves a vertex; every cell of its star must stay exactly convex and positive (facets planar).
  void move_vertex(std::uint32_t point, const Point<D>& position);
  /// Splits a cell into the star of a new point strictly inside it. Returns the new cells.
  std::vector<Cell> insert_point(Cell cell, const Point<D>& position);

  /// Certifies again from scratch, map included. \throw Error(not_certified)
  Certificate certify() const;

 private:
  Environment();
  std::unique_ptr<Map_storage<D>> storage_;
  Snapshot<D> snapshot_;
};

extern template class Environment<2>;
extern template class Environment<3>;

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_ENVIRONMENT_H
