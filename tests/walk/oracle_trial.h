// SPDX-License-Identifier: LGPL-3.0-or-later
// A trial: many motions in many worlds, each judged by the oracle, and a count of everything interesting that
// happened, so that a test can show that its cases were not empty.
#ifndef CELLWALK_TESTS_WALK_ORACLE_TRIAL_H
#define CELLWALK_TESTS_WALK_ORACLE_TRIAL_H

#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/strategy.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "walk/oracle_worlds.h"
#include "walk/walk_judge.h"

namespace cellwalk::oracle {

/// What was met. Branches are those of walks that were judged right.
struct Tally {
  std::size_t motions = 0;
  std::array<std::size_t, motion_kinds> by_kind{};
  std::array<std::size_t, world_kinds> by_world{};
  std::array<std::size_t, 11> verdicts{};  ///< by Verdict, one a walk
  std::vector<std::string> faults;         ///< the first few, with all that is needed to replay them

  // Of the truth.
  std::size_t free = 0, blocked = 0;  ///< motions that must arrive, that must be blocked
  std::size_t either = 0;             ///< motions that may do both, by the side that is taken
  std::size_t with_choice = 0;        ///< motions on which a side had to be chosen at least once
  std::size_t touching = 0;           ///< motions that arrive after touching a wall or ending on one
  std::size_t within_wall = 0;        ///< motions that arrive with a piece inside a wall
  std::size_t wide = 0;               ///< judged with 512-bit integers

  // Of the way of the first walker.
  std::size_t facet_exits = 0, ridge_exits = 0, vertex_exits = 0;
  std::size_t contacts_facet = 0, contacts_edge = 0, contacts_vertex = 0, contacts_at_once = 0;
  std::size_t stays = 0, most_cells = 0;
  std::array<std::size_t, 4> arrivals_by_dimension{};
  std::size_t reversed = 0;        ///< walks back that had to visit the same cells, and did
  std::size_t reversed_wrong = 0;  ///< and did not

  std::size_t walks() const;
  std::size_t wrong() const { return walks() - verdicts[static_cast<int>(Verdict::right)]; }
  std::string summary() const;
  std::string first_faults() const;
};

/// A walk under test: one policy with one strategy.
template <int D>
struct Walker_under_test {
  std::string name;
  std::function<Walk_result<D>(const Snapshot<D>&, const Particle<D>&, const Point<D>&, std::vector<Cell>&)>
      walk;
  Sides_due sides = Sides_due::furthest;
};

template <class Kernel, int D>
Walker_under_test<D> walker(Walk_strategy strategy, const char* strategy_name) {
  return {std::string(Kernel::name) + ", " + strategy_name,
          [strategy](const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                     std::vector<Cell>& visited) {
            Walk_counts counts;
            return walk<Kernel>(snapshot, particle, target, counts, strategy, {&visited});
          },
          Kernel::is_exact ? Sides_due::furthest : Sides_due::any};
}

template <int D>
struct Trial_options {
  bool generic = false;
  std::size_t motions = 0;
  std::size_t motions_per_world = 0;  ///< 0: as many as give a few hundred worlds, at most 250
  std::uint64_t seed = 0;             ///< number of the first world
  /// If set, changes the world that is walked, but not the one that the oracle sees.
  std::function<void(Cell_soup<D>&)> tamper{};
};

/// Walks motions there and, if they arrive, back by every walker, in one world after the other. The particle
/// follows the first walker where that is right, so that later motions start on the side it came to.
template <int D>
Tally run_trial(const std::vector<Walker_under_test<D>>& walkers, const Trial_options<D>& options);

/// The count of a test of CI length times CELLWALK_TEST_LENGTH, which is 1 if unset: 10 at night, less than 1
/// under a sanitizer, where it is one at least.
std::size_t scaled_count(std::size_t count_in_ci);
/// True if tests are shorter than in CI: too short to meet everything.
bool is_shortened();

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_WALK_ORACLE_TRIAL_H
