// SPDX-License-Identifier: LGPL-3.0-or-later
// A table of few facets, found by their points in any order.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_FACET_TABLE_H
#define CELLWALK_INTERNAL_ENVIRONMENT_FACET_TABLE_H

#include <cellwalk/internal/environment/gluing.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cellwalk::detail {

/// The points of a facet are distinct. They are not copied: loop_of(n) returns those of the facet entered as
/// n.
class Facet_table {
 public:
  /// \param most the largest number of facets
  explicit Facet_table(std::size_t most) : entries_(std::bit_ceil(2 * most + 2)) {}

  /// Enters a facet and returns its number. If one with the same points is there, that is returned instead.
  template <class Loop_of>
  std::uint32_t enter(std::uint32_t number, const Loop_of& loop_of) {
    Entry& entry = entries_[place_of(loop_of(number), loop_of)];
    if (entry.number == no_facet) entry = {hash_of(loop_of(number)), number};
    return entry.number;
  }
  /// The facet with some points; no_facet if there is none.
  template <class Loop_of>
  std::uint32_t find(std::span<const std::uint32_t> loop, const Loop_of& loop_of) const {
    return entries_[place_of(loop, loop_of)].number;
  }

 private:
  struct Entry {
    std::uint32_t hash = 0, number = no_facet;
  };

  /// Equal for all orders of the points.
  static std::uint32_t hash_of(std::span<const std::uint32_t> loop) {
    std::uint64_t sum = 0;
    for (const std::uint32_t point : loop) {
      const std::uint64_t mixed = (point + 1) * std::uint64_t{0x9e3779b97f4a7c15};
      sum += (mixed ^ mixed >> 29) * std::uint64_t{0xbf58476d1ce4e5b9};
    }
    return static_cast<std::uint32_t>(sum >> 32);
  }
  static bool are_same(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    return a.size() == b.size() && std::ranges::all_of(a, [&](std::uint32_t point) {
             return std::ranges::find(b, point) != b.end();
           });
  }
  /// Where a facet with the same points is, or can be entered.
  template <class Loop_of>
  std::size_t place_of(std::span<const std::uint32_t> loop, const Loop_of& loop_of) const {
    const std::uint32_t hash = hash_of(loop);
    const std::size_t mask = entries_.size() - 1;
    std::size_t at = hash & mask;
    while (entries_[at].number != no_facet &&
           !(entries_[at].hash == hash && are_same(loop, loop_of(entries_[at].number))))
      at = (at + 1) & mask;
    return at;
  }

  boost::container::small_vector<Entry, 128> entries_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_FACET_TABLE_H
