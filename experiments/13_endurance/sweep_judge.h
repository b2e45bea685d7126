// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of complete sweeps of edges without a radius, where all free cells at each point are linked there
// (link_free_cells()). Then every segment in free space, closed, has one chain up to equality, and a motion
// is blocked at the first time at which the edge enters the open rest: what is solid, or outside.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_SWEEP_JUDGE_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_SWEEP_JUDGE_H

#include <cellwalk/edge/sweep.h>

#include <vector>

#include "walk_judge.h"

namespace cellwalk::endurance {

/// All that a sweep may answer.
struct Sweep_truth {
  bool is_free = false;
  Time end{1, 1};                 ///< where it is blocked
  bool by_vertex = false;         ///< the end that moves is blocked at that time, on all sides
  bool may_be_by_vertex = false;  ///< or on some
  bool degenerate = false;        ///< a corner of the triangle lies on a facet, or the triangle is a segment
};

enum class Sweep_fault {
  none,
  false_free,     ///< free, though the edge enters something solid
  false_contact,  ///< blocked, though it does not
  wrong_time,     ///< not the first such time, rounded down, or the point is not on the edge then
  wrong_feature,  ///< not the feature of the edge that is blocked
  wrong_wall,     ///< names a facet that is no wall
  wrong_cell,     ///< its end is not where it should be, or registered in a cell that does not hold it
  wrong_chain,    ///< the facets do not follow each other, or the edge does not pass them in order
  count
};
inline constexpr std::array<const char*, 8> sweep_fault_names{"none",       "false_free",    "false_contact",
                                                              "wrong_time", "wrong_feature", "wrong_wall",
                                                              "wrong_cell", "wrong_chain"};

/// A move of an edge: a to b, while q stands still.
template <int D>
struct Edge_sites {
  Site<D> a, b, q;
};

/// True if the triangle that the edge sweeps is a segment or a point.
template <int D>
bool is_flat(const Edge_sites<D>& move) {
  for (std::size_t i = 0; i < D; ++i) {
    const std::size_t k = (i + 1) % D;
    if (Wide(move.a[i] - move.q[i]) * (move.b[k] - move.q[k]) !=
        Wide(move.a[k] - move.q[k]) * (move.b[i] - move.q[i]))
      return false;
  }
  return true;
}

/// The points x = q + u (a - q) + w (b - a) of a triangle have 0 <= w <= u <= 1, and the time w / u.
struct Corner {
  Whole u, w, z;  ///< z > 0: the point (u / z, w / z)

  Time time() const { return {w, u}; }
};
struct Line {
  Whole u, w, c;  ///< u U + w W + c <= 0

  /// Positive outside of the line.
  Wide at(const Corner& x) const { return Wide(u) * x.u + Wide(w) * x.w + Wide(c) * x.z; }
};
/// Where two lines meet that are not parallel.
inline Corner crossing(const Line& a, const Line& b) {
  const Corner x{a.w * b.c - a.c * b.w, a.c * b.u - a.u * b.c, a.u * b.w - a.w * b.u};
  return x.z < 0 ? Corner{-x.u, -x.w, -x.z} : x;
}
/// The sides of the triangle: w >= 0, u <= 1, w <= u; each leads from a corner to the next one.
inline constexpr std::array<Line, 3> triangle_sides{{{0, -1, 0}, {1, 0, -1}, {-1, 1, 0}}};
inline constexpr std::array<Corner, 3> triangle_corners{{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}};

template <int D>
class Sweep_judge {
 public:
  Sweep_judge(const Lattice<D>& lattice, int bits);

  /// \param cell of the end that moves
  /// \pre the edge lies in free space, and coordinates are below 2^28
  Sweep_truth judge(std::uint32_t cell, const Edge_sites<D>& move);

  /// The same walks as the ends of edges make.
  Walk_judge<D>& walks() { return walks_; }

 private:
  static constexpr std::size_t most_corners = 10;
  struct Polygon {
    std::size_t size = 0;
    std::array<Corner, most_corners> corners;
    std::array<Line, most_corners> edges;  ///< from a corner to the next one
  };

  void see(const Edge_sites<D>& move);
  bool misses(std::uint32_t cell) const;
  void meet(std::uint32_t cell, std::size_t without);
  static bool clip(Polygon& polygon, const Line& line);
  Whole outside(const Side& side, Whole value) const {
    return side.outwards * (value - (Whole{side.plane} << bits_));
  }

  const Lattice<D>& lattice_;
  const int bits_;
  Walk_judge<D> walks_;
  std::vector<std::uint32_t> solid_;  ///< cells
  std::vector<std::uint32_t> inner_;  ///< sides of solid cells with nothing free behind
  std::array<Whole, most_families> at_a_{}, at_b_{}, at_q_{};
  Time first_;
};

/// What is wrong with the answer to a move.
template <int D>
Sweep_fault fault_of(const World<D>& world, const Sweep_truth& truth, const Edge_sites<D>& move,
                     const Particle<D>& q, const Sweep_result<D>& result);

/// True if the segment from x to q passes these half-facets in order, from a cell of x to one of q.
/// \param places if not null, receives where it may pass them, from 0 at x to 1 at q
template <int D>
bool is_passed(const World<D>& world, const Site<D>& x, const Site<D>& q, std::uint32_t cell,
               std::uint32_t last, const Chain& chain, std::vector<Time>* places = nullptr);

/// True if the closure of a cell holds a site.
template <int D>
bool holds(const Lattice<D>& lattice, int bits, std::uint32_t cell, const Site<D>& x);

extern template class Sweep_judge<2>;
extern template class Sweep_judge<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_SWEEP_JUDGE_H
