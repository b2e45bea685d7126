// SPDX-License-Identifier: LGPL-3.0-or-later
// Many particles in flight, by each way to find the exit of a cell: with and without float planes, with and
// without the forecast of the paper, with and without filters.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_FLIGHTS_H
#define CELLWALK_EXPERIMENTS_ABLATION_FLIGHTS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/walk.h>

#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

namespace cellwalk::ablation {

/// Where and how far particles fly.
struct Flight_setting {
  std::string world;      ///< "vessel", of tetrahedra, or "hexahedra"
  bool is_small = false;  ///< fewer cells
  double length = 0;      ///< of a move, in edges of a cell
  std::size_t particles = 0;
  std::size_t steps = 0;  ///< moves of each, in directions of its own
  std::uint64_t seed = 1;
};

struct Flight_row {
  std::string world, way;
  double length = 0;
  std::uint64_t cells = 0, moves = 0, blocked = 0;
  std::uint64_t different = 0;  ///< particles that end elsewhere than the first way takes them
  Walk_counts counts;
  std::vector<double> nanoseconds;  ///< a move, of each round
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& row) requires std::same_as<std::remove_const_t<Value>, Flight_row> {
  archive(row.world);
  archive(row.way);
  for (auto* count : {&row.cells, &row.moves, &row.blocked, &row.different}) archive(*count);
  archive(row.length);
  archive(row.counts);
  archive(row.nanoseconds);
}

/// Flies all ways; where signs are slow, with fewer of the particles.
std::vector<Flight_row> run_flights(const Flight_setting& setting, int rounds);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_FLIGHTS_H
