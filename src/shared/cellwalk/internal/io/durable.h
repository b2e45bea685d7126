// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that survive a loss of power: once a function has returned, its data are on the device.
#ifndef CELLWALK_INTERNAL_IO_DURABLE_H
#define CELLWALK_INTERNAL_IO_DURABLE_H

#include <cellwalk/internal/io/output.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace cellwalk::io {

/// Waits until the content of a file, or the names in a folder, are on the device.
/// \throw Error(other) naming the file
void sync(const std::filesystem::path& path);

/// The same of a folder, all that is in it, and its own name.
void sync_all(const std::filesystem::path& folder);

/// Writes a whole file, first beside its destination, and waits until content and name are on the device.
/// After a loss of power at any moment the file is the old one or the new one.
/// \throw Error(other) naming the file; then nothing is left beside it
void write_durably(const std::filesystem::path& destination,
                   std::span<const std::span<const std::byte>> pieces);

/// Removes the unfinished files that processes which were killed left beside the destination of an
/// Atomic_file.
void remove_abandoned(const std::filesystem::path& destination);

/// A file that grows where it is, and may be taken up again: all beyond the length that was kept is cut off.
class Growing_file final : public Byte_sink {
 public:
  /// \param length of the part of the old file that is kept; 0 makes a new file
  /// \throw Error(other) if it cannot be written; Error(input) if it is missing, or shorter than that
  explicit Growing_file(std::filesystem::path path, std::uint64_t length = 0);
  ~Growing_file() override;

  void write(std::string_view bytes) override;
  void commit() override;
  /// Waits until all that was written is on the device, and returns its length.
  /// \throw Error(other) if that fails
  std::uint64_t sync();

  const std::filesystem::path& path() const { return path_; }

 private:
  void flush();
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  std::string buffer_;
  std::uint64_t length_ = 0;
  int descriptor_ = -1;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_DURABLE_H
