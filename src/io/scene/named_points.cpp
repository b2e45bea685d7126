// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/named_points.h>

#include <nlohmann/json.hpp>

#include "io/files/text.h"
#include "json_node.h"

namespace cellwalk::io {

std::map<std::string, Point<3>> read_named_points(const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto document = detail::parse_json(name, load(path));
  const detail::Json_node root(*document, name);
  std::map<std::string, Point<3>> points;
  for (const std::string& key : root.keys()) {
    if (key.empty()) root.fail("a point has no name");
    points[key] = root.at(key).tuple<3>();
  }
  return points;
}

}  // namespace cellwalk::io
