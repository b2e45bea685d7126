// SPDX-License-Identifier: LGPL-3.0-or-later
// Output files that appear complete or not at all.
#ifndef CELLWALK_INTERNAL_IO_ATOMIC_FILE_H
#define CELLWALK_INTERNAL_IO_ATOMIC_FILE_H

#include <cellwalk/internal/io/output.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// A file that is written beside its destination and moved there on commit(). If it is destroyed without
/// commit(), it leaves nothing behind, and an older file of that name unchanged. A replacement keeps the
/// permissions of the old file, and a link its target. A destination that is a device, a pipe or a descriptor
/// of the process (/dev/stdout, /dev/fd/3) is written directly, on prepare() or commit() and not before.
class Atomic_file final : public Output, public Byte_sink {
 public:
  /// \throw Error(other) if the destination or its directory does not exist, or may not be written
  explicit Atomic_file(std::filesystem::path destination);
  ~Atomic_file() override;

  /// Appends.
  /// \throw Error(other) if the device is full
  void write(std::string_view text) override;

  /// Executes all steps, for a single file.
  /// \throw Error(other) if one fails; then nothing is left behind
  void commit() override;

  /// From now on, files that put() puts in place survive a loss of power.
  void make_durable() { is_durable_ = true; }

  void prepare() override;
  void put() override;
  void take_back() noexcept override;
  void settle() noexcept override;
  bool can_be_taken_back() const override { return !is_direct_; }

  const std::filesystem::path& destination() const { return destination_; }

 private:
  void flush();
  void sync_name();
  void discard() noexcept;
  [[noreturn]] void fail(const char* what);

  std::filesystem::path destination_, target_;  ///< as given, and with links resolved
  std::string temporary_;                       ///< empty if there is none
  std::string buffer_;
  Unfinished unfinished_;
  Replacement replacement_;
  int descriptor_ = -1;
  bool is_direct_ = false, is_durable_ = false;
};

/// Writes a whole file atomically.
/// \throw Error(other) if it cannot be written
void write_file(const std::filesystem::path& destination, std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_ATOMIC_FILE_H
