// SPDX-License-Identifier: LGPL-3.0-or-later
// Parsing with errors that name the file, and indented text.
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "text.h"

namespace cellwalk::io {

nlohmann::ordered_json parse_ordered_json(const std::string& name, std::string_view text) {
  using nlohmann::ordered_json;
  const auto watch = [&name](int depth, ordered_json::parse_event_t, ordered_json&) {
    if (depth > deepest_nesting)
      fail(name, fmt::format("more than {} lists and objects within each other", deepest_nesting));
    return true;
  };
  return ordered_json::parse(text, watch);
}

void write_json(Atomic_file& file, const nlohmann::ordered_json& value) {
  // Text that is not UTF-8, such as a file name, must not prevent a report.
  file.write(value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  Atomic_file file(path);
  write_json(file, value);
  file.commit();
}

}  // namespace cellwalk::io
