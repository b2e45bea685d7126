// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of compiled environments.
#ifndef CELLWALK_LOADING_COMPILED_FILE_H
#define CELLWALK_LOADING_COMPILED_FILE_H

#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/io/mesh_file.h>

#include <optional>
#include <string>

namespace cellwalk {

inline constexpr const char* compiled_format = "Cellwalk, compiled";

/// A file of cells, compiled or of any other format. A source that can be read only once, such as a pipe, is
/// read when this is made.
class Cells_input {
 public:
  /// \throw Error(input) if a pipe cannot be read
  explicit Cells_input(std::string path);

  bool is_compiled() const { return is_compiled_; }

  /// \pre is_compiled()
  /// \throw Error(input) naming the file if it is not readable, or damaged
  Any_compiled_environment open() const;

  /// The cells; those of a compiled environment are like those of other files.
  /// \throw Error(input) as open(), and as io::read_mesh()
  io::Mesh_file mesh() const;

 private:
  std::string path_;
  std::optional<io::Mapped_file> pipe_;
  bool is_compiled_;
};

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_COMPILED_FILE_H
