// SPDX-License-Identifier: LGPL-3.0-or-later
// A folder of results that appears complete or not at all.
#ifndef CELLWALK_CLI_OUTPUT_FOLDER_H
#define CELLWALK_CLI_OUTPUT_FOLDER_H

#include <filesystem>

namespace cellwalk::cli {

/// A folder written beside its destination and renamed on commit(). Destroyed without commit() it leaves nothing behind.
class Output_folder {
 public:
  /// \throw Error(usage) if the destination exists, unless `replace` is set and it holds a run.json (so that nothing but
  ///        an earlier run is ever replaced); Error(other) if the folder cannot be made
  Output_folder(std::filesystem::path destination, bool replace);
  ~Output_folder();
  Output_folder(const Output_folder&) = delete;
  Output_folder& operator=(const Output_folder&) = delete;

  /// The checks of the constructor, for an early answer.
  static void check(const std::filesystem::path& destination, bool replace);

  /// Where to write.
  const std::filesystem::path& path() const { return temporary_; }

  /// \throw Error(other) if the folder cannot be put in place
  void commit();

 private:
  std::filesystem::path destination_, temporary_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_OUTPUT_FOLDER_H
