// SPDX-License-Identifier: LGPL-3.0-or-later
// Motion files: what moved in a run, for `cellwalk view`. The format is described in docs/formats.md.
//
// Positions are rounded to 16 bits of the environment's box: they are for pictures, nothing is decided by them.
#ifndef CELLWALK_IO_MOTION_FILE_H
#define CELLWALK_IO_MOTION_FILE_H

#include <cellwalk/io/gzip.h>
#include <cellwalk/records/motion.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellwalk::io {

/// Writes a motion record by record; the file appears on commit() or not at all.
class Motion_writer {
 public:
  /// \pre indices of the scene are in range, and its box holds what moves
  /// \throw Error(other) where the file cannot be written
  Motion_writer(std::filesystem::path path, Motion_scene scene);

  /// Appends a record. Cost: a few bytes a point. \pre as many positions, cells and decisions as the scene says
  void add(const Motion_frame& record);

  /// \throw Error(usage) unless there are as many records as the scene says; Error(other) if the file cannot be written
  void commit();

  std::uint32_t record_count() const { return records_; }

 private:
  Gzip_file file_;
  Motion_scene scene_;
  std::uint32_t records_ = 0;
  std::vector<std::uint16_t> last_, before_last_;  ///< positions of the records before, axis after axis
  std::vector<std::uint32_t> last_cells_;
};

struct Motion_file {
  Motion_scene scene;
  std::string packed;  ///< the whole file as it stands, compressed
};

/// Reads a motion file and checks it: its checksum, its size against its counts, indices. Records stay packed.
/// \throw Error(input) `FILE: what, and what to do`
Motion_file read_motion(const std::filesystem::path& path);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MOTION_FILE_H
