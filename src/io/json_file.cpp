// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/io/atomic_file.h>
#include <cellwalk/io/json_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <vector>

#include "text.h"

namespace cellwalk::io {

nlohmann::json parse_json(const std::string& name, std::string_view text) {
  using json = nlohmann::json;
  std::vector<std::set<std::string>> open;  // keys of the objects around the current place
  std::string repeated;
  const auto watch = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second &&
        repeated.empty())
      repeated = value.get<std::string>();
    return true;
  };
  json value;
  try {
    value = json::parse(text.begin(), text.end(), watch, true, true);
  } catch (const json::parse_error& e) {
    const std::size_t byte = std::min(e.byte, text.size());
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(byte > 0 ? byte - 1 : 0);
    std::string what = e.what();  // "[json.exception...] parse error at line 1, column 2: syntax error ..."
    for (std::size_t i = 0; i < 2 && what.find(": ") != std::string::npos && what.starts_with('['); ++i)
      what = what.substr(what.find(": ") + 2);
    fail(name, 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n')), "not JSON: " + what);
  }
  if (!repeated.empty()) fail(name, "the key \"" + repeated + "\" stands twice in one object: remove one");
  return value;
}

nlohmann::json read_json(const std::filesystem::path& path) { return parse_json(path.string(), load(path)); }

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
  write_file(path, value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace cellwalk::io
