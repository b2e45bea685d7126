// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of walls on which a motion goes on where it has a choice, and the search for those on which it
// gets furthest. Rule: docs/walk.md, choices.
#ifndef CELLWALK_INTERNAL_WALK_SIDES_TAKEN_H
#define CELLWALK_INTERNAL_WALK_SIDES_TAKEN_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/exact_time.h>
#include <cellwalk/walk/walk.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk {

class Fraction;

namespace detail {

/// A ridge or vertex after which a motion may go on along several sides of walls.
struct Side_taken {
  std::uint32_t u, v;   ///< point indices: ridge uv (3D), or vertex u
  Cell least;           ///< of the cells linked there with that of the motion
  std::uint16_t sides;  ///< as many
  std::uint16_t taken;  ///< in the order of preference

  /// The rest is the same for motions that arrive in linked cells.
  bool is_at_place_of(const Side_taken& other) const {
    return u == other.u && v == other.v && least == other.least;
  }
};
/// Those of a motion, in order.
using Sides_taken = boost::container::small_vector<Side_taken, 4>;

/// The number of combinations of sides that are tried for a motion that takes edges along; then the latest
/// contact found counts. Edges mostly leave one side of each wall, so that there is one combination for each
/// wall passed.
constexpr int most_side_tries = 256;

/// The next combination of sides: another one at the last choice that leaves one. False if none does.
inline bool take_next_sides(Sides_taken& choices) {
  while (!choices.empty() && choices.back().taken + 1 == choices.back().sides) choices.pop_back();
  if (choices.empty()) return false;
  ++choices.back().taken;
  return true;
}

/// When the motion from a to b is at the ridge or vertex of a choice.
template <int D>
Exact_time time_of(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                   const Side_taken& choice);

/// The exact time at which the motion from a to b passes a ridge uv (3D) or a vertex u = v; 0 if it runs
/// along the ridge, which it does from its start only.
template <int D>
Fraction passing_time(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, std::uint32_t u,
                      std::uint32_t v);

/// Of two walls that block the motion from a to b, true if the first does so later.
template <int D>
bool blocks_later(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, Half_facet wall,
                  Half_facet other);

/// As walk(), on given sides: at its n-th choice the walk takes side choices[n].taken, and the first one
/// where none is given. Those are appended.
template <int D>
Walk_result<D> walk_on_sides(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                             Walk_counts& counts, const Walk_options& options, Sides_taken& choices);

/// As move(), on these sides; without any, on those that the walk prefers.
template <int D>
Walk_result<D> move_on_sides(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                             Walk_counts& counts, const Walk_options& options, Sides_taken* choices) {
  if (!choices) return move(snapshot, particle, target, counts, options);
  const Walk_result<D> result = walk_on_sides(snapshot, particle, target, counts, options, *choices);
  if (result.status == Walk_status::arrived) particle = {target, result.cell, result.dimension, result.aimed};
  return result;
}

/// The walk on the sides on which it gets furthest, the first of them in the order of preference.
/// \param walk_once (options, choices): a walk on given sides
/// \param options with the output that a walk on preferred sides has appended already
/// Cost: that of a walk for each side of each place.
template <int D, class Walk_once>
Walk_result<D> furthest_walk(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b,
                             const Walk_options& options, const Walk_once& walk_once) {
  struct Way {
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    std::vector<Cell_exit> exits;
    Walk_result<D> result;
  };
  Sides_taken choices;
  const auto find_way = [&] {
    Way way;
    Walk_options recorded = options;
    recorded.visited = &way.visited;
    recorded.crossed = &way.crossed;
    recorded.exits = &way.exits;
    recorded.locates_contact = false;
    way.result = walk_once(recorded, choices);
    return way;
  };
  Way best = find_way();
  const std::size_t cells = best.visited.size(), facets = best.crossed.size(), exits = best.exits.size();
  std::vector<Side_taken> seen;
  for (std::size_t known = 0; best.result.contact;) {
    // Where the walk was before, all that follows was tried then, or will be.
    for (; known < choices.size(); ++known) {
      Side_taken& choice = choices[known];
      if (std::ranges::any_of(seen, [&](const auto& other) { return choice.is_at_place_of(other); }))
        choice.sides = 1;
      else
        seen.push_back(choice);
    }
    if (!take_next_sides(choices)) break;
    known = choices.size();
    Way way = find_way();
    if (!way.result.contact ||
        blocks_later(snapshot, a, b, way.result.contact->facet, best.result.contact->facet))
      best = std::move(way);
  }
  const auto replace = [](auto* appended, std::size_t count, const auto& other) {
    if (!appended) return;
    appended->resize(appended->size() - count);
    appended->insert(appended->end(), other.begin(), other.end());
  };
  replace(options.visited, cells, best.visited);
  replace(options.crossed, facets, best.crossed);
  replace(options.exits, exits, best.exits);
  if (best.result.contact && options.locates_contact) locate_contact(snapshot, a, b, *best.result.contact);
  return best.result;
}

}  // namespace detail
}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_WALK_SIDES_TAKEN_H
