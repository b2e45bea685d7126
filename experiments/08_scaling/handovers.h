// SPDX-License-Identifier: LGPL-3.0-or-later
// What ranks would hand to each other if each had a part of the environment: contiguous ranges of the cells
// in their order along the space-filling curve.
#ifndef CELLWALK_EXPERIMENTS_SCALING_HANDOVERS_H
#define CELLWALK_EXPERIMENTS_SCALING_HANDOVERS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <vector>

namespace cellwalk::scaling {

/// Which rank has a cell.
class Ranges {
 public:
  /// \pre the snapshot has at least `ranks` cells
  Ranges(const Snapshot<3>& snapshot, std::uint32_t ranks);

  std::uint32_t ranks() const { return ranks_; }
  std::uint32_t owner(Cell cell) const { return owner_[to_index(cell)]; }

  /// Cells of others that a rank needs: those that share a vertex with one of its own, summed over the ranks.
  std::uint64_t ghosts() const { return ghosts_; }
  /// Ranks that share a vertex with a rank, the most of all.
  std::uint32_t most_neighbours() const { return most_neighbours_; }

 private:
  void count_ghosts(const Snapshot<3>& snapshot);

  std::uint32_t ranks_;
  std::vector<std::uint32_t> owner_;  ///< by to_index(Cell)
  std::uint64_t ghosts_ = 0;
  std::uint32_t most_neighbours_ = 0;
};

/// What was counted in the steps of a scene.
struct Handovers {
  std::uint64_t vertices = 0;       ///< vertices of bodies and free particles, summed over the steps
  std::uint64_t moved = 0;          ///< of these: in another rank's cell than a step before
  std::uint64_t edges = 0;          ///< edges of bodies, summed over the steps
  std::uint64_t parted = 0;         ///< of these: with a chain through cells of several ranks
  std::uint64_t crossings = 0;      ///< facets between ranks that chains pass
  std::uint64_t bodies = 0;         ///< summed over the steps; a free particle is none
  std::uint64_t parted_bodies = 0;  ///< of these: with vertices in cells of several ranks
  std::uint64_t most_vertices = 0;  ///< of one rank, summed over the steps
  std::uint64_t most_received = 0;  ///< vertices and chains handed to one rank, summed over the steps
  /// Vertices of one body with an edge in several ranks, the most of all bodies, summed over the steps: they
  /// move one after the other, and each waits for answers of others.
  std::uint64_t longest = 0;
};

/// Follows a world step by step.
class Counter {
 public:
  Counter(const Snapshot<3>& snapshot, std::uint32_t ranks) : ranges_(snapshot, ranks), snapshot_(snapshot) {}

  /// \pre nothing is stale: World::validate() was called after the step
  void count(const World<3>& world);

  const Ranges& ranges() const { return ranges_; }
  const Handovers& sum() const { return sum_; }

 private:
  void count_vertex(std::size_t number, Cell cell);
  /// Returns whether the chain lies in several ranks.
  bool count_chain(const Chain& chain, Cell first);
  /// Returns how many vertices have an edge in several ranks.
  std::uint64_t count_body(const Body<3>& body, std::size_t& number);

  Ranges ranges_;
  const Snapshot<3>& snapshot_;
  Handovers sum_;
  std::vector<std::uint32_t> before_;  ///< the rank of each vertex a step before
  std::vector<std::uint32_t> load_, received_;
};

}  // namespace cellwalk::scaling

#endif  // CELLWALK_EXPERIMENTS_SCALING_HANDOVERS_H
