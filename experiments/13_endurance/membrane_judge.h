// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of complete sweeps among walls with free space on both sides.
//
// The planes of the lattice cut the triangle into polygons. If it lies in none of them, each polygon lies in
// one cell, and chains that continue each other exist exactly if all these cells are free, those of polygons
// with a common side are linked there, and those at the edge before it moves are linked with its chain. (Then
// cells are linked at the corners of polygons, too, as those around a corner follow each other across sides.)
// A side that is none is met at the least time of its two ends. Triangles that lie in planes of facets are
// left out; of those that are segments, the ends decide.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_MEMBRANE_JUDGE_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_MEMBRANE_JUDGE_H

#include <optional>
#include <vector>

#include "sweep_judge.h"

namespace cellwalk::endurance {

/// An edge before it moves.
struct Edge_cells {
  std::uint32_t p = 0, q = 0;  ///< of its ends
  const Chain* chain = nullptr;
};

template <int D>
class Membrane_judge {
 public:
  explicit Membrane_judge(const World<D>& world);

  /// Nothing if the triangle lies in a plane of facets.
  /// \pre the edge passes its chain, and coordinates are below 2^28
  std::optional<Sweep_truth> judge(const Edge_cells& edge, const Edge_sites<D>& move);

  /// True if the edge passes the chain, and could have come there from a triangle in this direction.
  bool is_chain_after(const Edge_cells& edge, const Edge_sites<D>& move);

  Walk_judge<D>& walks() { return walks_; }

 private:
  using Values = std::array<Whole, most_families>;
  using Planes = std::array<std::int16_t, most_families>;
  struct Piece {
    Corner from, to;
  };

  bool see(const Edge_sites<D>& move, Sweep_truth& truth);
  void judge_flat(const Edge_cells& edge, const Edge_sites<D>& move, Sweep_truth& truth);
  bool leads_off(const Edge_cells& edge, const Site<D>& p, const Site<D>& q, const Values& ways);
  void meet_walls();
  void meet_edges(const Edge_sites<D>& move);
  void meet_edge(std::uint32_t v, std::uint32_t w, const Piece& piece);
  std::optional<Piece> in_triangle(const Line& line) const;
  static bool cut(Piece& piece, const Line& line, const Line& by);
  void note(const Piece& piece);
  std::uint32_t cell_with(const Planes& floors) const;
  Line line_of(const Side& side) const;

  const World<D>& world_;
  const Lattice<D>& lattice_;
  Walk_judge<D> walks_;
  std::vector<std::uint32_t> walls_;                 ///< a side each
  std::vector<std::array<std::uint32_t, 2>> edges_;  ///< of the lattice in 3D, by their points
  Values at_a_{}, at_b_{}, at_q_{};
  Time first_;
};

extern template class Membrane_judge<2>;
extern template class Membrane_judge<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_MEMBRANE_JUDGE_H
