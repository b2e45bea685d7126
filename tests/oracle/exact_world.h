// SPDX-License-Identifier: LGPL-3.0-or-later
// A cell soup in exact integers, and what a motion meets in it, by brute force over all cells.
//
// A facet is held as its plane and its rims: planes through its edges (2D: lines through its ends) at right
// angles to it. Each is an affine function, positive outside; its values at the two ends of a motion say all
// that is needed.
#ifndef CELLWALK_TESTS_ORACLE_EXACT_WORLD_H
#define CELLWALK_TESTS_ORACLE_EXACT_WORLD_H

#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <vector>

#include "oracle/trace.h"

namespace cellwalk::oracle {

/// Which half-facets are the two sides of one facet, and which of them can be passed. Found by comparing
/// sorted vertex lists.
struct Facet_table {
  std::vector<std::uint32_t> cell;     ///< of each half-facet
  std::vector<std::int64_t> opposite;  ///< half-facet on the other side; -1 on the boundary
  std::vector<std::uint8_t> passable;  ///< both sides free and neither marked as a wall
};

template <int D>
Facet_table make_facet_table(const Cell_soup<D>& soup);

/// The power of two by which all coordinates become integers.
int integer_shift(double x);

/// An affine function x -> normal . x - offset in scaled integers.
template <int D, class N>
struct Affine {
  std::array<N, D> normal;
  N offset;
};

template <int D, class N>
class Exact_world {
 public:
  /// \throw std::invalid_argument if a facet is not planar, a polygon or a cell not convex, or a cell inside
  /// out
  Exact_world(const Cell_soup<D>& soup, const Facet_table& facets, int shift);

  /// Upper bound of the bits of any value that trace() computes for points of this many bits, scaled by
  /// 2^extra_shift.
  int value_bits(int point_bits, int extra_shift) const;

  /// \pre a and b become integers when scaled by 2^(shift + extra_shift)
  Trace trace(const Point<D>& a, const Point<D>& b, int extra_shift) const;

 private:
  struct Facet {
    Affine<D, N> plane;
    std::vector<Affine<D, N>> rims;
  };
  struct Motion;

  Facet make_facet(std::span<const std::uint32_t> loop) const;
  void check_cell(std::size_t cell) const;
  bool holds(const Facet& facet, const Motion& motion, const Fraction<N>& t) const;
  int dimension_at(std::size_t cell, const Motion& motion, const Fraction<N>& t) const;

  const Cell_soup<D>& soup_;
  const Facet_table& table_;
  int shift_;
  std::vector<std::array<N, D>> points_;
  std::vector<Facet> facets_;
  std::vector<std::array<Point<D>, 2>> boxes_;  // of the cells: comparing doubles is exact
  int normal_bits_ = 0, offset_bits_ = 0;
};

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_EXACT_WORLD_H
