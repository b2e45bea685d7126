// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON reports.
#ifndef CELLWALK_INTERNAL_IO_JSON_FILE_H
#define CELLWALK_INTERNAL_IO_JSON_FILE_H

#include <cellwalk/io/atomic_file.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace cellwalk::io {

/// Writes JSON, indented, keys in the order of insertion. Numbers read back the same; those that are not
/// finite become null. The file appears complete or not at all.
/// \throw Error(other) if it cannot be written
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value);

/// Writes into a file that the caller commits.
void write_json(Atomic_file& file, const nlohmann::ordered_json& value);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_JSON_FILE_H
