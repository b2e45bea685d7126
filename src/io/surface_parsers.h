// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: one parser per surface format. Each throws Error(input) with file and line.
#ifndef CELLWALK_IO_SURFACE_PARSERS_H
#define CELLWALK_IO_SURFACE_PARSERS_H

#include <cellwalk/io/surface_file.h>

namespace cellwalk::io {

Surface_soup parse_off(const std::string& name, std::string_view bytes, Read_report& report);
Surface_soup parse_obj(const std::string& name, std::string_view bytes, Read_report& report);
Surface_soup parse_stl(const std::string& name, std::string_view bytes, Read_report& report);
Surface_soup parse_ply(const std::string& name, std::string_view bytes, Read_report& report);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_SURFACE_PARSERS_H
