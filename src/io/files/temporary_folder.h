// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: a folder for a library that reads only files.
#ifndef CELLWALK_IO_FILES_TEMPORARY_FOLDER_H
#define CELLWALK_IO_FILES_TEMPORARY_FOLDER_H

#include <cellwalk/internal/io/output.h>
#include <cellwalk/kernel/error.h>

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// A temporary folder with a new name for one file, removed with it at the end of its lifetime.
class Temporary_folder {
 public:
  Temporary_folder() : path_((std::filesystem::temp_directory_path() / "cellwalk-XXXXXX").string()) {
    if (!unfinished_.make(path_, [this] { return mkdtemp(path_.data()) != nullptr; }))
      throw Error(Error_code::other, path_ + ": no temporary folder can be made: set TMPDIR");
  }
  ~Temporary_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Temporary_folder(const Temporary_folder&) = delete;
  Temporary_folder& operator=(const Temporary_folder&) = delete;

  /// Writes the file into the folder; returns its path.
  /// \throw Error(other) if the device is full
  std::string write(const std::string& name, std::string_view bytes) {
    std::string path = path_ + "/" + name;
    unfinished_file_.hold(path);
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw Error(Error_code::other, path + ": a temporary file cannot be written: set TMPDIR");
    return path;
  }

 private:
  std::string path_;
  Unfinished unfinished_, unfinished_file_;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_FILES_TEMPORARY_FOLDER_H
