// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: readers of large libraries are modules of their own, loaded when the first file needs them. A program that reads no
// such file starts without the libraries, and links without them.
#ifndef CELLWALK_IO_MESH_READER_MODULE_H
#define CELLWALK_IO_MESH_READER_MODULE_H

#include <string>
#include <string_view>

#include "element_soup.h"
#include "format.h"
#include "gmsh_text.h"

namespace cellwalk::io {

enum class Lines { left_out, read };

/// What a module is given to read.
struct Reader_input {
  std::string_view bytes;  ///< the whole file, inflated
  Format format;
  std::string path;   ///< for Gmsh: a copy of the bytes, named so that it chooses the right reader
  Msh_counts counts;  ///< for Gmsh: what the file announces
  Lines lines = Lines::left_out;
};

/// What a module says of itself.
struct Reader_module {
  const char* cellwalk;  ///< the version of Cellwalk that it belongs to
  const char* library;   ///< the version of the library
  /// \throw Error(input) with the name of the file
  Element_soup (*read)(const std::string& name, const Reader_input& input, Read_report& report);
};

/// The function by which a module answers.
inline constexpr const char* reader_module_entry = "cellwalk_reader_module";
using Reader_module_entry = const Reader_module* (*)();

/// A module, found and loaded at the first call. It is sought in the folder that CELLWALK_READERS names; beside the program or Python
/// module in the build or prefix that it stands in; where the program was linked to look, and the system looks; where it was installed.
/// Null, and why, where it cannot be loaded, or belongs to another version. For several threads.
struct Loaded_module {
  const Reader_module* module = nullptr;
  std::string problem;
};
const Loaded_module& gmsh_module();
const Loaded_module& vtk_module();

}  // namespace cellwalk::io

#define CELLWALK_READER_MODULE(module)                                                 \
  extern "C" const cellwalk::io::Reader_module* cellwalk_reader_module();              \
  extern "C" __attribute__((visibility("default"))) const cellwalk::io::Reader_module* \
  cellwalk_reader_module() {                                                           \
    return &module;                                                                    \
  }

#endif  // CELLWALK_IO_MESH_READER_MODULE_H
