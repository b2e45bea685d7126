// SPDX-License-Identifier: LGPL-3.0-or-later
// What the oracle of chains says of a sweep of the library.
#ifndef CELLWALK_TESTS_EDGE_SWEEP_JUDGE_H
#define CELLWALK_TESTS_EDGE_SWEEP_JUDGE_H

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "edge/chain_oracle.h"

namespace cellwalk::test {

enum class Sweep_fault {
  none,
  false_block,  ///< a contact where the motion is free on some sides
  false_free,   ///< no contact where there is one
  wrong_time,   ///< a contact at another time than the latest that is reached on any sides
  wrong_chain,  ///< the chain returned is none, or lies on another side of a wall
  count
};
inline constexpr std::array<const char*, 5> fault_names{"none", "false block", "false free", "wrong time",
                                                        "wrong chain"};

/// A half-facet of a snapshot in its soup: the facet of the same cell that has the same points.
template <int D>
std::uint32_t soup_facet(const Cell_soup<D>& soup, const Snapshot<D>& snapshot, Half_facet f) {
  const auto sorted = [](auto loop) {
    std::vector<std::uint32_t> key(loop.begin(), loop.end());
    std::sort(key.begin(), key.end());
    return key;
  };
  std::uint32_t i = soup.cell_begin[snapshot.index(snapshot.cell_of(f))];
  while (sorted(soup.facet(i)) != sorted(snapshot.loop(f))) ++i;
  return i;
}

template <int D>
std::vector<std::uint32_t> soup_chain(const Cell_soup<D>& soup, const Snapshot<D>& snapshot,
                                      const Chain& chain) {
  std::vector<std::uint32_t> facets;
  for (const Half_facet f : chain) facets.push_back(soup_facet(soup, snapshot, f));
  return facets;
}

template <int D>
oracle::Edge_motion<D> motion_of(const Cell_soup<D>& soup, const Snapshot<D>& snapshot,
                                 const Vertex_path<D>& path, const Particle<D>& q, const Chain& before) {
  oracle::Edge_motion<D> motion{path.from.position,
                                path.to.position,
                                q.position,
                                {},
                                {},
                                snapshot.index(q.cell),
                                soup_chain(soup, snapshot, before),
                                path.blocked};
  for (const Cell c : path.visited) motion.path.push_back(snapshot.index(c));
  const std::vector<std::uint32_t> crossed =
      soup_chain(soup, snapshot, {path.crossed.begin(), path.crossed.end()});
  auto passed = path.crossed.begin();
  for (std::size_t i = 0; i + 1 < path.visited.size(); ++i) {
    auto& facets = motion.passed.emplace_back();
    for (Cell cell = path.visited[i]; cell != path.visited[i + 1]; ++passed) {
      facets.push_back(crossed[static_cast<std::size_t>(passed - path.crossed.begin())]);
      cell = snapshot.neighbour(*passed);
    }
  }
  return motion;
}

/// Judges the result of a sweep by the outcomes of its motion.
template <int D>
Sweep_fault fault_of(const oracle::Chain_oracle<D>& oracle, const oracle::Edge_motion<D>& motion,
                     const oracle::Outcomes& outcomes, const Snapshot<D>& snapshot,
                     const Sweep_result<D>& result) {
  if (result.contact) {
    // The edge takes the sides on which it gets furthest.
    if (outcomes.may_be_free()) return Sweep_fault::false_block;
    oracle::Outcomes furthest;
    furthest.blocks.push_back(outcomes.blocks.back());
    return furthest.may_be_blocked_at(result.contact->time) ? Sweep_fault::none : Sweep_fault::wrong_time;
  }
  if (!outcomes.may_be_free()) return Sweep_fault::false_free;
  return oracle.is_end(motion, outcomes, soup_chain(oracle.soup(), snapshot, result.chain))
             ? Sweep_fault::none
             : Sweep_fault::wrong_chain;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_SWEEP_JUDGE_H
