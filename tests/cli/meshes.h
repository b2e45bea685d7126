// SPDX-License-Identifier: LGPL-3.0-or-later
// Small files that tests write for the program to read.
#ifndef CELLWALK_TESTS_CLI_MESHES_H
#define CELLWALK_TESTS_CLI_MESHES_H

#include <cmath>
#include <numbers>
#include <string>

namespace cellwalk::test {

/// A cube of side `size` whose lower corner is (x,x,x), as an OFF surface of 12 triangles facing outwards.
inline std::string cube_off(double size = 1, double x = 0, bool inside_out = false) {
  std::string text = "OFF\n8 12 0\n";
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      text += std::to_string(x + (i >> axis & 1 ? size : 0)) + (axis == 2 ? "\n" : " ");
  const int triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (const auto& t : triangles)
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[inside_out ? 2 : 1]) + " " +
            std::to_string(t[inside_out ? 1 : 2]) + "\n";
  return text;
}

/// The cube without its last triangle.
inline std::string open_cube_off() {
  std::string text = cube_off();
  text.replace(text.find("8 12 0"), 6, "8 11 0");
  text.erase(text.rfind("3 1 7 5"));
  return text;
}

/// A tube of radius 1 and length 4 with 41 rings of 16 vertices, as an OFF surface.
inline std::string tube_off() {
  constexpr int sides = 16, rings = 41;
  constexpr int triangles = 2 * sides * (rings - 1) + 2 * (sides - 2);
  std::string text = "OFF\n" + std::to_string(sides * rings) + " " + std::to_string(triangles) + " 0\n";
  for (int v = 0; v < sides * rings; ++v) {
    const double angle = 2 * std::numbers::pi * (v % sides) / sides;
    text += std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
            std::to_string(0.1 * (v / sides)) + "\n";
  }
  const auto add = [&text](int a, int b, int c) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int a = 0; a < sides * (rings - 1); ++a) {
    const int b = a % sides == sides - 1 ? a + 1 - sides : a + 1;
    add(a, b, b + sides);
    add(a, b + sides, a + sides);
  }
  constexpr int last = sides * (rings - 1);
  for (int i = 1; i + 1 < sides; ++i) {
    add(0, i + 1, i);
    add(last, last + i, last + i + 1);
  }
  return text;
}

/// One hexahedron of MEDIT's .mesh, its corner 7 moved out by `bulge` along the diagonal: any bulge leaves
/// three facets that are not planar.
inline std::string hexahedron_ovm(double bulge) {
  std::string text = "OVM ASCII\nVertices\n8\n";
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis)
      text += std::to_string((i >> axis & 1) + (i == 7 ? bulge : 0)) + (axis == 2 ? "\n" : " ");
  text += "Edges\n12\n0 1\n1 3\n3 2\n2 0\n4 5\n5 7\n7 6\n6 4\n0 4\n1 5\n2 6\n3 7\n";
  // Halfedge 2e runs along edge e, 2e+1 against it; loops face outwards.
  text += "Faces\n6\n4 7 5 3 1\n4 8 10 12 14\n4 0 18 9 17\n4 20 13 23 4\n4 16 15 21 6\n4 2 22 11 19\n";
  text += "Polyhedra\n1\n6 0 2 4 6 8 10\n";
  return text;
}

/// A planar domain: a square room of side 4 with a square hole of side 1 in its middle.
inline std::string room_poly() {
  return "8 2 0 0\n"
         "1 0 0\n2 4 0\n3 4 4\n4 0 4\n5 1.5 1.5\n6 2.5 1.5\n7 2.5 2.5\n8 1.5 2.5\n"
         "8 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n"
         "1\n1 2 2\n";
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_CLI_MESHES_H
