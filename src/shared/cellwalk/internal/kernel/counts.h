// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of work: machine-independent evidence of the cost of a computation.
#ifndef CELLWALK_INTERNAL_KERNEL_COUNTS_H
#define CELLWALK_INTERNAL_KERNEL_COUNTS_H

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cellwalk {

/// A set of counts: a struct of std::uint64_t, named in order by its array `names`, followed by other such
/// sets. Sums and reports of all counts are written once, so that none can be omitted.
template <class Set>
concept Count_set =
    std::is_trivially_copyable_v<Set> && sizeof(Set) % sizeof(std::uint64_t) == 0 && requires {
  { Set::names[0] } -> std::convertible_to<std::string_view>;
  requires Set::names.size() <= sizeof(Set) / sizeof(std::uint64_t);
};

/// All counts of a set in order, including those of its inner sets.
template <Count_set Set>
using Count_array = std::array<std::uint64_t, sizeof(Set) / sizeof(std::uint64_t)>;

/// True if a set names each of its counts before its first inner set, which begins at byte `end`.
template <Count_set Set>
constexpr bool names_all_before(std::size_t end) {
  return Set::names.size() * sizeof(std::uint64_t) == end;
}

/// Adds each count of one set to that of another.
/// Cost: one addition a count; hot code counts in its own variables first.
template <Count_set Set>
Set& operator+=(Set& sum, const Set& more) {
  auto counts = std::bit_cast<Count_array<Set>>(sum);
  const auto added = std::bit_cast<Count_array<Set>>(more);
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += added[i];
  return sum = std::bit_cast<Set>(counts);
}

/// The counts of a set with their names, for reports, without those of its inner sets.
template <Count_set Set>
auto named_counts(const Set& set) {
  const auto counts = std::bit_cast<Count_array<Set>>(set);
  std::array<std::pair<std::string_view, std::uint64_t>, Set::names.size()> result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {Set::names[i], counts[i]};
  return result;
}

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_COUNTS_H
