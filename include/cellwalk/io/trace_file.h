// SPDX-License-Identifier: LGPL-3.0-or-later
// Trace files (magic `ECCDTRC1`, little endian). The format is described in docs/formats.md.
#ifndef CELLWALK_IO_TRACE_FILE_H
#define CELLWALK_IO_TRACE_FILE_H

#include <cellwalk/io/atomic_file.h>
#include <cellwalk/records/trace.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Reads a trace whole into memory; the file may be compressed with gzip. Nothing is repaired, and no memory is asked for by
/// a count that the file only announces.
/// \throw Error(input) `FILE: what, and what to do`: no trace, cut short or too long for its counts, a grid without cells or
///        of more than 32-bit indices name, obstacles not ascending or outside the grid, padding that is not zero, numbers
///        that are not finite, answers with an unknown bit
Trace read_trace(const std::filesystem::path& path);

/// The same from bytes in memory; `name` stands for the file in errors.
Trace parse_trace(const std::string& name, std::string_view bytes);

/// Writes a trace; what is written and read again is the same, bit for bit. The file appears complete or not at all.
/// \pre the arrays are as long as the counts say
/// \throw Error(usage) where they are not, or where the trace is one that read_trace refuses; Error(other) where the file
///        cannot be written
void write_trace(const std::filesystem::path& path, const Trace& trace);

/// The same into a file that the caller commits.
void write_trace(Atomic_file& file, const Trace& trace);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_TRACE_FILE_H
