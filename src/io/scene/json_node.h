// SPDX-License-Identifier: LGPL-3.0-or-later
// A JSON value with its place in the file, so that every error names the key.
#ifndef CELLWALK_IO_SCENE_JSON_NODE_H
#define CELLWALK_IO_SCENE_JSON_NODE_H

#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/kernel/point.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellwalk::io::detail {

/// Parses JSON; comments (// and /* */) are allowed.
/// \throw Error(input) naming the line, also for repeated keys and for nesting that is too deep
std::unique_ptr<nlohmann::json> parse_json(const std::string& name, std::string_view text);

/// A read-only view of a value. Does not own the document.
class Json_node {
 public:
  Json_node(const nlohmann::json& value, const std::string& file, std::string path = {})
      : value_(&value), file_(&file), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const;

  bool is_boolean() const;
  bool is_string() const;
  bool is_object() const;
  bool is_array() const;

  /// \throw Error(input) unless the value is an object that has only these keys
  void expect_keys(std::span<const std::string_view> allowed) const;
  void expect_keys(std::initializer_list<std::string_view> keys) const {
    expect_keys(std::span(keys.begin(), keys.size()));
  }
  std::vector<std::string> keys() const;
  bool has(std::string_view key) const;
  /// The value of a key.
  /// \throw Error(input) if it is missing
  Json_node at(std::string_view key) const;
  std::optional<Json_node> find(std::string_view key) const;
  /// The elements of an array.
  std::vector<Json_node> elements() const;

  std::string string() const;
  bool boolean() const;
  double number() const;  ///< finite
  double number_in(double low, double high) const;
  double positive() const;
  std::uint64_t integer_in(std::uint64_t low, std::uint64_t high) const;
  std::vector<double> numbers() const;  ///< a number or a list of numbers

  template <int D>
  std::array<double, D> tuple() const {
    const std::vector<double> values = list(D);
    std::array<double, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = values[i];
    return result;
  }

 private:
  std::vector<double> list(std::size_t size) const;

  const nlohmann::json* value_;
  const std::string* file_;
  std::string path_;
};

}  // namespace cellwalk::io::detail

#endif  // CELLWALK_IO_SCENE_JSON_NODE_H
