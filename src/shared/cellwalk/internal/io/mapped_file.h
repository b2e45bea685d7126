// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that are used where they lie: pages are read when they are touched, and shared by all processes that
// map the same file, until one of them writes there.
#ifndef CELLWALK_INTERNAL_IO_MAPPED_FILE_H
#define CELLWALK_INTERNAL_IO_MAPPED_FILE_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace cellwalk::io {

/// The bytes of a file. Bytes written there are seen by this process only, and never stored.
struct Mapped_file {
  std::span<std::byte> bytes;         ///< from the beginning of a page on
  std::shared_ptr<const void> owner;  ///< they last as long as it is held
};

/// Maps a file; other sources, such as a pipe, are read. The file must not be cut short while it is mapped:
/// replace it by another one of its name instead, as all our writers do.
/// \throw Error(input) if it cannot be read
Mapped_file map_file(const std::filesystem::path& path);

/// True if a file, not a pipe, begins with some bytes.
bool begins_with(const std::filesystem::path& path, std::string_view beginning);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_MAPPED_FILE_H
