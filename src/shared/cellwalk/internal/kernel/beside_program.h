// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that belong to this program or Python module: in the same build tree, or under the same prefix.
#ifndef CELLWALK_INTERNAL_KERNEL_BESIDE_PROGRAM_H
#define CELLWALK_INTERNAL_KERNEL_BESIDE_PROGRAM_H

#include <filesystem>
#include <vector>

namespace cellwalk::detail {

/// True if the file belongs to root or to the user, since it is executed.
bool is_trusted(const std::filesystem::path& file);

/// The trusted files of a relative path under every folder above the program and above the shared library
/// that contains this code, if it is in one; the nearest first.
std::vector<std::filesystem::path> beside_program(const std::filesystem::path& file);

/// The same under every folder above those in which the linker finds the libraries of the program.
std::vector<std::filesystem::path> beside_libraries(const std::filesystem::path& file);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_KERNEL_BESIDE_PROGRAM_H
