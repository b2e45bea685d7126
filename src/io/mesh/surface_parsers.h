// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: one parser per surface format. Each throws Error(input) with file and line.
#ifndef CELLWALK_IO_MESH_SURFACE_PARSERS_H
#define CELLWALK_IO_MESH_SURFACE_PARSERS_H

#include <cellwalk/internal/io/parse_surface.h>
#include <cellwalk/io/mesh_file.h>

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::io {

/// The parts of a body beside polygons. A parser without one skips lines, which a surface does not need.
struct Body_elements {
  bool planar = false;  ///< input: true for a 2D body, of which points with z other than 0 are refused
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< output: lines, cut into edges
  std::vector<double> radii = {};                   ///< output: of the edges; none, or one for each
};

Surface_soup parse_off(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body = nullptr);
Surface_soup parse_obj(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body = nullptr);
Surface_soup parse_stl(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body = nullptr);
Surface_soup parse_ply(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body = nullptr);

/// True if the size is that of a binary STL file with as many triangles as it announces.
bool is_binary_stl(std::string_view bytes);

/// The parser of a format. The caller checks whether there are polygons.
Surface_soup parse_polygons(const std::string& name, std::string_view bytes, Surface_format format,
                            Read_report& report, Body_elements* body = nullptr);

/// Refuses a point with z other than 0 of a 2D body; `in` has its place in the file.
template <class Reader>
void check_planar(const Reader& in, const Body_elements* body, const Point<3>& p) {
  if (body && body->planar && p[2] != 0)
    in.fail(fmt::format("z is {}, in a 2D body: make every z zero, or use it in 3D", p[2]));
}

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_SURFACE_PARSERS_H
