// SPDX-License-Identifier: GPL-3.0-or-later
// A file without a name, in memory: the input of a process, and its output. Unlike a pipe it is never full or
// empty, so that nobody waits for anybody.
#ifndef CELLWALK_MESHING_CHILD_MEMORY_FILE_H
#define CELLWALK_MESHING_CHILD_MEMORY_FILE_H

#include <cstddef>
#include <span>
#include <vector>

namespace cellwalk::detail {

class Memory_file {
 public:
  /// \throw Error(other) if the system has no more memory or files
  Memory_file();
  ~Memory_file();
  Memory_file(const Memory_file&) = delete;
  Memory_file& operator=(const Memory_file&) = delete;

  int descriptor() const { return descriptor_; }

  /// Appends bytes.
  /// \throw Error(other)
  void write(std::span<const std::byte> bytes);
  /// The next read begins at the first byte.
  void rewind();
  /// The content from its beginning.
  /// \throw Error(other)
  std::vector<std::byte> read(std::size_t most = static_cast<std::size_t>(-1)) const;

 private:
  int descriptor_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_CHILD_MEMORY_FILE_H
