// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes of OpenFOAM, written as that program writes them: blocks of unit cubes, changed by the tests.
#ifndef CELLWALK_TESTS_IO_MESH_FOAM_MESH_H
#define CELLWALK_TESTS_IO_MESH_FOAM_MESH_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cellwalk::test {

struct Foam_mesh {
  struct Patch {
    std::string name, type;
    std::size_t first, size;
  };
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::int64_t>> faces;  ///< outward from their owners
  std::vector<std::int64_t> owner, neighbour;
  std::vector<Patch> patches;
};

/// How the files are written.
struct Foam_encoding {
  bool is_binary = false;
  int label_bits = 32, scalar_bits = 64;
  bool has_compact_faces = true;  ///< in a binary file; versions before 2 have lists of lists
  bool has_architecture = true;
};

/// A block of n x n x n unit cubes, of which the first two are one cell: a box with two facets on each of
/// its long sides. Patches are `inlet` (x = 0), `outlet` (x = n) and `sides`.
inline Foam_mesh foam_block(int n) {
  Foam_mesh mesh;
  const auto point = [n](int x, int y, int z) { return std::int64_t{(z * (n + 1) + y) * (n + 1) + x}; };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) mesh.points.push_back({double(x), double(y), double(z)});
  struct Face {
    std::vector<std::int64_t> loop;
    std::int64_t owner, neighbour;
    int patch;
  };
  std::map<std::vector<std::int64_t>, Face> faces;
  for (int c = 0; c < n * n * n; ++c) {
    const int x = c % n, y = c / n % n, z = c / n / n;
    const auto at = [&](int i) { return point(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)); };
    const int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int q = 0; q < 6; ++q) {
      std::vector<std::int64_t> loop;
      for (const int i : quads[q]) loop.push_back(at(i));
      std::vector<std::int64_t> key = loop;
      std::sort(key.begin(), key.end());
      const std::int64_t cell = std::max(c - 1, 0);
      const int patch = q == 0 ? 0 : q == 1 ? 1 : 2;
      const auto [face, is_new] = faces.try_emplace(key, Face{loop, cell, -1, patch});
      if (!is_new) face->second.neighbour = cell;
    }
  }
  std::vector<Face> sorted;
  for (const auto& [key, face] : faces)
    if (face.owner != face.neighbour) sorted.push_back(face);  // else it lies within the first cell
  std::stable_sort(sorted.begin(), sorted.end(), [](const Face& a, const Face& b) {
    const auto place = [](const Face& f) {
      return f.neighbour < 0 ? std::array<std::int64_t, 3>{1, f.patch, f.owner}
                             : std::array<std::int64_t, 3>{0, f.owner, f.neighbour};
    };
    return place(a) < place(b);
  });
  mesh.patches = {{"inlet", "patch", 0, 0}, {"outlet", "patch", 0, 0}, {"sides", "wall", 0, 0}};
  for (const Face& face : sorted) {
    mesh.faces.push_back(face.loop);
    mesh.owner.push_back(face.owner);
    if (face.neighbour >= 0)
      mesh.neighbour.push_back(face.neighbour);
    else
      ++mesh.patches[static_cast<std::size_t>(face.patch)].size;
  }
  std::size_t first = mesh.neighbour.size();
  for (auto& patch : mesh.patches) {
    patch.first = first;
    first += patch.size;
  }
  return mesh;
}

/// Makes the face between two cells a baffle: two faces of the patches `front` and `back`.
/// \pre there is such a face
inline void make_baffle(Foam_mesh& mesh, std::int64_t owner, std::int64_t neighbour,
                        const std::string& type = "wall") {
  std::size_t f = 0;
  while (mesh.owner.at(f) != owner || mesh.neighbour.at(f) != neighbour) ++f;
  std::vector<std::int64_t> loop = mesh.faces[f];
  mesh.faces.erase(mesh.faces.begin() + static_cast<std::ptrdiff_t>(f));
  mesh.owner.erase(mesh.owner.begin() + static_cast<std::ptrdiff_t>(f));
  mesh.neighbour.erase(mesh.neighbour.begin() + static_cast<std::ptrdiff_t>(f));
  for (auto& patch : mesh.patches) --patch.first;
  mesh.patches.push_back({"front", type, mesh.faces.size(), 1});
  mesh.patches.push_back({"back", type, mesh.faces.size() + 1, 1});
  mesh.faces.push_back(loop);
  std::reverse(loop.begin() + 1, loop.end());
  mesh.faces.push_back(loop);
  mesh.owner.push_back(owner);
  mesh.owner.push_back(neighbour);
}

/// The files of a mesh, by name.
class Foam_writer {
 public:
  explicit Foam_writer(const Foam_encoding& encoding = {}) : encoding_(encoding) {}

  std::map<std::string, std::string> files(const Foam_mesh& mesh) const {
    return {{"points", points(mesh)},
            {"faces", faces(mesh)},
            {"owner", header("labelList", "owner") + labels(mesh.owner) + end},
            {"neighbour", header("labelList", "neighbour") + labels(mesh.neighbour) + end},
            {"boundary", boundary(mesh)}};
  }

