// SPDX-License-Identifier: LGPL-3.0-or-later
// JSON reports.
#ifndef CELLWALK_INTERNAL_IO_JSON_FILE_H
#define CELLWALK_INTERNAL_IO_JSON_FILE_H

#include <cellwalk/internal/io/atomic_file.h>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// The maximum depth of nested lists and objects, far more than any valid file has. The JSON writer recurses
/// as deeply.
inline constexpr int deepest_nesting = 64;

/// Parses JSON with its keys in their order.
/// \throw Error(input) for nesting that is too deep; nlohmann::json::exception for text that is no JSON
nlohmann::ordered_json parse_ordered_json(const std::string& name, std::string_view text);

/// Writes JSON, indented, keys in the order of insertion. Numbers read back the same; those that are not
/// finite become null. The file appears complete or not at all.
/// \throw Error(other) if it cannot be written
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value);

/// Writes into a file that the caller commits.
void write_json(Atomic_file& file, const nlohmann::ordered_json& value);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_JSON_FILE_H
