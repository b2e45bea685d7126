// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of body traces (magic `ECCDTRC2`, little endian). The format is described in docs/formats.md.
#ifndef CELLWALK_INTERNAL_IO_BODY_TRACE_FILE_H
#define CELLWALK_INTERNAL_IO_BODY_TRACE_FILE_H

#include <cellwalk/internal/records/body_trace.h>
#include <cellwalk/internal/records/trace.h>
#include <cellwalk/io/atomic_file.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

namespace cellwalk::io {

/// Reads a whole trace into memory; the file may be compressed with gzip. Nothing is repaired, and no memory
/// is allocated for counts before they are checked against the size of the file.
/// \throw Error(input) `FILE: problem, and remedy`: not a trace, truncated or too long for its counts, bodies
///        that break the rules of Body_soup, numbers that are not finite, answers with an unknown bit
Body_trace read_body_trace(const std::filesystem::path& path);

/// Reads from bytes in memory.
/// \param name stands for the file in errors
Body_trace parse_body_trace(const std::string& name, std::string_view bytes);

/// A trace of either kind, by what it begins with: one in a grid of unit cubes, or one of any bodies.
/// \throw Error(input) as read_trace() and read_body_trace()
std::variant<Trace, Body_trace> read_any_trace(const std::filesystem::path& path);
std::variant<Trace, Body_trace> parse_any_trace(const std::string& name, std::string_view bytes);

/// Writes a trace, which reads back the same, bit for bit, into a file that the caller commits.
/// \pre the lengths of arrays agree with the counts
/// \throw Error(usage) if they do not, or if read_body_trace() would refuse the trace; Error(other) if the
///        file cannot be written
void write_body_trace(Atomic_file& file, const Body_trace& trace);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_BODY_TRACE_FILE_H
