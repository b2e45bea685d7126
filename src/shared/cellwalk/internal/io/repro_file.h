// SPDX-License-Identifier: LGPL-3.0-or-later
// Repro files: one motion with its environment, as JSON. The format is described in docs/formats.md.
#ifndef CELLWALK_INTERNAL_IO_REPRO_FILE_H
#define CELLWALK_INTERNAL_IO_REPRO_FILE_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/records/repro.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Writes a repro file. Coordinates read back the same.
/// \throw Error(other) if the file cannot be written
template <int D>
void write_repro(const std::filesystem::path& path, const Repro<D>& record);

/// Writes into a file that the caller commits.
template <int D>
void write_repro(Atomic_file& file, const Repro<D>& record);

/// Reads a repro file. Unknown and missing keys, wrong types and indices out of range are refused.
/// \throw Error(input) `FILE: key.path: problem`
Any_repro read_repro(const std::filesystem::path& path);

/// Reads from text in memory.
/// \param name stands for the file in errors
Any_repro parse_repro(const std::string& name, std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_REPRO_FILE_H
