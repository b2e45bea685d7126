// SPDX-License-Identifier: LGPL-3.0-or-later
// One contact, located by all searches: how far are they from the exact one, and what do they cost? Paper:
// section III.
#ifndef CELLWALK_EXPERIMENTS_CONTACT_SEARCH_SEARCH_TRIALS_H
#define CELLWALK_EXPERIMENTS_CONTACT_SEARCH_SEARCH_TRIALS_H

#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cellwalk::contact_search {

/// Where edges move.
enum class World {
  room,   ///< 2D: rooms with polygonal obstacles and thin walls
  boxes,  ///< 3D: a grid of small boxes that float
  vessel  ///< 3D: a branching vessel, all of whose walls are outside
};
inline constexpr World worlds[] = {World::room, World::boxes, World::vessel};
std::string_view name_of(World world);

/// A way to locate a contact.
struct Search {
  const char* name;
  std::optional<Search_options> options = {};  ///< none for the exact contact
  int bits = 0;                                ///< of a dichotomic one: its tolerance is 2^-bits; else 0
};

/// Errors of one search at one contact; times are shares of the motion.
struct Search_error {
  double early = 0;   ///< exact time less that of the search: negative if it is late
  double gap = 0;     ///< distance of the exact point from the edge at the time found, in lengths of the step
  double point = 0;   ///< distance of the point reported from the exact one, in lengths of the step
  double normal = 0;  ///< angle with the exact normal, in degrees
};

/// What a search did at all contacts of a world.
struct Search_tally {
  std::vector<Search_error> errors;  ///< a contact each
  std::uint64_t same_time = 0;       ///< the exact fraction
  std::uint64_t late = 0;            ///< later than it
  std::uint64_t same_feature = 0;    ///< the same vertex, edge or facet of the environment
  Edge_counts counts;                ///< of the sweeps with the search
  double microseconds = 0;  ///< a contact, with the sweep that finds it; median of the rounds, 0 if not timed
};

/// All members, for experiments::shared_trials().
template <class Archive, class Tally>
void members(Archive& archive, Tally& tally) requires std::same_as<std::remove_const_t<Tally>, Search_tally> {
  archive(tally.errors);
  archive(tally.same_time);
  archive(tally.late);
  archive(tally.same_feature);
  archive(tally.counts);
  archive(tally.microseconds);
}

struct Trial_options {
  std::uint64_t seed = 1;
  std::size_t contacts = 0;
  int rounds = 0;  ///< timed, of at most `timed_contacts`
};
inline constexpr std::size_t timed_contacts = 300;

/// Draws random moves of an edge until so many of them are stopped by it, before its end is, and locates each
/// of these contacts by all searches.
/// Cost: some ms a contact; some seconds for the vessel.
std::vector<Search_tally> run(World world, const std::vector<Search>& searches, const Trial_options& options);

}  // namespace cellwalk::contact_search

#endif  // CELLWALK_EXPERIMENTS_CONTACT_SEARCH_SEARCH_TRIALS_H
