// SPDX-License-Identifier: LGPL-3.0-or-later
// A folder of results that appears complete or not at all.
#ifndef CELLWALK_CLI_COMMON_OUTPUT_FOLDER_H
#define CELLWALK_CLI_COMMON_OUTPUT_FOLDER_H

#include <cellwalk/internal/io/output.h>

#include <filesystem>

namespace cellwalk::cli {

/// A folder written beside its destination. If it is destroyed before put(), it leaves nothing behind.
class Output_folder final : public io::Output {
 public:
  /// \throw Error(usage) if the destination exists, unless `replace` is set and it contains a run.json, so
  ///        that only an earlier run can be replaced; Error(other) if the folder cannot be made
  Output_folder(const std::filesystem::path& destination, bool replace);
  ~Output_folder() override;

  /// The folder in which to write.
  const std::filesystem::path& path() const { return temporary_; }

  void prepare() override {}
  /// \throw Error(other) as Output; if the destination was taken meanwhile, the results stay beside it
  void put() override;
  void take_back() noexcept override;
  void settle() noexcept override;
  bool can_be_taken_back() const override { return true; }

  /// The target of a name, absolute and without a slash at its end.
  static std::filesystem::path place_of(const std::filesystem::path& name);
  /// True if nothing is there or, with `replace`, an earlier run.
  static bool is_replaceable(const std::filesystem::path& destination, bool replace);
  /// \throw Error(usage) as the constructor
  static void check_destination(const std::filesystem::path& destination, bool replace);

 private:
  void keep_beside();

  std::filesystem::path name_, destination_, temporary_;  ///< the given name, its target, the new folder
  bool replaces_;
  int lock_ = -1;  ///< shows other processes that this one runs
  io::Unfinished unfinished_;
  io::Replacement replacement_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_OUTPUT_FOLDER_H
