// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/mesh_files.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "io/files/text.h"
#include "poly_mesh.h"

namespace cellwalk::io {

namespace fs = std::filesystem;

std::vector<fs::path> files_of_mesh(const fs::path& mesh) {
  std::vector<fs::path> files;
  std::error_code none;
  if (!fs::is_directory(mesh, none)) files.push_back(mesh);
  if (lower(mesh.extension().string()) == ".poly") {
    const fs::path points = fs::path(mesh).replace_extension(".node");
    if (fs::exists(points, none)) files.push_back(points);
  }
  std::optional<fs::path> folder;
  try {
    folder = poly_mesh_folder(mesh);
  } catch (const Error&) {
    return files;  // reading it explains what is missing
  }
  if (!folder) return files;
  for (const fs::path& file : files_of_poly_mesh(*folder))
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  return files;
}

}  // namespace cellwalk::io
