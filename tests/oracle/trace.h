// SPDX-License-Identifier: LGPL-3.0-or-later
// What a motion meets, reduced to ranks of exact parameters, and the truth about it that follows by pure
// combinatorics.
//
// Definition (the only one the oracle knows): cells are linked at x if a sequence of passable facets that
// contain x joins them. A motion in cell c is continued past a point by a cell that is linked with c there
// and whose closure holds a further piece of it; if there is none, it is blocked there.
#ifndef CELLWALK_TESTS_ORACLE_TRACE_H
#define CELLWALK_TESTS_ORACLE_TRACE_H

#include <cstdint>
#include <span>
#include <vector>

#include "oracle/number.h"

namespace cellwalk::oracle {

/// A cell whose closure meets the motion: between two events, both included (a closed convex set meets it
/// so).
struct Visit {
  std::uint32_t cell = 0;
  bool solid = false;
  int first = 0, last = 0;
  int dimension_at_last = 0;  ///< of the lowest cell of the complex that holds the point of event `last`
};

/// A facet of a visited cell that meets the motion.
struct Incidence {
  int visit = 0;            ///< whose facet it is
  std::uint32_t facet = 0;  ///< its number in the cell
  int neighbour = -1;       ///< visit of the cell on the other side; -1 on the boundary
  bool passable = false;
  int first = 0, last = 0;
};

/// All that a motion meets. Events are the parameters at which anything changes; 0 and 1 are the first and
/// the last. A motion of length zero has one event.
struct Trace {
  std::vector<Fraction<Wide>> events;
  std::vector<Visit> visits;
  std::vector<Incidence> incidences;

  int last_event() const { return static_cast<int>(events.size()) - 1; }
  /// The visit of a cell; -1 if the motion does not meet it.
  int visit_of(std::uint32_t cell) const;
  /// A class number per visit: equal for cells linked at the event; -1 for cells that do not hold its point.
  std::vector<int> classes_at(int event) const;
  /// The same for cells linked at every point between the event and the next one; -1 for cells that do not
  /// hold all of that piece.
  std::vector<int> classes_after(int event) const;
};

/// A legal end of a motion short of its target.
struct Stop {
  std::uint32_t cell = 0;
  int event = 0;
  int dimension = 0;  ///< of the lowest cell of the complex that holds the point
};

/// Everything that a correct walk may answer.
struct Truth {
  /// Cells, holding the last piece of the motion, in which it may arrive.
  std::vector<std::uint32_t> arrivals;
  std::vector<Stop> stops;
  int choices = 0;           ///< events after which cells of more than one side are legal
  bool unique_cells = true;  ///< no piece of the motion may lie in more than one cell
};

/// All legal continuations of a motion that starts in a cell.
/// \pre the cell's closure holds the start
Truth judge(const Trace& trace, std::uint32_t start);

/// What is wrong with a list of cells as the way of a walk: each must be linked with the one before at a
/// point of both, one after the other, and must hold a further piece.
enum class Path_fault { none, wrong_start, not_met, not_linked, no_further_piece };
Path_fault check_path(const Trace& trace, std::uint32_t start, std::span<const std::uint32_t> path);

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_TRACE_H
