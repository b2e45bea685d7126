// SPDX-License-Identifier: LGPL-3.0-or-later
// Files with changes of an environment: JSON, as in scenes but without steps. See docs/cutting.md.
#ifndef CELLWALK_INTERNAL_IO_CHANGES_FILE_H
#define CELLWALK_INTERNAL_IO_CHANGES_FILE_H

#include <cellwalk/internal/records/environment_change.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads `{"groups": {...}, "changes": [...]}`. Unknown, repeated and missing keys are refused, as are
/// wrong types.
/// \throw Error(input) `FILE: key.path[2].key: problem`, or `FILE:LINE: ...` if the file is not JSON
template <int D>
Environment_changes<D> read_changes(const std::filesystem::path& path);

/// Reads from text in memory.
/// \param name stands for the file in errors
template <int D>
Environment_changes<D> parse_changes(const std::string& name, std::string_view text);

extern template Environment_changes<2> read_changes(const std::filesystem::path&);
extern template Environment_changes<3> read_changes(const std::filesystem::path&);
extern template Environment_changes<2> parse_changes(const std::string&, std::string_view);
extern template Environment_changes<3> parse_changes(const std::string&, std::string_view);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_CHANGES_FILE_H
