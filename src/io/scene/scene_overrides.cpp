// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of values of a scene by the command line, each named by its path.
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/files/text.h"
#include "json_node.h"

namespace cellwalk::io {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& change, const std::string& why) {
  throw Error(Error_code::usage,
              fmt::format("{}: {}; give KEY=VALUE, as environment.cells=[10,10,10]", shown(change), why));
}

/// True if a text is UTF-8, as JSON must be.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(json(text).dump());
    return true;
  } catch (const json::type_error&) {
    return false;
  }
}

[[noreturn]] void refuse_depth(const std::string& change) {
  refuse(change, fmt::format("more than {} lists and objects within each other", deepest_nesting));
}

/// The place at a key such as `bodies[0].count` of a value that is as deep as said.
json& at_key(json& document, std::string_view key, int depth, const std::string& change) {
  json* here = &document;
  while (!key.empty()) {
    if (++depth > deepest_nesting) refuse_depth(change);
    if (key.front() == '[') {
      const std::size_t end = key.find(']');
      std::size_t index = 0;
      if (end == std::string_view::npos) refuse(change, "] is missing");
      const auto read = std::from_chars(key.data() + 1, key.data() + end, index);
      if (read.ec != std::errc() || read.ptr != key.data() + end) refuse(change, "expected an index in []");
      if (!here->is_array() || index >= here->size())
        refuse(change, fmt::format("there is no element {}", index));
      here = &(*here)[index];
      key.remove_prefix(end + 1);
      if (!key.empty() && key.front() != '.' && key.front() != '[')
        refuse(change, "a dot is missing after ]");
    } else {
      const std::size_t end = std::min(key.find_first_of(".["), key.size());
      if (end == 0) refuse(change, "a key is empty");
      if (!here->is_object() && !here->is_null())
        refuse(change, "what the key leads through is not an object");
      here = &(*here)[std::string(key.substr(0, end))];
      key.remove_prefix(end);
    }
    if (key == ".") refuse(change, "a key is empty");
    if (key.starts_with('.')) key.remove_prefix(1);
  }
  return *here;
}

}  // namespace

std::string change_scene(const std::string& name, std::string_view text,
                         std::span<const std::string> changes) {
  const auto document = detail::parse_json(name, text);
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    if (equals == std::string::npos || equals == 0) refuse(change, "no key");
    if (!is_utf8(change)) refuse("a change", "is not written in UTF-8");
    const std::string value = change.substr(equals + 1);
    int deepest = 0;
    const auto watch = [&](int depth, json::parse_event_t, json&) {
      deepest = std::max(deepest, depth);
      if (deepest > deepest_nesting) refuse_depth(change);
      return true;
    };
    constexpr bool throws = false;
    json parsed = json::parse(value, watch, throws);
    if (parsed.is_discarded()) parsed = value, deepest = 0;
    at_key(*document, std::string_view(change).substr(0, equals), deepest, change) = std::move(parsed);
  }
  return document->dump(2);
}

}  // namespace cellwalk::io
