// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts of work: machine-independent evidence of what a computation cost.
#ifndef CELLWALK_KERNEL_COUNTS_H
#define CELLWALK_KERNEL_COUNTS_H

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cellwalk {

/// A set of counts: a struct of std::uint64_t, whose array `names` names them in order, and after them of other such sets.
/// What is done with all of them, sums and reports, is written once, so that no count can be left out.
template <class Set>
concept Count_set =
    std::is_trivially_copyable_v<Set> && sizeof(Set) % sizeof(std::uint64_t) == 0 && requires {
  { Set::names[0] } -> std::convertible_to<std::string_view>;
  requires Set::names.size() <= sizeof(Set) / sizeof(std::uint64_t);
};

/// All counts of a set, those of its inner sets included, in order.
template <Count_set Set>
using Count_array = std::array<std::uint64_t, sizeof(Set) / sizeof(std::uint64_t)>;

/// True if a set names each of its counts before its first inner set, which begins at byte `end`.
template <Count_set Set>
constexpr bool names_all_before(std::size_t end) {
  return Set::names.size() * sizeof(std::uint64_t) == end;
}

/// Adds each count of one set to that of another. Cost: one addition a count; hot code counts in variables of its own first.
template <Count_set Set>
Set& operator+=(Set& sum, const Set& more) {
  auto counts = std::bit_cast<Count_array<Set>>(sum);
  const auto added = std::bit_cast<Count_array<Set>>(more);
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += added[i];
  return sum = std::bit_cast<Set>(counts);
}

/// The counts of a set with their names, as reports show them; those of its inner sets are left to a call of their own.
template <Count_set Set>
auto named_counts(const Set& set) {
  const auto counts = std::bit_cast<Count_array<Set>>(set);
  std::array<std::pair<std::string_view, std::uint64_t>, Set::names.size()> result;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {Set::names[i], counts[i]};
  return result;
}

}  // namespace cellwalk

#endif  // CELLWALK_KERNEL_COUNTS_H
