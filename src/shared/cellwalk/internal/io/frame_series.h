// SPDX-License-Identifier: LGPL-3.0-or-later
// A time series for ParaView: frames as .vtu files, and a collection (.pvd) with their times.
#ifndef CELLWALK_INTERNAL_IO_FRAME_SERIES_H
#define CELLWALK_INTERNAL_IO_FRAME_SERIES_H

#include <cellwalk/internal/io/vtu.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cellwalk::io {

/// One file of a collection. Files of the same time and different parts are shown together.
struct Pvd_entry {
  double time = 0;
  std::string part;
  std::string file;  ///< relative to the collection

  /// See byte_archive.h.
  template <class Archive>
  void archive(Archive& a) {
    a(time, part, file);
  }
};

/// The text of a .pvd collection.
std::string pvd_text(const std::vector<Pvd_entry>& entries);

/// Writes `frames/PART_00000.vtu`, ... and a collection beside that folder. All files appear on commit(), and
/// replace an earlier series. If the object is destroyed without commit(), it leaves nothing behind, and an
/// earlier series unchanged.
class Frame_series {
 public:
  /// `collection` is the path of the .pvd file; its directory is created if it is missing.
  /// \throw Error(usage) if the folder `frames` there contains other files than .vtu, Error(other) if nothing
  ///        can be written
  explicit Frame_series(std::filesystem::path collection);
  ~Frame_series();
  Frame_series(const Frame_series&) = delete;
  Frame_series& operator=(const Frame_series&) = delete;

  /// Writes the next frame of `part`, a word such as "particles".
  /// \throw Error as write_vtu()
  void add(double time, const std::string& part, const Vtu_grid& grid);

  /// \throw Error(other) if the folder or the collection cannot be put in place
  void commit();

  std::size_t file_count() const { return entries_.size(); }

 private:
  std::filesystem::path collection_, frames_, temporary_;
  std::vector<std::filesystem::path> made_;  ///< directories created for this series, outermost first
  std::vector<Pvd_entry> entries_;
  std::map<std::string, std::size_t> count_;  ///< frames of each part
  bool committed_ = false;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_FRAME_SERIES_H
