// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/loading/mesher.h>

#include <CGAL/version.h>
#include <fmt/core.h>

#include "cli/command.h"
#include "cli/viewer_page.h"

namespace cellwalk::cli {

std::string version_text() {
  std::string text = fmt::format("cellwalk {}\n  {:<8} {:<8} {}\n", CELLWALK_VERSION, "cgal",
                                 CGAL_VERSION_STR, "map and exact arithmetic");
  const auto part = [&text](std::string_view name, bool present, std::string_view version,
                            std::string_view purpose) {
    text += fmt::format("  {:<8} {:<8} {}\n", name, present ? (version.empty() ? "yes" : version) : "no",
                        purpose);
  };
  const Mesher_parts parts = mesher_parts();
  part("meshing", parts.meshing, "", "surfaces and polygons to environments (GPL)");
  part("tetgen", parts.tetgen, "", "tetrahedra that keep a surface exactly (AGPL)");
  for (const io::Build_feature& feature : io::build_features())
    part(feature.name, feature.present, feature.version, feature.purpose);
  part("viewer", !viewer_page.empty(), "", "pages that replay a run (three.js)");
  text.pop_back();
  return text;
}

}  // namespace cellwalk::cli
