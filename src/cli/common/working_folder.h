// SPDX-License-Identifier: LGPL-3.0-or-later
// A folder of results that is written beside its destination, as OUT.part, and stays there if the program
// ends before: another one goes on with it.
#ifndef CELLWALK_CLI_COMMON_WORKING_FOLDER_H
#define CELLWALK_CLI_COMMON_WORKING_FOLDER_H

#include <cellwalk/internal/io/output.h>
#include <cellwalk/kernel/error.h>

#include <filesystem>
#include <memory>
#include <string>

namespace cellwalk::cli {

/// OUT.part, with the folders `results`, which becomes OUT, and `checkpoints`. One process uses it at a time.
class Working_folder final : public io::Output {
 public:
  /// Makes it, or takes one that an earlier run left: its content stays until begin(). Nothing of a new one
  /// stays without a checkpoint, whatever ends the program.
  /// \throw Error(usage) as Output_folder, and if there is one already, unless `replace` is set; Error(input)
  ///        for one that holds links; Error(other) if it cannot be made
  static std::unique_ptr<Working_folder> make(const std::filesystem::path& destination, bool replace);
  /// Takes up the folder that an earlier process left: unfinished files in it are removed, and nothing else
  /// before settle().
  /// \throw Error(usage) if there is none, or another process uses it; Error(input) if it holds links, by
  ///        which files outside would be written
  static std::unique_ptr<Working_folder> take_up(const std::filesystem::path& destination);

  /// Of one that was made: puts the results of an earlier run aside, and makes the folders of this one.
  /// Without a checkpoint, the destructor then removes them, and brings the earlier run back.
  /// \throw Error(other) if they cannot be made
  void begin();
  /// Once there is a checkpoint, and this run stays: removes the results of an earlier one.
  void forget_earlier() noexcept;

  /// True if there are results of a run, and no such folder; an empty one is removed.
  static bool has_ended(const std::filesystem::path& destination);

  ~Working_folder() override;

  std::filesystem::path results() const { return path_ / "results"; }
  std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }
  /// True if the results were put in place before, and only this folder could not be removed.
  bool is_done() const { return is_done_; }

  /// Of one that was taken up: it was begun to replace an earlier run of that name. A copy replaces none.
  /// \throw Error(usage) if the destination is there, and is not to be replaced
  void allow_replacing(const std::string& name);

  void prepare() override;
  void put() override;
  void take_back() noexcept override;
  void settle() noexcept override;
  bool can_be_taken_back() const override { return true; }

 private:
  explicit Working_folder(const std::filesystem::path& destination);
  void lock();
  std::string shown() const;
  bool are_results_in_place() const;
  std::filesystem::path earlier(const char* name) const { return path_ / (std::string(name) + ".before"); }
  void sort_out_earlier();
  void bring_earlier_back();
  void leave();
  void clear();
  [[noreturn]] void refuse_destination(Error_code code) const;

  std::filesystem::path name_, destination_, path_;  ///< the given name, its target, that with .part
  io::Unfinished unfinished_;
  io::Replacement replacement_;
  int lock_ = -1;
  bool replaces_ = false, is_done_ = false;
  bool is_own_ = false;  ///< holds nothing of an earlier process
  bool is_new_ = false;  ///< the same, as this process made it, and no checkpoint
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_COMMON_WORKING_FOLDER_H
