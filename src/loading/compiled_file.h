// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of compiled environments.
#ifndef CELLWALK_LOADING_COMPILED_FILE_H
#define CELLWALK_LOADING_COMPILED_FILE_H

#include <cellwalk/environment/compiled.h>
#include <cellwalk/io/mesh_file.h>

#include <string>

namespace cellwalk {

inline constexpr const char* compiled_format = "Cellwalk, compiled";

/// \throw Error(input) naming the file if it is not readable, or damaged
Any_compiled_environment open_compiled_file(const std::string& path);

/// The cells of a compiled environment, as those of other files.
io::Mesh_file read_compiled(const std::string& path);

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_COMPILED_FILE_H
