// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: what both formats of traces have in common.
#ifndef CELLWALK_IO_RESULTS_TRACE_PARTS_H
#define CELLWALK_IO_RESULTS_TRACE_PARTS_H

#include <cellwalk/internal/records/body_trace.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace cellwalk::io {

static_assert(sizeof(Point<3>) == 24 && std::endian::native == std::endian::little,
              "arrays are read and written as they lie in memory");

/// What a trace of hexahedra begins with. Such files are read, and no longer written.
constexpr std::string_view hexahedra_magic = "ECCDTRC1";

/// A trace that begins with hexahedra_magic.
/// \throw Error(input) as read_trace()
Body_trace parse_hexahedra(const std::string& name, std::string_view bytes);

/// What is wrong with a grid; empty if nothing.
std::string flaw_of_grid(const Traced_grid& grid);

/// Refuses a grid that is too large for a file of so many bytes.
/// \throw Error(input) naming the file
void check_grid_size(const std::string& name, const Traced_grid& grid, std::uint64_t bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_RESULTS_TRACE_PARTS_H
