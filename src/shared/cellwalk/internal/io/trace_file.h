// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of traces. The formats are described in docs/formats.md.
#ifndef CELLWALK_INTERNAL_IO_TRACE_FILE_H
#define CELLWALK_INTERNAL_IO_TRACE_FILE_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/records/body_trace.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads a whole trace into memory; the file may be compressed with gzip. Nothing is repaired, and no memory
/// is allocated for counts before they are checked against the size of the file.
/// \throw Error(input) `FILE: problem, and remedy`: not a trace, truncated or too long for its counts, a grid
///        without cells or too large, solid cells not ascending or outside the grid, bodies that break the
///        rules of Body_soup, bodies with a radius where touches block, numbers that are not finite, answers
///        with an unknown bit
Body_trace read_trace(const std::filesystem::path& path);

/// Reads from bytes in memory.
/// \param name stands for the file in errors
Body_trace parse_trace(const std::string& name, std::string_view bytes);

/// Writes a trace, which reads back the same, bit for bit, into a file that the caller commits.
/// \pre the lengths of arrays agree with the counts
/// \throw Error(usage) if they do not, or if read_trace() would refuse the trace; Error(other) if the file
///        cannot be written
void write_trace(Atomic_file& file, const Body_trace& trace);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_TRACE_FILE_H
