// SPDX-License-Identifier: LGPL-3.0-or-later
// Names of places in a file.
#ifndef CELLWALK_INTERNAL_IO_NAMED_POINTS_H
#define CELLWALK_INTERNAL_IO_NAMED_POINTS_H

#include <cellwalk/kernel/point.h>

#include <filesystem>
#include <map>
#include <string>

namespace cellwalk::io {

/// Reads a JSON file of names with points: {"inlet": [x, y, z], ...}.
/// \throw Error(input) with the file, and the line or the name
std::map<std::string, Point<3>> read_named_points(const std::filesystem::path& path);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_NAMED_POINTS_H
