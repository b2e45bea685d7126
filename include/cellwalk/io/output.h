// SPDX-License-Identifier: LGPL-3.0-or-later
// Several outputs that appear together or not at all.
#ifndef CELLWALK_IO_OUTPUT_H
#define CELLWALK_IO_OUTPUT_H

#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace cellwalk::io {

/// Something that is written beside its destination and put in its place in steps. Destroyed before put(), it leaves nothing behind.
class Output {
 public:
  Output() = default;
  virtual ~Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Finishes what is written: all that may well fail. \throw Error(other)
  virtual void prepare() = 0;
  /// Puts it in its place; what was there is kept. \throw Error(other)
  virtual void put() = 0;
  /// After put(): as before it.
  virtual void take_back() noexcept = 0;
  /// After put(): removes what was there.
  virtual void settle() noexcept = 0;
  /// False for devices and pipes, which are written by prepare().
  virtual bool can_be_taken_back() const = 0;
};

/// Puts all outputs in their places, or none: they are prepared, devices last, then put, then `finish` runs, and if any of that
/// throws, all are taken back. Signals wait while names change.
/// \throw Error(other) as the outputs do; whatever `finish` throws
void put_in_place(std::span<Output* const> outputs, const std::function<void()>& finish = {});

/// A file or an empty directory that discard_unfinished_files() removes while this lives.
class Unfinished {
 public:
  Unfinished() = default;
  ~Unfinished() { release(); }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// There is room for some tens of names at a time; more are not removed.
  void hold(const std::string& path);
  void release() noexcept;

 private:
  int slot_ = -1;
};

/// Gives a file or directory the name of another, which is kept under the first one's name.
class Replacement {
 public:
  /// False, and errno, where the system refuses.
  bool put(const std::filesystem::path& from, const std::filesystem::path& to);
  /// After put(): as it was before.
  void take_back(const std::filesystem::path& from, const std::filesystem::path& to) noexcept;

 private:
  bool had_old_ = false;
};

namespace detail {

/// Exchanges two names as well as a file system can that does not exchange them at once (NFS): a file is always there under the
/// second name, a directory is not for an instant. False, and errno, where the system refuses; then nothing has changed.
bool exchange_in_steps(const std::filesystem::path& a, const std::filesystem::path& b) noexcept;

}  // namespace detail

/// Removes whatever is Unfinished: temporary files of every Atomic_file not yet in its place. Safe to call from a signal handler, for
/// programs that must leave nothing behind when they are interrupted.
void discard_unfinished_files() noexcept;

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_OUTPUT_H
