// SPDX-License-Identifier: LGPL-3.0-or-later
// Traces of figure 8 in files: FILE.bin is the trace, FILE.json says how it was made.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_FILES_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_FILES_H

#include <filesystem>

#include "peers/hexahedra_trace.h"

namespace cellwalk::figure_8 {

/// \throw std::exception if a file cannot be read, or the trace has other bodies than hexahedra, no grid, or
///        no answers that count touches as hits
Trace read_hexahedra(const std::filesystem::path& file);

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_TRACE_FILES_H
