// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the files of an OpenFOAM mesh lie, and their bytes.
#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "io/files/text.h"
#include "poly_mesh.h"

namespace cellwalk::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> file_names{"points", "faces", "owner", "neighbour", "boundary"};
constexpr std::array<std::string_view, 2> zone_names{"faceZones", "cellZones"};

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// The file, or its compressed form if only that is there.
fs::path with_or_without_gz(const fs::path& path) {
  fs::path packed = path;
  packed += ".gz";
  return !is_there(path) && is_there(packed) ? packed : path;
}

bool has_mesh(const fs::path& folder) {
  return std::ranges::any_of(file_names, [&](std::string_view name) {
    const fs::path file = with_or_without_gz(folder / name);
    return is_there(file) && !is_folder(file);
  });
}

/// True if the files beside a file of such a name are those of a mesh.
bool is_in_mesh(const fs::path& folder, std::string_view name) {
  return std::ranges::find(file_names, name) != file_names.end() &&
         std::ranges::all_of(file_names.begin(), file_names.begin() + 3, [&](std::string_view other) {
           return is_there(with_or_without_gz(folder / other));
         });
}

std::optional<fs::path> mesh_below(const fs::path& folder) {
  if (has_mesh(folder)) return folder;
  for (const char* below : {"polyMesh", "constant/polyMesh"})
    if (has_mesh(folder / below)) return folder / below;
  return std::nullopt;
}

Named_bytes loaded(const fs::path& path) { return {path.string(), load(path)}; }

Named_bytes needed(const fs::path& folder, std::string_view name) {
  const fs::path path = with_or_without_gz(folder / name);
  if (!is_there(path))
    fail(path.string(), "is missing, and a mesh of OpenFOAM needs it: copy the whole folder");
  return loaded(path);
}

std::optional<Named_bytes> loaded_if_there(const fs::path& folder, std::string_view name) {
  const fs::path path = with_or_without_gz(folder / name);
  if (!is_there(path)) return std::nullopt;
  return loaded(path);
}

}  // namespace

std::optional<fs::path> poly_mesh_folder(const fs::path& path) {
  if (path.native().find('\0') != std::string::npos) return std::nullopt;  // no name of a file
  fs::path bare = path.filename();
  if (bare.extension() == ".gz") bare = bare.stem();
  const bool is_case = lower(bare.extension().string()) == ".foam";
  if (!is_folder(path)) {
    if (!is_there(path)) return std::nullopt;
    const fs::path parent = path.parent_path().empty() ? fs::path(".") : path.parent_path();
    if (is_case) return poly_mesh_folder(parent);
    return is_in_mesh(parent, bare.string()) ? std::optional(parent) : std::nullopt;
  }
  if (auto folder = mesh_below(path)) return folder;
  if (is_there(path / "processor0"))
    fail(path.string(),
         "holds the mesh in parts, processor0 and so on: put them together by reconstructParMesh");
  fail(path.string(),
       "is a directory without a mesh of OpenFOAM: name a file, or a folder with polyMesh in it");
}

std::vector<fs::path> files_of_poly_mesh(const fs::path& folder) {
  std::vector<fs::path> files;
  const auto add = [&](std::string_view name) {
    const fs::path file = with_or_without_gz(folder / name);
    if (is_there(file)) files.push_back(file);
  };
  std::ranges::for_each(file_names, add);
  std::ranges::for_each(zone_names, add);
  return files;
}

Mesh_file read_poly_mesh(const fs::path& folder) {
  return parse_poly_mesh({needed(folder, "points"), needed(folder, "faces"), needed(folder, "owner"),
                          needed(folder, "neighbour"), needed(folder, "boundary"),
                          loaded_if_there(folder, zone_names[0]), loaded_if_there(folder, zone_names[1])});
}

}  // namespace cellwalk::io
