// SPDX-License-Identifier: LGPL-3.0-or-later
// What moves of walls from bytes came to, of all inputs together: tests assert that it was not nothing.
#ifndef CELLWALK_TESTS_FUZZ_MOVES_H
#define CELLWALK_TESTS_FUZZ_MOVES_H

#include <cstddef>

namespace cellwalk::fuzz {

struct Judged_moves {
  std::size_t moves = 0, reached = 0, touching = 0, contacts = 0, pushed = 0, stopped = 0;
};
const Judged_moves& judged_moves();

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_MOVES_H
