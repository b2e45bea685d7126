// SPDX-License-Identifier: LGPL-3.0-or-later
// Recordings of runs for `cellwalk view`. The format is described in docs/formats.md.
//
// Positions are rounded to 16 bits of the environment's bounding box: they are for display, and no decision
// uses them.
#ifndef CELLWALK_INTERNAL_IO_RECORDING_FILE_H
#define CELLWALK_INTERNAL_IO_RECORDING_FILE_H

#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/records/recording.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cellwalk::io {

/// Writes a recording frame by frame; the file appears on commit() or not at all.
class Recording_writer {
 public:
  /// \pre indices of the scene are in range, and its box contains all moving points; points outside are moved
  ///      to its side
  /// \throw Error(other) if the file cannot be written
  Recording_writer(std::filesystem::path path, Recording_scene scene);
  /// \param file that gets the content, not compressed unless it does that
  /// \param is_continued the file has the head before the first frame already, and archive() is called next
  Recording_writer(std::unique_ptr<Byte_sink> file, Recording_scene scene, bool is_continued = false);

  /// Appends a frame.
  /// \pre it has as many positions, cells and decisions as the scene, and points of walls that were added
  /// Cost: a few bytes a point.
  void add(const Recording_frame& record);

  /// \throw Error(usage) unless there are as many frames as the scene has; Error(other) if the file cannot be
  ///        written
  void commit();

  std::uint32_t frame_count() const { return records_; }

  /// All that later frames depend on.
  template <class Archive>
  void archive(Archive& a) {
    std::vector<std::uint32_t> vertices;
    for (const Recording_body& body : scene_.bodies) vertices.push_back(body.vertices);
    a(scene_.dimension, scene_.steps, scene_.every, scene_.particles, scene_.lower, scene_.upper,
      scene_.walls_move, scene_.walls_change, vertices);
    a(wall_points_, records_, last_, before_last_, last_cells_);
    if constexpr (Archive::is_reading) {
      scene_.bodies.resize(vertices.size());
      for (std::size_t i = 0; i < vertices.size(); ++i) scene_.bodies[i].vertices = vertices[i];
    }
  }

 private:
  void write_head();
  std::uint16_t rounded(double x, std::size_t axis) const;
  void add_points(const std::vector<Point<3>>& points);

  std::unique_ptr<Byte_sink> file_;
  Recording_scene scene_;
  std::size_t wall_points_;  ///< so far
  std::uint32_t records_ = 0;
  std::vector<std::vector<std::uint16_t>> last_, before_last_;  ///< positions of the previous frames, by axis
  std::vector<std::uint32_t> last_cells_;
};

struct Recording {
  Recording_scene scene;
  std::string packed;  ///< the compressed content of the file
};

/// Reads a recording and checks its checksum, counts and indices. Frames stay compressed;
/// of them the walls that come and go are checked.
/// \throw Error(input) `FILE: problem, and remedy`
Recording read_recording(const std::filesystem::path& path);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_RECORDING_FILE_H
