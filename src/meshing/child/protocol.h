// SPDX-License-Identifier: GPL-3.0-or-later
// The protocol of the library and its helper programs. A helper is called
//
//   cellwalk-MESHER VERSION PARENT OPTION...
//
// with the version of the library, the process that called it, and options of the mesher. It reads a
// Mesher_input from standard input, writes a Mesher_output to descriptor 3, and complains on standard error.
#ifndef CELLWALK_MESHING_CHILD_PROTOCOL_H
#define CELLWALK_MESHING_CHILD_PROTOCOL_H

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cellwalk::detail {

inline constexpr int output_descriptor = 3;

/// How a helper ends, but for 0: that it is done. A number that TetGen throws is added to `mesher_failed`.
enum Helper_exit : int {
  mesher_failed = 10,  ///< for a reason that TetGen gives, or that standard error has
  out_of_memory = 11,
  cut_short = 90,     ///< the input ends too early, or the output cannot be written
  other_version = 91  ///< it does not belong to the library that called it
};

/// Triangles of one or several surfaces, whose points are numbered through.
struct Mesher_input {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> surfaces;  ///< that each triangle belongs to

  template <class Archive>
  void archive(Archive& a) {
    a(points, triangles, surfaces);
  }
};

struct Mesher_output {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  /// Mesh_3: facets of the boundary, the distance to the surface and from it
  std::array<double, 3> measures{};

  template <class Archive>
  void archive(Archive& a) {
    a(points, tetrahedra, measures);
  }
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_CHILD_PROTOCOL_H
