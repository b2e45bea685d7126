// SPDX-License-Identifier: LGPL-3.0-or-later
// Output files that appear complete or not at all.
#ifndef CELLWALK_IO_ATOMIC_FILE_H
#define CELLWALK_IO_ATOMIC_FILE_H

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// A file written beside its destination and renamed on commit(). Destroyed without commit() it leaves nothing behind,
/// and an older file of that name as it was. A destination that is a device or pipe (/dev/stdout) is written directly.
class Atomic_file {
 public:
  /// \throw Error(other) if the directory does not exist or cannot be written
  explicit Atomic_file(std::filesystem::path destination);
  ~Atomic_file();
  Atomic_file(const Atomic_file&) = delete;
  Atomic_file& operator=(const Atomic_file&) = delete;

  /// Appends. \throw Error(other) where the device is full
  void write(std::string_view text);

  /// Flushes and renames. \throw Error(other) if either fails; nothing is left behind then
  void commit();

  const std::filesystem::path& destination() const { return destination_; }

 private:
  void flush();
  void discard() noexcept;
  [[noreturn]] void fail(const char* what);

  std::filesystem::path destination_;
  std::string temporary_;  ///< empty where the destination is written directly
  std::string buffer_;
  int descriptor_ = -1;
  int slot_ = -1;
};

/// Writes a whole file at once, atomically. \throw Error(other)
void write_file(const std::filesystem::path& destination, std::string_view text);

/// Removes the temporary files of every Atomic_file not yet committed. Safe to call from a signal handler, for programs
/// that must leave nothing behind when they are interrupted.
void discard_unfinished_files() noexcept;

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_ATOMIC_FILE_H
