// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: one parser per format of elements that is read here. Each throws Error(input) with file and
// line, or in binary files with the problem, and fills in the format and the notes of the report.
#ifndef CELLWALK_IO_MESH_ELEMENT_PARSERS_H
#define CELLWALK_IO_MESH_ELEMENT_PARSERS_H

#include <string>
#include <string_view>

#include "element_list.h"

namespace cellwalk::io {

Element_soup parse_medit(const std::string& name, std::string_view text, Lines lines, Read_report& report);
Element_soup parse_msh(const std::string& name, std::string_view bytes, Lines lines, Read_report& report);
Element_soup parse_unv(const std::string& name, std::string_view text, Lines lines, Read_report& report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_ELEMENT_PARSERS_H
