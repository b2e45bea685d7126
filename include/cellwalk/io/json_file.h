// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON files: scenes in, reports out.
#ifndef CELLWALK_IO_JSON_FILE_H
#define CELLWALK_IO_JSON_FILE_H

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads JSON; comments (// and /* */) are allowed, a key twice in one object is not.
/// \throw Error(input) with file and line
nlohmann::json read_json(const std::filesystem::path& path);
nlohmann::json parse_json(const std::string& name, std::string_view text);

/// Writes JSON, indented, keys in the order in which they were put in. Numbers read back the same. The file appears
/// complete or not at all. \throw Error(other)
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_JSON_FILE_H
