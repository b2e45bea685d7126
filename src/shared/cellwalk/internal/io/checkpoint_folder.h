// SPDX-License-Identifier: LGPL-3.0-or-later
// Checkpoints of a run in a folder: the last two, sealed by a checksum, each there as a whole or not at all.
// See docs/formats.md.
#ifndef CELLWALK_INTERNAL_IO_CHECKPOINT_FOLDER_H
#define CELLWALK_INTERNAL_IO_CHECKPOINT_FOLDER_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::io {

struct Checkpoint {
  std::uint64_t step = 0;
  std::vector<std::byte> state;
  std::filesystem::path file;
  /// Newer ones, which are damaged: each with its defect.
  std::vector<std::string> passed_over;
};

class Checkpoint_folder {
 public:
  /// \param program its name and version, which alone continues its runs
  Checkpoint_folder(std::filesystem::path folder, std::string program)
      : folder_(std::move(folder)), program_(std::move(program)) {}

  const std::filesystem::path& path() const { return folder_; }

  /// Writes a checkpoint to the device, then removes all but it and the one before.
  /// \throw Error(other) if it cannot be written; then those that were there are there still
  void keep(std::uint64_t step, std::span<const std::byte> state);

  /// True if there is any, damaged or not.
  bool has_any() const { return !steps().empty(); }

  /// The newest that is not damaged.
  /// \throw Error(input) if there is none, or if it was written by another version
  Checkpoint newest() const;

 private:
  std::vector<std::uint64_t> steps() const;
  std::filesystem::path file_of(std::uint64_t step) const;

  std::filesystem::path folder_;
  std::string program_;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_CHECKPOINT_FOLDER_H
