// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of one recorded motion: JSON. The format is described in docs/formats.md.
#ifndef CELLWALK_IO_MOTION_RECORD_FILE_H
#define CELLWALK_IO_MOTION_RECORD_FILE_H

#include <cellwalk/io/atomic_file.h>
#include <cellwalk/records/motion_record.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Coordinates are written so that they read back the same. \throw Error(other) where the file cannot be written
template <int D>
void write_motion_record(const std::filesystem::path& path, const Motion_record<D>& record);

/// The same into a file that the caller commits.
template <int D>
void write_motion_record(Atomic_file& file, const Motion_record<D>& record);

/// Nothing is guessed: unknown and missing keys, wrong types and indices out of range are refused.
/// \throw Error(input) `FILE: key.path: what is wrong`
Any_motion_record read_motion_record(const std::filesystem::path& path);

/// The same from text in memory; `name` stands for the file in errors.
Any_motion_record parse_motion_record(const std::string& name, std::string_view text);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MOTION_RECORD_FILE_H
