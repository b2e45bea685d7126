// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the files of a run go: into a folder that appears when it ends, or into one that also stays if it is
// stopped, and in which another process goes on with them from its last checkpoint.
#ifndef CELLWALK_CLI_RUN_RESULT_FILES_H
#define CELLWALK_CLI_RUN_RESULT_FILES_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/durable.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cellwalk::cli {

class Result_files {
 public:
  /// How long each file is, by name: those that grow, and those that are complete.
  using Lengths = std::map<std::string, std::uint64_t>;

  /// Each file is complete or not there.
  explicit Result_files(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Files grow where they are.
  /// \param aside for files that are not to be seen among the results
  /// \param lengths at the checkpoint from which the run goes on; none: it begins
  Result_files(std::filesystem::path folder, std::filesystem::path aside, std::optional<Lengths> lengths)
      : folder_(std::move(folder)),
        aside_(std::move(aside)),
        lengths_(std::move(lengths)),
        complete_lengths_(lengths_.value_or(Lengths{})) {}

  const std::filesystem::path& folder() const { return folder_; }
  /// True if files grow where they are.
  bool grows() const { return aside_.has_value(); }
  /// True if files are there already, up to the lengths at a checkpoint.
  bool is_continued() const { return lengths_.has_value(); }

  /// A table, with its header.
  io::Csv_writer table(const std::string& name, const std::vector<std::string>& columns);
  /// A file that is compressed.
  std::unique_ptr<io::Byte_sink> packed(const std::string& name);
  /// A file beside the results, from which a run can read its own content again.
  /// \pre files grow where they are
  std::unique_ptr<io::Byte_sink> aside(const std::string& name);
  std::filesystem::path aside_path(const std::string& name) const { return *aside_ / name; }

  /// \throw Error(input) if a file that was complete at the checkpoint is missing, or has another length
  /// \pre is_continued(), and all files that grow were opened
  void check_complete() const;
  /// Notes a file among the results that is complete.
  void note(const std::string& name);
  /// Waits until all that was written is on the device, and returns the lengths for a checkpoint.
  /// \pre files grow where they are
  Lengths sync();

 private:
  std::shared_ptr<io::Growing_file> growing(const std::string& name, const std::filesystem::path& path);

  std::filesystem::path folder_;
  std::optional<std::filesystem::path> aside_;
  std::optional<Lengths> lengths_;  ///< at the checkpoint from which the run goes on
  Lengths complete_lengths_;        ///< of files that are complete, as soon as those that grow were opened
  std::map<std::string, std::shared_ptr<io::Growing_file>> growing_;
  std::vector<std::string> complete_;  ///< since the last checkpoint
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_RESULT_FILES_H
