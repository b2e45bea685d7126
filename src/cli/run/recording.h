// SPDX-License-Identifier: LGPL-3.0-or-later
// The motion of a run (motion.gz), for `cellwalk view`.
#ifndef CELLWALK_CLI_RUN_RECORDING_H
#define CELLWALK_CLI_RUN_RECORDING_H

#include <cellwalk/internal/io/recording_file.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <vector>

#include "recorded_walls.h"
#include "result_files.h"

namespace cellwalk::cli {

/// The steps of a run, and how many of them lie between two frames.
struct Motion_times {
  double step = 0;  ///< duration
  std::uint32_t steps = 0, every = 1;
};

/// The kinds of motion of the walls of a run.
struct Wall_motion {
  bool walls_move = false;    ///< their points do
  bool walls_change = false;  ///< they come and go
};

template <int D>
Wall_motion wall_motion(const Scene<D>& scene);

/// Written along with the run, of which it only reads: nothing that the run counts depends on whether it is
/// recorded.
template <int D>
class Run_recording {
 public:
  /// Writes the walls and the start. Refers to the snapshot, which must outlive it.
  /// \pre times.every > 0
  Run_recording(Result_files& place, const Snapshot<D>& snapshot, const World<D>& world,
                const Motion_times& times, const Wall_motion& motion);
  /// The one that was saved.
  Run_recording(Result_files& place, const Snapshot<D>& snapshot, const Wall_motion& motion,
                detail::Byte_reader& saved);
  void save(detail::Byte_writer& out) const { out(every_, walls_, writer_, before_); }

  /// To be called after each step.
  void record(const World<D>& world, bool is_last);

  /// Completes the file.
  void commit() { writer_.commit(); }

  std::uint32_t every() const { return every_; }
  std::uint32_t frame_count() const { return writer_.frame_count(); }

 private:
  void add(const World<D>& world);

  const Snapshot<D>& snapshot_;
  std::uint32_t every_;
  Wall_motion motion_;
  Recorded_walls<D> walls_;
  io::Recording_writer writer_;
  std::vector<Body_counts> before_;  ///< at the record before
};

/// Steps from one record to the next: the number that the scene gives, or one with which a page of it stays
/// below 30 MB. 0: nothing is recorded.
template <int D>
std::uint32_t motion_interval(const Scene<D>& scene, const Snapshot<D>& snapshot, const World<D>& world,
                              std::uint32_t steps);

extern template class Run_recording<2>;
extern template class Run_recording<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_RECORDING_H
