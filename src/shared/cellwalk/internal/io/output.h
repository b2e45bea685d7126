// SPDX-License-Identifier: LGPL-3.0-or-later
// Several outputs that appear together or not at all.
#ifndef CELLWALK_INTERNAL_IO_OUTPUT_H
#define CELLWALK_INTERNAL_IO_OUTPUT_H

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// An output that is written beside its destination and moved there in steps. If it is destroyed before
/// put(), it leaves nothing behind.
class Output {
 public:
  Output() = default;
  virtual ~Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Completes the output, with all operations that are likely to fail.
  /// \throw Error(other) if one fails
  virtual void prepare() = 0;
  /// Moves the output to its destination, and keeps the old content.
  /// \throw Error(other) if that fails
  virtual void put() = 0;
  /// Undoes put().
  virtual void take_back() noexcept = 0;
  /// After put(), removes the old content.
  virtual void settle() noexcept = 0;
  /// False for devices and pipes, which are written by prepare().
  virtual bool can_be_taken_back() const = 0;
};

/// A file that is written from its beginning to its end.
class Byte_sink {
 public:
  Byte_sink() = default;
  virtual ~Byte_sink() = default;
  Byte_sink(const Byte_sink&) = delete;
  Byte_sink& operator=(const Byte_sink&) = delete;

  /// Appends.
  /// \throw Error(other) if the device is full
  virtual void write(std::string_view bytes) = 0;
  /// Completes it.
  /// \throw Error(other) if that fails
  virtual void commit() = 0;
};

/// Moves all outputs to their destinations, or none. They are prepared, devices last, then put, then `finish`
/// runs; if any of these throws, all are taken back. Signals are blocked while names change.
/// \throw Error(other) as the outputs; any exception of `finish`
void put_in_place(std::span<Output* const> outputs, const std::function<void()>& finish = {});

/// Registers a file, or a directory with all that is in it, for discard_unfinished_files(), during the
/// lifetime of this object.
class Unfinished {
 public:
  Unfinished() = default;
  ~Unfinished() { release(); }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// Registers a name. Some tens of names can be registered at a time; others are not removed.
  void hold(const std::string& path);
  /// Makes and registers it, with no signal in between; returns false if `make` does.
  bool make(const std::string& path, const std::function<bool()>& make);
  void release() noexcept;

 private:
  int slot_ = -1;
};

/// Moves a file or directory to a name, and the one that has that name to the old name.
class Replacement {
 public:
  /// Returns false and sets errno if the system refuses: to EEXIST if something is there that must stay.
  bool put(const std::filesystem::path& from, const std::filesystem::path& to, bool may_replace = true);
  /// Undoes the exchange.
  void take_back(const std::filesystem::path& from, const std::filesystem::path& to) const noexcept;

 private:
  bool had_old_ = false;
};

namespace detail {

/// Exchanges two names on a file system without an atomic exchange (NFS): a file always exists under the
/// second name, a directory does not for an instant. Returns false and sets errno if the system refuses; then
/// nothing has changed.
bool exchange_in_steps(const std::filesystem::path& a, const std::filesystem::path& b) noexcept;

/// Moves a directory to a name that nothing has, on a file system that cannot refuse names which are taken.
/// An entry that takes the name at the same moment stays, unless it is an empty directory. Returns false, and
/// sets errno, if the system refuses.
bool move_in_steps(const std::filesystem::path& from, const std::filesystem::path& to) noexcept;

}  // namespace detail

/// The file to which a name refers, followed through links, even where there is no such file yet. Relative
/// names may stay relative.
std::filesystem::path target_of(const std::filesystem::path& name);

/// Removes everything that is Unfinished, such as the temporary files of uncommitted Atomic_files. Safe to
/// call from a signal handler, for programs that leave nothing behind when they are interrupted.
/// \param for_good the program ends: other threads that would make a file wait for that
void discard_unfinished_files(bool for_good = false) noexcept;

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_OUTPUT_H
