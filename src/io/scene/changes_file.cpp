// SPDX-License-Identifier: LGPL-3.0-or-later
// The keys of a file of changes, and their groups of facets and cells.
#include <cellwalk/internal/io/changes_file.h>

#include <nlohmann/json.hpp>

#include "environment_changes.h"
#include "io/files/text.h"
#include "json_node.h"

namespace cellwalk::io {

template <int D>
Environment_changes<D> parse_changes(const std::string& name, std::string_view text) {
  const auto document = detail::parse_json(name, text);
  const detail::Json_node root(*document, name);
  root.expect_keys({"groups", "changes"});
  if (root.at("changes").elements().empty()) root.at("changes").fail("nothing is to be changed");
  constexpr std::uint64_t no_steps = 0;
  return detail::changes<D>(root, no_steps);
}

template <int D>
Environment_changes<D> read_changes(const std::filesystem::path& path) {
  return parse_changes<D>(path.string(), load(path));
}

template Environment_changes<2> read_changes(const std::filesystem::path&);
template Environment_changes<3> read_changes(const std::filesystem::path&);
template Environment_changes<2> parse_changes(const std::string&, std::string_view);
template Environment_changes<3> parse_changes(const std::string&, std::string_view);

}  // namespace cellwalk::io
