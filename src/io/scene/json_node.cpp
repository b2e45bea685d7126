// SPDX-License-Identifier: LGPL-3.0-or-later
// The path of each value in its file, and the checks of types, ranges and unknown keys.
#include "json_node.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/files/text.h"

namespace cellwalk::io::detail {

using nlohmann::json;

namespace {

/// The system takes a name to end at its first NUL: a file of another name would be read.
bool has_null(const std::string& text) { return text.find('\0') != std::string::npos; }

}  // namespace

std::unique_ptr<json> parse_json(const std::string& name, std::string_view text) {
  // The library silently keeps the last of two equal keys; such a scene is refused.
  std::vector<std::set<std::string>> open;
  std::optional<std::string> repeated;
  const auto watch = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > deepest_nesting)
      io::fail(name, fmt::format("more than {} lists and objects within each other", deepest_nesting));
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second &&
        !repeated)
      repeated = value.get<std::string>();
    return true;
  };
  try {
    constexpr bool throws = true, skips_comments = true;
    auto document = std::make_unique<json>(json::parse(text, watch, throws, skips_comments));
    if (repeated) io::fail(name, fmt::format("{}: key given twice in one object", shown(*repeated)));
    return document;
  } catch (const json::exception& e) {
    std::string what =
        e.what();  // "[json.exception.parse_error.101] parse error at line 2, column 5: reason"
    std::size_t line = 0;
    if (const auto* parse = dynamic_cast<const json::parse_error*>(&e)) {
      const std::string_view before =
          text.substr(0, parse->byte > 0 ? std::min(parse->byte - 1, text.size()) : 0);
      line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
    }
    if (what.starts_with("[")) what.erase(0, what.find("] ") + 2);
    if (const auto colon = what.find(": "); colon != std::string::npos) what.erase(0, colon + 2);
    constexpr std::size_t longest = 200;  // bytes of a reason, which may quote a whole text
    what = "not valid JSON: " + (what.size() > longest ? what.substr(0, longest) + "..." : what);
    line ? io::fail(name, line, what) : io::fail(name, what);
  }
}

void Json_node::fail(const std::string& what) const {
  io::fail(*file_, path_.empty() ? what : path_ + ": " + what);
}

bool Json_node::is_boolean() const { return value_->is_boolean(); }

bool Json_node::is_string() const { return value_->is_string(); }
bool Json_node::is_object() const { return value_->is_object(); }
bool Json_node::is_array() const { return value_->is_array(); }

void Json_node::expect_keys(std::span<const std::string_view> allowed) const {
  for (const std::string& key : keys())
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      std::vector<std::string_view> sorted(allowed.begin(), allowed.end());
      std::sort(sorted.begin(), sorted.end());
      at(key).fail(fmt::format("unknown key; known here: {}", fmt::join(sorted, ", ")));
    }
}

std::vector<std::string> Json_node::keys() const {
  if (!is_object()) fail("expected an object {...}");
  std::vector<std::string> result;
  for (auto it = value_->begin(); it != value_->end(); ++it) {
    if (has_null(it.key()))
      fail(fmt::format("the key {} has a NUL character: leave it out", shown(it.key())));
    result.push_back(it.key());
  }
  return result;
}

bool Json_node::has(std::string_view key) const { return find(key).has_value(); }

std::optional<Json_node> Json_node::find(std::string_view key) const {
  if (!is_object()) fail("expected an object {...}");
  const auto it = value_->find(std::string(key));
  if (it == value_->end()) return std::nullopt;
  return Json_node(*it, *file_, path_.empty() ? shown(key) : path_ + "." + shown(key));
}

Json_node Json_node::at(std::string_view key) const {
  const auto node = find(key);
  if (!node) fail(fmt::format("key \"{}\" is missing", key));
  return *node;
}

std::vector<Json_node> Json_node::elements() const {
  if (!is_array()) fail("expected a list [...]");
  std::vector<Json_node> result;
  for (std::size_t i = 0; i < value_->size(); ++i)
    result.emplace_back((*value_)[i], *file_, fmt::format("{}[{}]", path_, i));
  return result;
}

std::string Json_node::string() const {
  if (!is_string()) fail("expected a text");
  std::string text = value_->get<std::string>();
  if (has_null(text)) fail("a text with a NUL character: leave it out");
  return text;
}

bool Json_node::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false");
  return value_->get<bool>();
}

double Json_node::number() const {
  if (!value_->is_number()) fail("expected a number");
  const double x = value_->get<double>();
  if (!std::isfinite(x)) fail("expected a finite number");
  return x;
}

double Json_node::number_in(double low, double high) const {
  const double x = number();
  if (!(x >= low && x <= high)) fail(fmt::format("expected a number from {} to {}, not {}", low, high, x));
  return x;
}

double Json_node::positive() const {
  const double x = number();
  if (!(x > 0)) fail(fmt::format("expected a number greater than 0, not {}", x));
  return x;
}

std::uint64_t Json_node::integer_in(std::uint64_t low, std::uint64_t high) const {
  const std::string expected = fmt::format("expected an integer from {} to {}", low, high);
  if (!value_->is_number()) fail(expected);
  if (!value_->is_number_unsigned()) fail(fmt::format("{}, not {}", expected, value_->dump()));
  const auto n = value_->get<std::uint64_t>();
  if (n < low || n > high) fail(fmt::format("{}, not {}", expected, n));
  return n;
}

std::vector<double> Json_node::numbers() const {
  if (!is_array() && !value_->is_number()) fail("expected a number or a list of numbers");
  if (!is_array()) return {number()};
  std::vector<double> result;
  for (const Json_node& e : elements()) result.push_back(e.number());
  return result;
}

std::vector<double> Json_node::list(std::size_t size) const {
  const bool good = is_array() && value_->size() == size &&
                    std::all_of(value_->begin(), value_->end(), [](const json& e) { return e.is_number(); });
  if (!good) fail(fmt::format("expected {} numbers", size));
  return numbers();
}

}  // namespace cellwalk::io::detail
