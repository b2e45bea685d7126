// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks with the lengths of their pieces: which cells a motion crosses, and how far it runs in each. For
// track-length tallies, Lagrangian particles and streamlines.
#ifndef CELLWALK_WALK_TRACE_H
#define CELLWALK_WALK_TRACE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/walk.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cellwalk {

/// How a traced motion ended.
struct Trace_end {
  Walk_status status = Walk_status::arrived;  ///< lost: the particle has no cell
  Cell cell = Cell::none;                     ///< the last cell
  Half_facet wall = Half_facet::none;         ///< if status is contact: the wall that blocks it
};

/// Motions divided by the cells they cross, one row a motion, in compressed rows: the pieces of row i are
/// [offsets[i], offsets[i + 1]), in order, and likewise its crossings. Vectors that are cleared and filled
/// again keep their memory.
struct Traces {
  std::vector<std::uint64_t> offsets{0};
  std::vector<Cell> cells;      ///< of each piece; only cells in which the motion has a positive length
  std::vector<double> lengths;  ///< of each piece, rounded to nearest
  std::vector<std::uint64_t> crossing_offsets{0};
  /// The passable facets crossed, as Walk_options::crossed: at a ridge or vertex, all facets on the path
  /// through its star.
  std::vector<Half_facet> crossings;
  std::vector<Trace_end> ends;  ///< of each row

  std::size_t size() const { return ends.size(); }
  void clear();
};

/// Traces motions. It holds the plane of each facet to twice the precision of doubles and refers to the
/// snapshot, which must outlive it. Facets may be opened and closed; after other edits a new one must be
/// made.
template <int D>
class Tracer {
 public:
  /// Cost: about 0.5 us and 128 bytes a facet.
  explicit Tracer(const Snapshot<D>& snapshot);
  explicit Tracer(const Snapshot<D>&& snapshot) = delete;
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  /// Moves particles as move() does, and appends a row for each: the same cells, facets and ends.
  ///
  /// The cells of a row are exact. Each length is the double nearest to the exact length of the piece (of two
  /// as near, the even one), so that the exact sum of a row is within an ulp of the length of the motion, up
  /// to the wall if it meets one. A motion that runs along a facet or an edge, or through a vertex, belongs
  /// to the cells that the walk takes: each piece is in one cell.
  /// \param particles those that arrive are moved; those without a cell get a row without pieces
  /// \param targets as many, finite
  /// \param traces to which the rows are appended
  /// \param counts raised by the walks
  /// \pre as walk()
  /// \throw Error(usage) for another number of targets, if points were moved or cells replaced since the
  ///        tracer was made, and as walk(); Error(input) as walk(). Then rows and particles are as before
  /// Degenerate cases: a motion of length 0 has no piece. A length that rounds to 0 is 0.
  /// Cost: 10 to 17 ns a crossing if cells are in the cache; 0.3 to 0.7 us a crossing for motions through
  /// ridges, through vertices or along facets. Thread-safe, with traces and counts of one's own; the results
  /// do not depend on how motions are divided among calls.
  void trace(std::span<Particle<D>> particles, std::span<const Point<D>> targets, Traces& traces,
             Walk_counts& counts) const;

 private:
  struct Planes;
  std::unique_ptr<Planes> planes_;
};

extern template class Tracer<2>;
extern template class Tracer<3>;

}  // namespace cellwalk

#endif  // CELLWALK_WALK_TRACE_H
