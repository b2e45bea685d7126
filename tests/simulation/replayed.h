// SPDX-License-Identifier: LGPL-3.0-or-later
// Whole replays.
#ifndef CELLWALK_TESTS_SIMULATION_REPLAYED_H
#define CELLWALK_TESTS_SIMULATION_REPLAYED_H

#include <cellwalk/internal/simulation/body_replay.h>

namespace cellwalk::test {

struct Replayed {
  std::uint64_t mismatches = 0, registered_anew = 0;
  Body_counts counts;
};

inline Replayed replayed(const Snapshot<3>& snapshot, const Body_trace& trace, const Body_options& options,
                         bool validates = false) {
  const Locator<3> locator(snapshot);
  Body_replay replay(snapshot, locator, trace, options);
  while (replay.steps_done() < trace.steps) {
    replay.prepare();
    replay.step();
    replay.note_answers();
    if (validates) replay.validate();
  }
  return {count_mismatches(trace, replay.answers(), options.sweep.sweep), replay.registered_anew(),
          replay.counts()};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_REPLAYED_H
