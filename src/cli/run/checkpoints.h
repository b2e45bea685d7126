// SPDX-License-Identifier: LGPL-3.0-or-later
// Checkpoints of a run: all that another process needs to go on with it, the scene and the environment
// included.
#ifndef CELLWALK_CLI_RUN_CHECKPOINTS_H
#define CELLWALK_CLI_RUN_CHECKPOINTS_H

#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/environment/environment_history.h>
#include <cellwalk/internal/io/checkpoint_folder.h>
#include <cellwalk/internal/kernel/byte_archive.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "options.h"
#include "result_files.h"

namespace cellwalk::cli {

/// The options with which the run began.
struct Run_settings {
  std::string scene, scene_text;
  std::string record, json;  ///< names of files outside of the folder, which are not written unasked
  std::uint32_t steps = 0, every = 0;
  std::string replaced;  ///< the name of the folder that --force replaces, without its place; empty: none
  Sweep sweep = Sweep::triangle;
  std::vector<std::string> notes;         ///< on the files of bodies
  std::vector<std::string> import_lines;  ///< on the import of the environment

  explicit Run_settings() = default;
  Run_settings(const Run_options& options, std::vector<std::string> notes,
               std::vector<std::string> import_lines);

  template <class Archive>
  void archive(Archive& a) {
    a(scene, scene_text, record, json, steps, every, replaced, sweep, notes, import_lines);
  }
};

/// A checkpoint that was read.
struct Kept_run {
  io::Checkpoint checkpoint;
  Run_settings settings;
  Result_files::Lengths lengths;
  detail::Byte_reader rest{std::span<const std::byte>()};  ///< the environment and the parts of the run
};

/// Reads the newest checkpoint of a run that is not damaged, with a line on stderr for each that is.
/// \throw Error(input) if there is none, or one of another version of the program
Kept_run read_checkpoint(const std::filesystem::path& checkpoints);

/// Takes the environment out of the rest of a checkpoint.
/// \param history that it is to follow, once it is where it stays
/// \throw Error(input) for one that is damaged, or of another dimension
template <int D>
Compiled_environment<D> take_environment(const std::filesystem::path& checkpoints, detail::Byte_reader& rest,
                                         detail::Environment_history& history);

/// Makes checkpoints.
template <int D>
class Run_checkpoints {
 public:
  /// \param changes whether the environment ever changes: otherwise it is written once
  Run_checkpoints(const std::filesystem::path& checkpoints, Result_files& place, Run_settings settings,
                  bool changes);

  /// True after a step that is to have a checkpoint.
  bool is_due(std::uint32_t step) const { return step % settings_.every == 0; }
  /// \param save writes the parts of the run, and may still write to its files
  /// \throw Error(other) if it cannot be written; then the last one is there still
  void keep(std::uint32_t step, const Environment<D>& environment, const Certificate& certificate,
            const std::function<void(detail::Byte_writer&)>& save);

 private:
  std::uint64_t keep_environment(const Environment<D>& environment, const Certificate& certificate);

  io::Checkpoint_folder folder_;
  Result_files& place_;
  Run_settings settings_;
  bool changes_;
  std::optional<std::uint64_t> environment_;  ///< the checksum of its file
};

extern template Compiled_environment<2> take_environment(const std::filesystem::path&, detail::Byte_reader&,
                                                         detail::Environment_history&);
extern template Compiled_environment<3> take_environment(const std::filesystem::path&, detail::Byte_reader&,
                                                         detail::Environment_history&);
extern template class Run_checkpoints<2>;
extern template class Run_checkpoints<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_CHECKPOINTS_H
