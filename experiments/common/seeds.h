// SPDX-License-Identifier: LGPL-3.0-or-later
// Seeds of the parts of an experiment, from its one seed and the name of the part: no part's numbers depend
// on which others ran, nor in which order.
#ifndef CELLWALK_EXPERIMENTS_COMMON_SEEDS_H
#define CELLWALK_EXPERIMENTS_COMMON_SEEDS_H

#include <cellwalk/internal/kernel/random.h>

#include <cstdint>
#include <string_view>

namespace cellwalk::experiments {

/// The seed of a part; `number` tells trials of one part apart. The same on every machine.
constexpr std::uint64_t part_seed(std::uint64_t seed, std::string_view part, std::uint64_t number = 0) {
  std::uint64_t x = scramble(seed);
  for (const char c : part) x = scramble(x ^ static_cast<unsigned char>(c));
  return scramble(scramble(x) ^ scramble(number));
}

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_SEEDS_H
