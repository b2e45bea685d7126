// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON reports.
#ifndef CELLWALK_IO_JSON_FILE_H
#define CELLWALK_IO_JSON_FILE_H

#include <cellwalk/io/atomic_file.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace cellwalk::io {

/// Writes JSON, indented, keys in the order in which they were put in. Numbers read back the same; those that are not
/// finite become null. The file appears complete or not at all. \throw Error(other)
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value);

/// The same into a file that the caller commits.
void write_json(Atomic_file& file, const nlohmann::ordered_json& value);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_JSON_FILE_H
