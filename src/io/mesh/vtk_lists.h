// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: lists of a legacy VTK file with which VTK would leave its memory, hidden from it.
#ifndef CELLWALK_IO_MESH_VTK_LISTS_H
#define CELLWALK_IO_MESH_VTK_LISTS_H

#include <optional>
#include <string>

namespace cellwalk::io {

/// VTK finds a list by its keyword, as in CELLS 2 10, wherever it looks for one: also within a word, or right
/// after binary values. Names may contain keywords too. So every keyword is examined, and where VTK would
/// read or write beyond its memory, or take memory that the file cannot fill, a letter of it is changed: VTK
/// refuses such a list then, and a name with another letter does no harm, since names are not read.
/// \return the first problem
/// Cost: linear in the size of the file.
std::optional<std::string> hide_broken_lists(std::string& bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_VTK_LISTS_H
