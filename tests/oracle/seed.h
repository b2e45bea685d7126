// SPDX-License-Identifier: LGPL-3.0-or-later
// The numbers of random worlds: a test makes the same worlds each time, unless CELLWALK_TEST_SEED has it make
// others.
#ifndef CELLWALK_TESTS_ORACLE_SEED_H
#define CELLWALK_TESTS_ORACLE_SEED_H

#include <cstdint>
#include <cstdlib>

namespace cellwalk::oracle {

/// The seed of world i: i, plus what no test reaches by itself times CELLWALK_TEST_SEED. Remainders by which
/// tests choose kinds of worlds stay as they are.
inline std::uint64_t reseeded(std::uint64_t i) {
  constexpr std::uint64_t stride = 720720ull * 1'000'000;  // a multiple of 1 to 16
  const char* const seed = std::getenv("CELLWALK_TEST_SEED");
  return seed == nullptr ? i : i + stride * std::strtoull(seed, nullptr, 10);
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_ORACLE_SEED_H
