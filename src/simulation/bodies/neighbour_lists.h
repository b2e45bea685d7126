// SPDX-License-Identifier: LGPL-3.0-or-later
// Lists of numbers one after the other, and where each begins.
#ifndef CELLWALK_SIMULATION_BODIES_NEIGHBOUR_LISTS_H
#define CELLWALK_SIMULATION_BODIES_NEIGHBOUR_LISTS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

/// True if all numbers are below a bound.
inline bool are_below(const std::vector<std::uint32_t>& numbers, std::size_t bound) {
  return std::ranges::all_of(numbers, [&](std::uint32_t n) { return n < bound; });
}

/// True if `first` divides numbers below a bound into the given number of lists.
inline bool are_lists(const std::vector<std::uint32_t>& first, const std::vector<std::uint32_t>& numbers,
                      std::size_t lists, std::size_t bound) {
  return first.size() == lists + 1 && first.front() == 0 && first.back() == numbers.size() &&
         std::ranges::is_sorted(first) && are_below(numbers, bound);
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_NEIGHBOUR_LISTS_H