  std::string header(const std::string& type, const std::string& object) const {
    std::string text =
        "/*--------------------------------*- C++ -*----------------------------------*\\\n"
        "| =========                 |                                                 |\n"
        "\\*---------------------------------------------------------------------------*/\n"
        "FoamFile\n{\n    version     2.0;\n";
    text += std::string("    format      ") + (encoding_.is_binary ? "binary" : "ascii") + ";\n";
    if (encoding_.has_architecture)
      text += "    arch        \"LSB;label=" + std::to_string(encoding_.label_bits) +
              ";scalar=" + std::to_string(encoding_.scalar_bits) + "\";\n";
    return text + "    class       " + type + ";\n    note        \"a (note); {\";\n" +
           "    location    \"constant/polyMesh\";\n    object      " + object +
           ";\n}\n// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //\n\n";
  }

  std::string labels(const std::vector<std::int64_t>& values) const {
    std::string text = "\n" + std::to_string(values.size()) + "\n(";
    if (!encoding_.is_binary) text += "\n";
    for (const std::int64_t v : values)
      if (!encoding_.is_binary)
        text += std::to_string(v) + "\n";
      else if (encoding_.label_bits == 32)
        append(text, static_cast<std::int32_t>(v));
      else
        append(text, v);
    return text + ")\n";
  }

  /// The file of zones of cells, or with another key of faces.
  std::string zones(const std::vector<std::pair<std::string, std::vector<std::int64_t>>>& zones,
                    const std::string& type = "cell") const {
    std::string text = header("regIOobject", type + "Zones") + std::to_string(zones.size()) + "\n(\n";
    for (const auto& [name, members] : zones) {
      text +=
          name + "\n{\n    type " + type + "Zone;\n" + type + "Labels List<label> " + labels(members) + ";\n";
      if (type == "face") text += "    flipMap List<bool> " + flags(members.size()) + ";\n";
      text += "}\n";
    }
    return text + ")\n" + end;
  }

  static constexpr const char* end =
      "\n// ************************************************************* //\n";

 private:
  template <class T>
  static void append(std::string& to, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    to.append(bytes, sizeof(T));
  }

  /// In a binary file bytes that would end an entry, were they text.
  std::string flags(std::size_t count) const {
    std::string text = std::to_string(count) + "\n(";
    for (std::size_t i = 0; i < count; ++i) text += encoding_.is_binary ? ";" : "0 ";
    return text + ")\n";
  }

  std::string points(const Foam_mesh& mesh) const {
    std::string text = header("vectorField", "points") + "\n" + std::to_string(mesh.points.size()) + "\n(";
    for (const auto& p : mesh.points) {
      if (!encoding_.is_binary) text += "\n(";
      for (std::size_t k = 0; k < 3; ++k)
        if (!encoding_.is_binary)
          text += (k > 0 ? " " : "") + std::to_string(p[k]);
        else if (encoding_.scalar_bits == 32)
          append(text, static_cast<float>(p[k]));
        else
          append(text, p[k]);
      if (!encoding_.is_binary) text += ")";
    }
    return text + ")\n" + end;
  }

  std::string faces(const Foam_mesh& mesh) const {
    if (!encoding_.is_binary || !encoding_.has_compact_faces) {
      std::string text = header("faceList", "faces") + "\n" + std::to_string(mesh.faces.size()) + "\n(\n";
      for (const auto& loop : mesh.faces) {
        std::string face = labels(loop);
        if (!encoding_.is_binary) std::replace(face.begin(), face.end(), '\n', ' ');
        text += face + "\n";
      }
      return text + ")\n" + end;
    }
    std::vector<std::int64_t> begin{0}, corners;
    for (const auto& loop : mesh.faces) {
      corners.insert(corners.end(), loop.begin(), loop.end());
      begin.push_back(static_cast<std::int64_t>(corners.size()));
    }
    return header("faceCompactList", "faces") + labels(begin) + labels(corners) + end;
  }

  std::string boundary(const Foam_mesh& mesh) const {
    std::string text = header("polyBoundaryMesh", "boundary") + std::to_string(mesh.patches.size()) + "\n(\n";
    for (const auto& patch : mesh.patches)
      text += "    " + patch.name + "\n    {\n        type            " + patch.type +
              ";\n        inGroups        List<word> 1(wall);\n        nFaces          " +
              std::to_string(patch.size) + ";\n        startFace       " + std::to_string(patch.first) +
              ";\n        coeffs { nFaces 7; }\n    }\n";
    return text + ")\n" + end;
  }

  Foam_encoding encoding_;
};

inline void write_foam(const std::filesystem::path& folder, const std::map<std::string, std::string>& files) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, bytes] : files) std::ofstream(folder / name, std::ios::binary) << bytes;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_IO_MESH_FOAM_MESH_H
