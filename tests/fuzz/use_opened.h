// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment in use, whatever it is: questions, motions, bodies, walls that move, cuts and edits.
#ifndef CELLWALK_TESTS_FUZZ_USE_OPENED_H
#define CELLWALK_TESTS_FUZZ_USE_OPENED_H

#include <cellwalk/environment/environment.h>

#include "fuzz/decoder.h"

namespace cellwalk::fuzz {

/// What was done in environments that need not be certified, of all inputs together.
struct Used {
  std::size_t opened = 0, refused = 0;
  std::size_t motions = 0, sweeps = 0, bodies = 0, steps = 0, changes = 0, edits = 0;
  std::size_t contradictions = 0;  ///< uses that ended in an Error
};
const Used& used();
Used& counted_uses();

/// Uses an environment in all ways. Each may end in an Error, and then the next one begins.
template <int D>
void use(Environment<D>& environment, Decoder& in);

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_USE_OPENED_H
