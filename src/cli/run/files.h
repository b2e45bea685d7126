// SPDX-License-Identifier: LGPL-3.0-or-later
// The files of a run: contacts.csv, walls.vtu, frames/*.vtu and run.pvd.
#ifndef CELLWALK_CLI_RUN_FILES_H
#define CELLWALK_CLI_RUN_FILES_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/frame_series.h>
#include <cellwalk/internal/simulation/saved_contacts.h>
#include <cellwalk/internal/simulation/world.h>

#include <array>
#include <cstdint>
#include <vector>

#include "result_files.h"

namespace cellwalk::cli {

/// Contacts of bodies, by the body's feature and the environment's.
using Body_contacts = std::array<std::array<std::uint64_t, 3>, 3>;

/// Written along with the run, step by step.
template <int D>
class Run_files {
 public:
  /// Writes walls.vtu, unless walls change, and the frame of the start, if there are to be frames at all.
  /// If it is continued, archive() is to be called next.
  Run_files(Result_files& place, const Environment<D>& environment, const World<D>& world,
            const Scene<D>& scene);

  /// To be called after each step.
  void record(const World<D>& world, bool is_last);

  /// Completes the files.
  void finish();

  std::size_t frame_count() const { return frames_; }
  /// Contacts so far, by kind.
  const std::array<std::uint64_t, 3>& contacts() const { return contacts_; }
  /// Those of them that are contacts of bodies.
  const Body_contacts& body_contacts() const { return body_contacts_; }

  /// All members but the content of the files.
  template <class Archive>
  void archive(Archive& a) {
    a(entries_, since_frame_, before_, contacts_, body_contacts_, frames_);
  }

 private:
  void write_frame(const World<D>& world);

  Result_files& place_;
  const Environment<D>& environment_;
  std::uint32_t every_;
  double time_step_;
  bool walls_change_;
  io::Csv_writer table_;
  std::vector<io::Pvd_entry> entries_;
  std::vector<Run_contact<D>> since_frame_;
  std::vector<Point<D>> before_;  ///< of the bodies' vertices, a step ago
  std::array<std::uint64_t, 3> contacts_{};
  Body_contacts body_contacts_{};
  std::size_t frames_ = 0;
};

extern template class Run_files<2>;
extern template class Run_files<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_FILES_H
