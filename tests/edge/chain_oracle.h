// SPDX-License-Identifier: LGPL-3.0-or-later
// The second oracle of swept edges: follows the definition of chains (docs/sweep.md) through all critical
// times, in integers, by brute force. It finds all that a sweep may answer.
#ifndef CELLWALK_TESTS_EDGE_CHAIN_ORACLE_H
#define CELLWALK_TESTS_EDGE_CHAIN_ORACLE_H

#include <set>
#include <span>
#include <vector>

#include "edge/moving_segment.h"

namespace cellwalk::oracle {

/// An edge pq whose end p moves from a to b. Cells and half-facets are those of the soup.
template <int D>
struct Edge_motion {
  Point<D> a{}, b{}, q{};
  std::vector<std::uint32_t> path;  ///< the cells of p, in order
  /// The passable half-facets between one cell of the way and the next: p changes from it to that once it
  /// lies in all of them.
  std::vector<std::vector<std::uint32_t>> passed;
  std::uint32_t q_cell = 0;
  std::vector<std::uint32_t> chain;  ///< of the edge aq: half-facets, each seen from the side of p
  bool blocked = false;              ///< p does not get further than its last cell
};

/// A class of equal chains of one segment: for each piece of its Cut, the least cell linked all along that
/// piece with the one that the chains pass there.
using Chain_class = std::vector<int>;

/// All that may become of an edge. The side taken at a rim of a wall is arbitrary, so there may be several
/// answers.
struct Outcomes {
  std::vector<Share> blocks;   ///< times at which it may be blocked, ascending
  std::set<Chain_class> ends;  ///< of the chains that it may have at the end of its way
  Share end{1, 1};             ///< where p is at 1, or is blocked
  int critical = 0;            ///< times looked at
  int choices = 0;             ///< times at which chains were continued by unequal ones
  bool touches = false;        ///< at some time a point of the edge has free space on several sides
  bool lies_in_wall = false;   ///< at some time a piece of it has

  bool may_be_free() const { return !ends.empty(); }
  /// True if one of the times of blocks is this one but for rounding down.
  bool may_be_blocked_at(double time) const;
};

/// A chain with the cells that it leads from and to.
struct Placed_chain {
  std::uint32_t p_cell = 0, q_cell = 0;
  std::vector<std::uint32_t> facets;  ///< half-facets, each seen from the side of p
};

template <int D>
class Chain_oracle {
 public:
  explicit Chain_oracle(const Cell_soup<D>& soup) : complex_(soup) {}

  const Cell_soup<D>& soup() const { return complex_.soup; }

  /// \throw std::invalid_argument if the chain before is none, or the way of p is impossible
  /// Cost: some 0.2 ms, most of it for cutting the segment at its critical times and between them.
  Outcomes judge(const Edge_motion<D>& motion) const;

  /// True if a chain is one of the ends among the outcomes of this motion: it is passed by the edge where p
  /// ends, and equal to a chain that it may have there.
  bool is_end(const Edge_motion<D>& motion, const Outcomes& outcomes,
              std::span<const std::uint32_t> chain) const;

  /// True if both are chains of the segment pq, and equal: at each point of it, both ends included, their
  /// cells are linked.
  bool are_equal(const Point<D>& p, const Point<D>& q, const Placed_chain& x, const Placed_chain& y) const;

  /// True if the segment pq has a chain from the one cell to the other.
  /// \pre they hold p and q
  bool has_chain(const Point<D>& p, const Point<D>& q, std::uint32_t p_cell, std::uint32_t q_cell) const;

 private:
  Integer_complex<D> complex_;
};

extern template class Chain_oracle<2>;
extern template class Chain_oracle<3>;

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_EDGE_CHAIN_ORACLE_H
