// SPDX-License-Identifier: LGPL-3.0-or-later
// The motion of a run (motion.gz), for `cellwalk view`.
#ifndef CELLWALK_CLI_RUN_RECORDING_H
#define CELLWALK_CLI_RUN_RECORDING_H

#include <cellwalk/internal/io/recording_file.h>
#include <cellwalk/simulation/change_schedule.h>
#include <cellwalk/simulation/world.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace cellwalk::cli {

/// The steps of a run, and how many of them lie between two frames.
struct Motion_times {
  double step = 0;  ///< duration
  std::uint32_t steps = 0, every = 1;
};

/// Written along with the run, of which it only reads: nothing that the run counts depends on whether it is
/// recorded.
template <int D>
class Run_recording {
 public:
  /// Writes the walls and the start. Refers to the snapshot, which must outlive it.
  /// \param changing facets that come and go as walls, and cells that are not free all the time
  /// \pre times.every > 0
  Run_recording(std::filesystem::path path, const Snapshot<D>& snapshot, const World<D>& world,
                const Motion_times& times, bool walls_move, const Selection<D>& changing);

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
  bool walls_move_;
  std::vector<std::uint32_t> wall_points_;  ///< those that the recording has, by their index
  std::vector<Half_facet> changing_walls_;  ///< a wall for each of their sides
  std::vector<Cell> changing_floor_;
  io::Recording_writer writer_;
  std::vector<Body_counts> before_;  ///< at the record before
};

/// Steps from one record to the next: what the scene says, or so many that a page of it stays below 30 MB. 0:
/// nothing is recorded.
template <int D>
std::uint32_t motion_interval(const Scene<D>& scene, const Snapshot<D>& snapshot, const World<D>& world,
                              std::uint32_t steps);

extern template class Run_recording<2>;
extern template class Run_recording<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_RECORDING_H
