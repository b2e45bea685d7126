// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: readers that use large libraries are separate modules, loaded when the first file needs
// them. A program that reads no such file starts and links without the libraries.
#ifndef CELLWALK_IO_MESH_READER_MODULE_H
#define CELLWALK_IO_MESH_READER_MODULE_H

#include <string>
#include <string_view>

#include "element_soup.h"
#include "format.h"

namespace cellwalk::io {

/// The input of a module.
struct Reader_input {
  std::string_view bytes;  ///< the whole file, inflated
  Format format;
};

/// The description of a module.
struct Reader_module {
  const char* cellwalk;  ///< the version of Cellwalk that it belongs to
  const char* library;   ///< the version of the library
  /// \throw Error(input) with the name of the file
  Element_soup (*read)(const std::string& name, const Reader_input& input, Read_report& report);
};

/// The name of the function by which a module returns its description.
inline constexpr const char* reader_module_entry = "cellwalk_reader_module";
using Reader_module_entry = const Reader_module* (*)();

/// A module, found and loaded at the first call by load_module(). Null, with the problem, if it cannot be
/// loaded or belongs to another version. Thread-safe.
struct Loaded_module {
  const Reader_module* module = nullptr;
  std::string problem;
};
const Loaded_module& vtk_module();

}  // namespace cellwalk::io

#define CELLWALK_READER_MODULE(module)                                                 \
  extern "C" const cellwalk::io::Reader_module* cellwalk_reader_module();              \
  extern "C" __attribute__((visibility("default"))) const cellwalk::io::Reader_module* \
  cellwalk_reader_module() {                                                           \
    return &module;                                                                    \
  }

#endif  // CELLWALK_IO_MESH_READER_MODULE_H
