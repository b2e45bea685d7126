// SPDX-License-Identifier: LGPL-3.0-or-later
// The options of `cellwalk run`, and its outputs.
#ifndef CELLWALK_CLI_RUN_OPTIONS_H
#define CELLWALK_CLI_RUN_OPTIONS_H

#include <cellwalk/body/step.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/durable.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/common/outputs.h"

namespace cellwalk::cli {

struct Run_options {
  std::string scene, folder;
  std::string record;  ///< a trace to write; empty: none
  std::string json;    ///< where the report goes as well; empty: nowhere
  std::vector<std::string> changes;
  std::string scene_text;   ///< with the changes
  std::uint32_t steps = 0;  ///< 0: as many as in the scene
  std::size_t threads = 0;  ///< 0: as many as there are cores
  bool force = false;
  Body_options body;
  std::uint32_t checkpoint_every = 0;  ///< steps; 0: there are no checkpoints
  std::string resume;                  ///< the folder of a run to go on with; empty: a new run begins
};

/// Which options were given that must be those of a run to go on with.
struct Given_options {
  bool scene = false;  ///< or changes of it
  bool steps = false, sweep = false, record = false, json = false;
};

/// The outputs of a run; null for those not requested.
struct Run_outputs {
  /// Of a new run.
  explicit Run_outputs(const Run_options& options)
      : all({options.scene}),
        folder(options.checkpoint_every == 0 ? &all.folder(options.folder, options.force) : nullptr),
        working(folder == nullptr ? &all.working_folder(options.folder, options.force, false) : nullptr),
        record(all.file(cleared(options, options.record))),
        json(all.file(cleared(options, options.json))) {
    make_durable();
  }
  /// Of a run to go on with; its files are opened later.
  explicit Run_outputs(const std::string& resumed)
      : all({}), working(&all.working_folder(resumed, false, true)) {}

  void open(const std::string& record_name, const std::string& json_name) {
    for (const std::string& name : {record_name, json_name})
      if (!name.empty()) io::remove_abandoned(name);
    record = all.file(record_name);
    json = all.file(json_name);
    make_durable();
  }

  Outputs all;
  Output_folder* folder = nullptr;
  Working_folder* working = nullptr;
  io::Atomic_file *record = nullptr, *json = nullptr;

 private:
  /// Without the rest of a run with checkpoints that was killed before the first of them.
  static const std::string& cleared(const Run_options& options, const std::string& name) {
    if (options.checkpoint_every > 0 && !name.empty()) io::remove_abandoned(name);
    return name;
  }
  /// Checkpoints are not to be gone before all that came of them is there.
  void make_durable() {
    if (working == nullptr) return;
    for (io::Atomic_file* file : {record, json})
      if (file != nullptr) file->make_durable();
  }
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_OPTIONS_H
