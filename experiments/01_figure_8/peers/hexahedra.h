// SPDX-License-Identifier: LGPL-3.0-or-later
// A table of hexahedra, and a walk through it in plain doubles.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "peer.h"

namespace cellwalk::figure_8 {

/// A plane of outward normal for each facet, lane by lane, and what is behind it.
struct Hexahedron {
  static constexpr std::size_t faces = 6;
  std::array<double, faces> x, y, z, offset;
  std::array<std::uint32_t, faces> neighbour;  ///< no_facet: a wall
};

std::vector<Hexahedron> hexahedra(const Grid_world& world);

/// Walks from a, in the cell, to b. False at a wall; else the cell is that of b.
template <class Counter>
bool walk_hexahedra(const std::vector<Hexahedron>& table, std::uint32_t& cell, const Point<3>& a,
                    const Point<3>& b, Counter& counter) {
  constexpr int longest = 1000;  // rounded signs may walk in circles
  constexpr std::size_t faces = Hexahedron::faces;
  counter.walks();
  for (int step = 0; step < longest; ++step) {
    const Hexahedron& h = table[cell];
    std::array<double, faces> side;
    for (std::size_t i = 0; i < faces; ++i)
      side[i] = h.x[i] * b[0] + h.y[i] * b[1] + h.z[i] * b[2] - h.offset[i];
    double first = 2;  // of the parameters at which facets are passed
    std::size_t exit = faces;
    for (std::size_t i = 0; i < faces; ++i) {
      if (!(side[i] > 0)) continue;
      const double start = h.x[i] * a[0] + h.y[i] * a[1] + h.z[i] * a[2] - h.offset[i];
      const double t = start / (start - side[i]);
      if (t < first) {
        first = t;
        exit = i;
      }
    }
    if (exit == faces) return true;
    if (h.neighbour[exit] == no_facet) return false;
    cell = h.neighbour[exit];
    counter.crossings();
  }
  return false;
}

/// The answer for a vertex of a body by walks of the vertex and along its edges. An edge whose ends are in
/// one cell needs no walk.
/// \param cells of the vertices of the body; that of a vertex that moves is brought up to date
template <class Counter>
unsigned walk_vertex(const std::vector<Hexahedron>& table, std::uint32_t* cells, std::size_t v,
                     const Point<3>* positions, const Point<3>& target, Counter& counter) {
  std::uint32_t cell = cells[v];
  const unsigned blocked = !walk_hexahedra(table, cell, positions[v], target, counter);
  const Point<3>& p = blocked ? positions[v] : target;
  if (blocked) cell = cells[v];
  unsigned answer = blocked;
  for (std::size_t k = 0; k < trace_edges; ++k) {
    const std::size_t q = trace_neighbour(v, k);
    std::uint32_t end = cell;
    if (end != cells[q])
      answer |= static_cast<unsigned>(!walk_hexahedra(table, end, p, positions[q], counter)) << (k + 1);
  }
  if (!answer) cells[v] = cell;
  return answer;
}

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_HEXAHEDRA_H
