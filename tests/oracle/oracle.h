// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle of walk and locate: brute force over all cells of a soup in exact arithmetic. It shares no
// predicate and no table with the library, only the record Cell_soup. docs/walk.md says what it proves.
#ifndef CELLWALK_TESTS_ORACLE_ORACLE_H
#define CELLWALK_TESTS_ORACLE_ORACLE_H

#include <cellwalk/records/cell_soup.h>

#include <memory>

#include "oracle/trace.h"

namespace cellwalk::oracle {

/// Where a point lies, by definition: what Locator<D>::locate must answer.
struct Place {
  std::vector<std::uint32_t> free_cells, solid_cells;  ///< whose closures hold the point, ascending
  int sides = 0;                                       ///< classes of the free cells, linked at the point
  int dimension = 0;                                   ///< of the lowest cell of the complex that holds it
  /// Of each free cell: of the lowest cell in its closure. They differ at slits only.
  std::vector<int> dimensions;
};

template <int D>
class Oracle {
 public:
  /// \throw std::invalid_argument for a complex whose cells are not convex, positive and properly glued
  explicit Oracle(Cell_soup<D> soup);
  ~Oracle();
  Oracle(Oracle&&) noexcept;

  const Cell_soup<D>& soup() const;

  /// All that the closed segment ab meets.
  /// Cost: linear in the number of cells; about 10 us for 100 cells.
  Trace trace(const Point<D>& a, const Point<D>& b) const;

  Place place(const Point<D>& p) const;

  /// True if the half-facet (its number in its cell) can be passed.
  bool is_passable(std::uint32_t cell, std::uint32_t facet) const;

  /// Motions traced in 128-bit and in 512-bit integers so far.
  std::size_t narrow_traces() const;
  std::size_t wide_traces() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_ORACLE_H
