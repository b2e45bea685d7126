// SPDX-License-Identifier: LGPL-3.0-or-later
// The words of the header, parsed line by line and checked.
#include "ply_header.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

Ply_type type_of(Line_reader& in, std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Ply_type>, 16> known{{{"char", Ply_type::int8},
                                                                         {"uchar", Ply_type::uint8},
                                                                         {"short", Ply_type::int16},
                                                                         {"ushort", Ply_type::uint16},
                                                                         {"int", Ply_type::int32},
                                                                         {"uint", Ply_type::uint32},
                                                                         {"float", Ply_type::float32},
                                                                         {"double", Ply_type::float64},
                                                                         {"int8", Ply_type::int8},
                                                                         {"uint8", Ply_type::uint8},
                                                                         {"int16", Ply_type::int16},
                                                                         {"uint16", Ply_type::uint16},
                                                                         {"int32", Ply_type::int32},
                                                                         {"uint32", Ply_type::uint32},
                                                                         {"float32", Ply_type::float32},
                                                                         {"float64", Ply_type::float64}}};
  for (const auto& [name, type] : known)
    if (word == name) return type;
  in.fail(fmt::format("'{}' is no type of PLY", word.substr(0, 20)));
}

Ply_encoding encoding_of(Line_reader& in, std::string_view word) {
  if (word == "ascii") return Ply_encoding::text;
  if (word == "binary_little_endian") return Ply_encoding::little_endian;
  if (word == "binary_big_endian") return Ply_encoding::big_endian;
  in.fail(fmt::format("'{}' is no format of PLY", word.substr(0, 30)));
}

Ply_property property(Line_reader& in) {
  Ply_property p;
  std::string_view type = in.word();
  if (type == "list") {
    p.count_type = type_of(in, in.word());
    type = in.word();
  }
  p.type = type_of(in, type);
  p.name = std::string(in.word());
  if (p.name.empty()) in.fail("a property without a name");
  return p;
}

}  // namespace

std::optional<std::size_t> Ply_element::find(std::string_view property, bool list) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property && properties[i].count_type.has_value() == list) return i;
  return std::nullopt;
}

Ply_header read_ply_header(const std::string& name, std::string_view bytes) {
  Ply_header header;
  Line_reader in(name, bytes, std::nullopt);
  in.need_line("'ply'");
  if (in.word() != "ply" || !in.at_line_end()) in.fail("not a PLY file: it does not begin with 'ply'");
  bool has_format = false;
  for (std::string_view keyword; keyword != "end_header";) {
    in.need_line("'end_header'");
    keyword = in.word();
    if (keyword == "format") {
      header.encoding = encoding_of(in, in.word());
      has_format = true;
    } else if (keyword == "element") {
      const std::string element(in.word());
      if (element.empty()) in.fail("an element without a name");
      header.elements.push_back({element, in.count("the number of elements"), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail("a property before any element");
      header.elements.back().properties.push_back(property(in));
    } else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header") {
      in.fail(fmt::format("'{}' opens no line of a PLY header", keyword.substr(0, 20)));
    }
  }
  if (!has_format) in.fail("the header has no line 'format'");
  header.size = bytes.size() - in.remaining().size();
  header.lines = in.line();
  return header;
}

}  // namespace cellwalk::io
