// SPDX-License-Identifier: LGPL-3.0-or-later
// A segment from a moving point p(s) = a + s (b - a) to a fixed one, and the cells it meets at exact times:
// brute force over all cells near it, in integers. Shares nothing with the library but the record Cell_soup.
#ifndef CELLWALK_TESTS_EDGE_MOVING_SEGMENT_H
#define CELLWALK_TESTS_EDGE_MOVING_SEGMENT_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge/integer_complex.h"

namespace cellwalk::oracle {

/// The values of an affine function at a, b and q.
struct Values {
  Big at_a, at_b, at_q;
};

/// How a segment passes cells: cut at all points at which it enters or leaves a cell or a passable facet.
/// Cells and facets are those of the Moving_segment, by number.
struct Cut {
  /// Numbers of the first and the last point at which something is met; nothing if first > last.
  struct Stretch {
    int first = 0, last = -1;
    bool covers(int from, int to) const { return first <= from && to <= last; }
    bool operator==(const Stretch&) const = default;
  };
  struct Facet {
    std::array<int, 2> cells;
    Stretch met;
  };
  std::vector<Share> points;          ///< ascending from 0 to 1; 0 alone where p is at q
  std::vector<const Values*> makers;  ///< the function whose root cuts there; null at the ends
  std::vector<Stretch> cells;
  std::vector<Facet> facets;

  int pieces() const { return static_cast<int>(points.size()) - 1; }
  /// True if both pass the same cells and facets in the same order.
  bool is_like(const Cut& other) const;
  /// For each cell that holds all of the stretch between two cut points, the least cell that is linked with
  /// it at each point of the stretch; -1 for other cells.
  /// \pre no point is cut between the two
  std::vector<int> classes(int first, int last) const;
};

/// The segments [p(s),q] for s in [0,1]. Refers to the complex.
template <int D>
class Moving_segment {
 public:
  Moving_segment(const Integer_complex<D>& complex, const Point<D>& a, const Point<D>& b, const Point<D>& q);

  /// Number of a free cell of the soup among those near the triangle; -1 if it is not one of them.
  int number_of(std::uint32_t cell) const;
  /// Number of a passable half-facet of the soup, for Cut::facets; -1 if it is none near the triangle.
  int facet_of(std::uint32_t half_facet) const;
  /// The cells of the soup, by number.
  const std::vector<std::uint32_t>& cells() const { return cells_; }

  /// All times in [0,1] at which the combinatorics of cut() may change, ascending, 0 and 1 included: p enters
  /// or leaves a cell or facet or is at q; the segment passes a vertex (2D) or an edge (3D), or a vertex in
  /// the plane in which it moves.
  std::vector<Share> critical_times() const;
  Cut cut(const Share& time) const;
  /// Where a point that cuts the segments of an open interval between critical times ends up at one of its
  /// ends.
  static Share limit(const Cut& cut, int point, const Share& time);

  /// The last time at which p is in a cell.
  /// \pre it is there at some time
  Share exit_time(int cell) const;
  /// The first time, not before another, at which p lies in all of some passable half-facets of the soup.
  std::optional<Share> first_time_in(const std::vector<std::uint32_t>& half_facets, const Share& since) const;

  bool is_point(const Share& time) const;  ///< p is at q

 private:
  struct Facet {
    std::uint32_t half_facet;
    std::array<int, 2> cells;
    std::vector<Values> sides;  ///< the plane twice, once turned round, then the rims
  };

  Values values(const Affine<D, Big>& f) const;

  const Integer_complex<D>& complex_;
  int extra_shift_ = 0;
  std::array<Big, D> a_, b_, q_;
  std::vector<std::uint32_t> cells_;
  std::vector<std::vector<Values>> planes_;  ///< of the cells
  std::vector<Facet> facets_;
};

extern template class Moving_segment<2>;
extern template class Moving_segment<3>;

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_EDGE_MOVING_SEGMENT_H
