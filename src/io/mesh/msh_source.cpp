// SPDX-License-Identifier: LGPL-3.0-or-later
// The two encodings of .msh behind one interface, with checks of the counts that they announce.
#include "msh_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace cellwalk::io {
namespace {

/// The name of the end of a section: $EndNodes, or in version 1 $ENDNOD.
bool is_end_of(std::string_view word, std::string_view section) {
  return same_word(word.substr(0, 4), "$End") &&
         word.substr(std::min<std::size_t>(word.size(), 4)) == section.substr(1);
}

std::string end_of(const std::string& section) { return "$End" + section.substr(1); }

std::string between_quotes(std::string_view line) {
  const std::size_t open = line.find('"'), close = line.rfind('"');
  if (open == std::string_view::npos || open == close) return {};
  return std::string(line.substr(open + 1, close - open - 1));
}

class Msh_text final : public Msh_source {
 public:
  Msh_text(const std::string& name, std::string_view bytes) : in_(name, bytes, std::nullopt) {}

  std::string next_section() override {
    std::string section;
    while (!section.starts_with('$')) {  // Gmsh skips text between sections
      in_.leave_line();
      if (!in_.has_word()) return {};
      section = in_.word("a section");
    }
    if (!in_.at_line_end())
      in_.fail(fmt::format("text follows '{}', where the line should end", shown(section)));
    return section;
  }
  void end_section(const std::string& section) override {
    if (const std::string_view word = in_.word("'" + end_of(section) + "'"); !is_end_of(word, section))
      in_.fail(fmt::format("'{}' where '{}' should be", shown(word), end_of(section)));
  }
  void skip_section(const std::string& section) override {
    while (in_.has_word())
      if (is_end_of(in_.word("a line"), section) && in_.at_line_end())
        return;
      else
        in_.leave_line();
    fail(fmt::format("the section '{}' has no end", shown(section)));
  }

  std::int64_t integer(std::string_view what) override { return in_.integer(what); }
  std::int64_t size(std::string_view what) override { return in_.integer(what); }
  double real(std::string_view what) override { return in_.coordinate(what); }
  std::int64_t number_on_line(std::string_view what) override { return in_.integer(what); }
  std::string quoted(std::string_view what) override {
    const std::string text = between_quotes(in_.rest_of_line(what));
    in_.leave_line();
    return text;
  }
  [[noreturn]] void fail(const std::string& what) const override { in_.fail(what); }

 private:
  Word_reader in_;
};

class Msh_binary final : public Msh_source {
 public:
  Msh_binary(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {}

  std::string next_section() override {
    std::string section;
    while (!section.starts_with('$')) {
      skip_blanks();
      if (at_ == bytes_.size()) return {};
      section = line();
    }
    section.resize(section.find_last_not_of(" \t") + 1);
    if (const std::size_t blank = section.find_first_of(" \t"); blank != std::string::npos)
      fail(fmt::format("text follows '{}', where the line should end", shown(section.substr(0, blank))));
    if (section == "$MeshFormat") read_order_of_bytes();
    return section;
  }
  void end_section(const std::string& section) override {
    skip_blanks();
    if (at_ == bytes_.size()) cut_short();
    if (const std::string_view word = line(); !is_end_of(word, section))
      fail(fmt::format("'{}' where '{}' should be", shown(word), end_of(section)));
  }
  void skip_section(const std::string& section) override {
    const std::size_t end = bytes_.find("\n" + end_of(section), at_ == 0 ? 0 : at_ - 1);
    if (end == std::string_view::npos) fail(fmt::format("the section '{}' has no end", shown(section)));
    at_ = end + 1;
    line();
  }

  std::int64_t integer(std::string_view) override { return take<std::int32_t>(); }
  std::int64_t size(std::string_view) override {
    const auto value = take<std::uint64_t>();
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    return std::cmp_greater(value, most) ? most : static_cast<std::int64_t>(value);
  }
  double real(std::string_view what) override {
    const double value = take<double>();
    if (!std::isfinite(value)) fail(fmt::format("{}: '{}' is not finite", what, value));
    return value;
  }
  std::int64_t number_on_line(std::string_view what) override {
    skip_blanks();
    const std::size_t end = std::min(bytes_.find_first_of(blanks_and_ends, at_), bytes_.size());
    Word_reader word(name_, bytes_.substr(at_, end - at_), std::nullopt);
    at_ = end;
    const std::int64_t value = word.integer(what);
    if (bytes_.substr(at_).starts_with('\r')) ++at_;
    if (bytes_.substr(at_).starts_with('\n')) ++at_;
    return value;
  }
  std::string quoted(std::string_view) override { return between_quotes(line()); }
  [[noreturn]] void fail(const std::string& what) const override { io::fail(name_, what); }

 private:
  [[noreturn]] void cut_short() const {
    fail("the file ends inside its nodes or elements: it is cut short, or broken");
  }

  void skip_blanks() { at_ = std::min(bytes_.find_first_not_of(blanks_and_ends, at_), bytes_.size()); }

  std::string_view line_here() const { return bytes_.substr(at_, bytes_.find('\n', at_) - at_); }

  std::string_view line() {
    std::string_view text = line_here();
    at_ = std::min(at_ + text.size() + 1, bytes_.size());
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  void read_order_of_bytes() {
    const std::size_t before = at_;
    line();
    is_swapped_ = false;
    is_swapped_ = take<std::int32_t>() != 1;
    at_ = before;
  }

  template <class Value>
  Value take() {
    std::array<char, sizeof(Value)> bytes;
    if (bytes_.size() - at_ < bytes.size()) cut_short();
    std::memcpy(bytes.data(), bytes_.data() + at_, bytes.size());
    at_ += bytes.size();
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    Value value;
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }

  const std::string& name_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

}  // namespace

Msh_header read_msh_header(const std::string& name, std::string_view bytes) {
  Word_reader in(name, bytes, std::nullopt);
  const std::string opening(in.has_word() ? in.word("'$MeshFormat'") : "");
  if (!opening.starts_with('$'))
    fail(name, 1, "not a mesh of Gmsh: it does not begin with '$MeshFormat' or '$NOD'");
  if (opening == "$NOD" || opening == "$NOE") return {"1", false};
  if (opening != "$MeshFormat" && opening != "$Comments")
    in.fail(fmt::format("not a mesh of Gmsh: it begins with '{}'", opening.substr(0, 20)));
  if (opening == "$Comments")
    while (in.word("'$MeshFormat'") != "$MeshFormat") continue;
  Msh_header header{std::string(in.word("the version of the format")), false};
  header.binary = in.integer("the type of the file") == 1;
  header.size_of_sizes = in.integer("the size of numbers");
  return header;
}

std::unique_ptr<Msh_source> msh_text(const std::string& name, std::string_view bytes) {
  return std::make_unique<Msh_text>(name, bytes);
}

std::unique_ptr<Msh_source> msh_binary(const std::string& name, std::string_view bytes) {
  return std::make_unique<Msh_binary>(name, bytes);
}

}  // namespace cellwalk::io
