// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact walk of a particle from cell to cell. Paper: section II; rule: docs/walk.md.
#ifndef CELLWALK_WALK_WALK_H
#define CELLWALK_WALK_WALK_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/exact.h>
#include <cellwalk/walk/contact.h>
#include <cellwalk/walk/locate.h>

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cellwalk {

/// The place at which a motion leaves a cell.
struct Cell_exit {
  Half_facet facet = Half_facet::none;  ///< inside a facet; none at a ridge or vertex
  std::uint32_t u = 0, v = 0;           ///< there: the points of ridge uv (3D), or vertex u = v
};

/// The vectors are written during the call only.
struct Walk_options {
  /// If set, the cells entered are appended, the first one included.
  std::vector<Cell>* visited = nullptr;
  /// If set, the passable facets crossed are appended, each seen from the cell that the motion leaves. At a
  /// ridge or vertex these are all facets on the path through its star.
  std::vector<Half_facet>* crossed = nullptr;
  /// If false, the time, point and normal of a contact are 0 until locate_contact() computes them.
  bool locates_contact = true;
  /// If set, the exit of each visited cell is appended, that of the last one only if a wall blocks it. A
  /// motion that ends in a cell has no exit from it.
  std::vector<Cell_exit>* exits = nullptr;
};

/// The counts of walks. They are machine-independent.
struct Walk_counts {
  std::uint64_t walks = 0;
  std::uint64_t stays = 0;            ///< walks that ended in their first cell
  std::uint64_t crossings = 0;        ///< facets, ridges and vertices passed
  std::uint64_t plane_blocks = 0;     ///< blocks of four planes evaluated
  std::uint64_t uncertain_lanes = 0;  ///< planes that left a sign undecided
  std::uint64_t side_tests = 0;       ///< exact signs of a point with respect to a facet
  std::uint64_t along_tests = 0;      ///< exact signs of the line with respect to a ridge
  std::uint64_t turns = 0;            ///< steps from facet to facet (predictive_simplex)
  std::uint64_t star_searches = 0;    ///< exits through a ridge or vertex
  std::uint64_t star_cells = 0;       ///< cells visited by these searches
  Predicate_counts predicates;

  static constexpr std::array<std::string_view, 10> names{
      "walks",      "stays",       "crossings", "plane_blocks",  "uncertain_lanes",
      "side_tests", "along_tests", "turns",     "star_searches", "star_cells"};
};
static_assert(names_all_before<Walk_counts>(offsetof(Walk_counts, predicates)));

enum class Walk_status {
  arrived,  ///< the target lies in the closure of `cell`
  contact,  ///< the motion cannot be continued into free space at contact.time
  lost      ///< inexact policies only: the walk did not end, or no exit was found
};

template <int D>
struct Walk_result {
  Walk_status status = Walk_status::arrived;
  Cell cell = Cell::none;       ///< last cell
  std::uint16_t dimension = D;  ///< of the lowest cell of the complex that contains the target, if arrived
  std::uint16_t aimed = 0;      ///< the facet of the last cell at which the motion aims
  std::uint32_t cells = 1;      ///< cells visited
  bool had_choice = false;      ///< it continued along a wall from its rim, with free space on both sides
  bool on_planes = false;       ///< the target lies on the plane of a facet of a cell visited
  std::optional<Contact<D>> contact;  ///< if status is contact
};

/// Walks from a particle's position to a target. Touching a wall is no contact, crossing it is. Paper:
/// section II.
/// \param snapshot in which the particle lies
/// \param particle the start, with its cell
/// \param target finite
/// \param counts raised by the walk
/// \param options vectors to which the path is appended
/// \pre particle.position lies in the closure of particle.cell
/// \throw Error(usage) for a particle without a cell, or in one that an edit removed, if its name is not
///        reused: locate yours again after cells were replaced; Error(input) for a target that is not finite;
///        Error(not_certified) where an exact walk has no end: nothing was certified
/// Degenerate cases: a motion may pass exactly through passable edges and vertices. At an exit on a ridge or
/// vertex the walk continues through its star, along passable facets. If several sides qualify, it takes one
/// on which it gets furthest; of these the geometry determines one (docs/walk.md, choices). Inexact policies
/// try only that which geometry prefers. A motion of length zero arrives.
/// Cost: about 4 ns if the target lies in the same cell, plus 17 ns a crossed facet if cells are in the cache
/// (otherwise 25 ns at 10^5 tetrahedra, 130 ns at 10^6).
template <class Kernel = Exact, int D>
Walk_result<D> walk(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, const Walk_options& options = {});

/// Computes the time, point and normal of a contact of the motion from a to b, if the walk omitted them
/// (Walk_options::locates_contact); otherwise it changes nothing.
/// Cost: 0.2 us, more if only exact numbers decide how the time is rounded.
template <int D>
void locate_contact(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, Contact<D>& contact);

namespace detail {

/// \throw Error(usage) for a particle in a cell that does not exist
[[noreturn]] void refuse_removed_cell();

/// The planes of a cell can be read, if there was ever one of its name.
/// \throw Error(usage) if there was not
template <int D>
inline void check_has_planes(const Snapshot<D>& snapshot, Cell cell) {
  if (to_index(cell) >= snapshot.half_facet_slots() / 4) [[unlikely]]
    refuse_removed_cell();
}

/// The cell of a particle, if planes are undecided; they are for each cell that an edit removed.
/// \throw Error(usage) if the cell was removed
template <int D>
inline Cell_view<D> view_of_particle(const Snapshot<D>& snapshot, Cell cell) {
  if (!snapshot.is_cell(cell)) [[unlikely]]
    refuse_removed_cell();
  return snapshot.view(cell);
}

/// True if a point of the frame is certainly strictly inside a cell of at most eight facets.
template <int D>
inline bool certainly_inside(const Snapshot<D>& snapshot, Cell cell, const Float_point<D>& y,
                             Walk_counts& counts) {
  const std::size_t blocks = snapshot.block_count(cell);
  if (blocks > 2) return false;
  counts.plane_blocks += blocks;
  const Plane_block<D>* planes = snapshot.blocks(cell);
  if (blocks == 1) return lane_mask(evaluate(planes[0], y) < -plane_error) == 0xf;
  const Spread_point<D> lanes = spread<D>(y);
  return lane_mask((evaluate(planes[0], lanes) < -plane_error) &
                   (evaluate(planes[1], lanes) < -plane_error)) == 0xf;
}
template <int D>
inline bool certainly_inside(const Snapshot<D>& snapshot, Cell cell, const Point<D>& x, Walk_counts& counts) {
  Float_point<D> y;
  return snapshot.frame().map(x, y) && certainly_inside<D>(snapshot, cell, y, counts);
}

/// The end of a free walk that planes alone decide: the cell whose interior contains the target. Cell::none,
/// without counting a walk, if a wall is met or anything is undecided.
/// \param snapshot in which the particle lies
/// \param from the start, with its cell
/// \param target the end of the walk
/// \param counts raised by the walk
/// \param crossed if not null, receives the facets crossed
/// Cost: that of walk() without its report.
template <int D>
Cell certain_end(const Snapshot<D>& snapshot, const Particle<D>& from, const Point<D>& target,
                 Walk_counts& counts, std::vector<Half_facet>* crossed = nullptr);

template <class Kernel, int D>
Walk_result<D> move_by_walk(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                            Walk_counts& counts, const Walk_options& options);

}  // namespace detail

/// Moves a particle to the target if the walk arrives; otherwise leaves it in place and returns the contact.
/// \param snapshot in which the particle lies
/// \param particle moved only if the walk arrives
/// \param target finite
/// \param counts raised by the walk
/// \param options as for walk()
/// \throw Error as walk(), with nothing changed
template <class Kernel = Exact, int D>
inline Walk_result<D> move(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                           Walk_counts& counts, const Walk_options& options = {}) {
  detail::check_has_planes(snapshot, particle.cell);
  if constexpr (Kernel::uses_certificates) {
    if (detail::certainly_inside(snapshot, particle.cell, target, counts)) {
      if (options.visited) options.visited->push_back(particle.cell);
      ++counts.walks;
      ++counts.stays;
      particle.position = target;
      particle.dimension = D;
      return {Walk_status::arrived, particle.cell, D, particle.aimed, 1, false, false, {}};
    }
  }
  return detail::move_by_walk<Kernel>(snapshot, particle, target, counts, options);
}

}  // namespace cellwalk

#endif  // CELLWALK_WALK_WALK_H
