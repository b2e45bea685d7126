// SPDX-License-Identifier: LGPL-3.0-or-later
// The results of walls that moved: arrays by row, and tables of their contacts.
#ifndef CELLWALK_PYTHON_WALL_ROWS_H
#define CELLWALK_PYTHON_WALL_ROWS_H

#include <cellwalk/reshape/reshaping.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <vector>

#include "motions.h"

namespace cellwalk::python {

/// A row of the tables of contacts of walls.
template <int D>
struct Wall_hit_row {
  double time;
  std::array<double, D> point, normal, weights;
  std::array<double, 3> resident_weights;
  std::array<std::int64_t, D> corners;  // as wide as an index of an array
  std::uint32_t row;
  std::int32_t cell;
  std::uint32_t facet, owner, feature;
  std::uint8_t kind, body;
  bool is_particle;
  std::uint8_t unused;  // no padding: equal rows are equal bytes
};
static_assert(sizeof(Wall_hit_row<2>) == 12 * sizeof(double) + 24 &&
              sizeof(Wall_hit_row<3>) == 16 * sizeof(double) + 24);
using Wall_hit_row_2 = Wall_hit_row<2>;
using Wall_hit_row_3 = Wall_hit_row<3>;

/// The results of the moves of a call, row by row. Needs no interpreter.
template <int D>
class Wall_rows {
 public:
  /// All moves as if they had reached their targets.
  /// \param snapshot of the environment; nothing is added once certificates are made anew, which may turn
  ///        the loops of facets
  Wall_rows(const Snapshot<D>& snapshot, const std::vector<Vertex_move<D>>& moves)
      : snapshot_(snapshot), time(moves.size(), 1.0), cell(moves.size(), -1) {
    end.resize(moves.size(), static_cast<std::uint8_t>(Move_end::reached));
    for (const Vertex_move<D>& move : moves) {
      rows_.emplace(move.point, static_cast<std::uint32_t>(position.size()));
      position.push_back(move.target);
    }
  }

  /// Writes the result of a move over its row.
  void set(const Vertex_result<D>& result) {
    const std::uint32_t row = rows_.at(result.point);
    position[row] = result.position;
    end[row] = static_cast<std::uint8_t>(result.end);
    if (result.end == Move_end::reached) return;
    time[row] = result.end == Move_end::cell ? result.share
                : result.hit                 ? result.hit->time
                                             : std::numeric_limits<double>::quiet_NaN();
    cell[row] = number_of(snapshot_, result.cell);
    if (!result.hit) return;
    contacts.push_back(to_row(*result.hit));
    cell[row] = contacts.back().cell;
  }

  void add_hit(const Wall_hit<D>& hit) { hits.push_back(to_row(hit)); }

 private:
  Wall_hit_row<D> to_row(const Wall_hit<D>& hit) const {
    Wall_hit_row<D> row{};
    row.time = hit.time;
    row.point = hit.point;
    row.normal = hit.normal + Vector<D>{};  // without negative zeros
    row.weights = hit.weights;
    row.resident_weights = hit.resident_weights;
    std::size_t corners = 0;
    row.corners[corners++] = hit.vertex;
    for (const std::uint32_t v : snapshot_.loop(hit.facet))
      if (v != hit.vertex) row.corners[corners++] = v;
    row.row = rows_.at(hit.vertex);
    row.cell = number_of(snapshot_, snapshot_.cell_of(hit.facet));
    row.facet = static_cast<std::uint32_t>(snapshot_.facet_of(hit.facet));
    row.owner = hit.resident.owner;
    row.feature = hit.resident.number;
    row.kind = static_cast<std::uint8_t>(hit.kind);
    row.body = static_cast<std::uint8_t>(hit.resident.feature);
    row.is_particle = hit.resident.is_particle;
    return row;
  }

  const Snapshot<D>& snapshot_;
  std::unordered_map<std::uint32_t, std::uint32_t> rows_;  ///< of the points

 public:
  std::vector<std::uint8_t> end;
  std::vector<Point<D>> position;
  std::vector<double> time;
  std::vector<std::int32_t> cell;
  std::vector<Wall_hit_row<D>> contacts, hits;
  std::uint32_t rounds = 0;
  Reshape_counts counts;
};

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_WALL_ROWS_H
