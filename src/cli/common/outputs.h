// SPDX-License-Identifier: LGPL-3.0-or-later
// The outputs of a command: all of them appear, or none; and none replaces an input.
#ifndef CELLWALK_CLI_COMMON_OUTPUTS_H
#define CELLWALK_CLI_COMMON_OUTPUTS_H

#include <cellwalk/internal/io/atomic_file.h>

#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "output_folder.h"
#include "working_folder.h"

namespace cellwalk::cli {

/// A name on the command line and the file to which it refers: two names of one file, by links or otherwise,
/// are equal.
class Named_file {
 public:
  explicit Named_file(std::string name);

  const std::string& name() const { return name_; }
  bool is_same(const Named_file& other) const;
  /// True if it lies in a folder, at any depth.
  bool is_within(const Named_file& folder) const;
  /// True for a pipe, which is read once, but for the standard input.
  bool is_pipe() const { return is_pipe_; }
  /// True for terminals and /dev/null, which may be named several times: they store nothing that could be
  /// lost.
  bool keeps_nothing() const { return keeps_nothing_; }

 private:
  std::string name_;
  std::filesystem::path path_;  ///< absolute, without links
  bool exists_ = false, keeps_nothing_ = false, is_pipe_ = false;
  dev_t device_ = 0;
  ino_t inode_ = 0;
};

/// The outputs of one command, opened before it starts its work.
class Outputs {
 public:
  /// `inputs` are the files that the command reads, and those that belong to a mesh among them; empty names
  /// are ignored. The log, if there is one, counts as an output.
  /// \throw Error(usage) if the log is an input
  explicit Outputs(std::initializer_list<std::string> inputs) : Outputs(std::vector<std::string>(inputs)) {}
  explicit Outputs(const std::vector<std::string>& inputs);

  /// To be called where several processes read the inputs.
  /// \throw Error(usage) if one is a pipe, and also_reads() likewise
  void inputs_are_shared();

  /// Adds a file that is read as well.
  /// \throw Error(usage) if one is an output
  void also_reads(const std::string& name);

  /// An output, or nullptr if the name is empty.
  /// \throw Error(usage) if it is an input or another output; Error(other) if it cannot be written
  io::Atomic_file* file(const std::string& name);

  /// A folder of results.
  /// \throw Error as file() and Output_folder
  Output_folder& folder(const std::string& name, bool replace);
  /// The same of one that another process may go on with, or goes on with.
  /// \throw Error as file() and Working_folder
  Working_folder& working_folder(const std::string& name, bool replace, bool is_taken_up);

  /// Moves all outputs to their places and prints the summary; if either fails, none appears.
  /// \throw Error(other)
  void commit(const std::string& summary);

 private:
  /// With the further files of a mesh.
  void add_input(const std::string& name);
  void refuse_pipe(const Named_file& input) const;
  void refuse_clash(const Named_file& output, const Named_file& input) const;
  void refuse_replaced(const Named_file& folder, const Named_file& input) const;
  void refuse_within(const Named_file& output, const Named_file& folder) const;
  void add(const Named_file& output);
  void name_folder(const Named_file& folder);

  bool are_inputs_shared_ = false;
  std::vector<Named_file> inputs_, outputs_;
  std::vector<Named_file> folder_names_;  ///< among the outputs
  std::vector<std::unique_ptr<io::Atomic_file>> files_;
  std::unique_ptr<io::Output> folder_;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_OUTPUTS_H
