// SPDX-License-Identifier: LGPL-3.0-or-later
// STL, as text and binary. CGAL's reader refuses files that end in `end solid`, and names no line.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "io/files/text.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

/// Gives corners of equal coordinates one index, since STL repeats every vertex in every triangle.
class Merged_points {
 public:
  explicit Merged_points(std::vector<Point<3>>& points) : points_(points) {}

  std::uint32_t operator()(Point<3> p) {
    for (double& x : p) x += 0.0;  // -0 and 0 are one position
    const auto [it, is_new] = index_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return it->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Point<3>& p) const {
      std::uint64_t h = 0;
      for (double x : p) h = (std::rotl(h, 23) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
      return h ^ (h >> 32);
    }
  };
  std::vector<Point<3>>& points_;
  std::unordered_map<Point<3>, std::uint32_t, Hash> index_;
};

// Binary: 80 arbitrary bytes, a 32-bit count, then 50 bytes a triangle: normal, corners, two arbitrary bytes.
constexpr std::size_t header_size = 84, triangle_size = 50, count_offset = 80, corner_offset = 12;

std::uint32_t triangle_count(std::string_view bytes) {
  std::uint32_t n = 0;
  static_assert(std::endian::native == std::endian::little, "STL is little endian");
  std::memcpy(&n, bytes.data() + count_offset, sizeof n);
  return n;
}

/// Fails like the other readers, for a binary file, which has no lines.
struct Whole_file {
  const std::string& name;
  [[noreturn]] void fail(const std::string& what) const { io::fail(name, what); }
};

Surface_soup parse_binary(const std::string& name, std::string_view bytes, Read_report& report,
                          Body_elements* body) {
  report.format = "STL (binary)";
  const std::uint64_t n = triangle_count(bytes), whole = (bytes.size() - header_size) / triangle_size;
  if (n > whole)
    fail(name,
         fmt::format("a binary STL that announces {} triangles and holds {}: it is cut short, or no STL", n,
                     whole));
  if (header_size + n * triangle_size != bytes.size())
    report.notes.push_back(fmt::format("{} bytes after the last triangle ignored",
                                       bytes.size() - header_size - n * triangle_size));
  Surface_soup soup;
  Merged_points merged(soup.points);
  for (std::uint64_t t = 0; t < n; ++t) {
    std::vector<std::uint32_t> loop;
    for (std::size_t k = 0; k < 3; ++k) {
      float x[3];
      std::memcpy(x, bytes.data() + header_size + t * triangle_size + corner_offset + k * sizeof x, sizeof x);
      const Point<3> p{x[0], x[1], x[2]};
      if (!is_finite(p)) fail(name, fmt::format("triangle {} has a coordinate that is not finite", t));
      check_planar(Whole_file{name}, body, p);
      loop.push_back(merged(p));
    }
    soup.facets.push_back(std::move(loop));
  }
  return soup;
}

Surface_soup parse_text(const std::string& name, std::string_view bytes, Read_report& report,
                        Body_elements* body) {
  report.format = "STL";
  Surface_soup soup;
  Merged_points merged(soup.points);
  Line_reader in(name, bytes, std::nullopt);
  std::vector<std::uint32_t> loop;
  std::size_t solids = 0;
  bool in_facet = false;
  while (in.next_line()) {
    std::string keyword = lower(in.word());
    if (keyword == "end") keyword += lower(in.word());
    if (keyword == "vertex") {
      if (!in_facet) in.fail("a vertex outside any facet");
      Point<3> p;
      for (double& x : p) x = in.number("a coordinate");
      check_planar(in, body, p);
      loop.push_back(merged(p));
    } else if (keyword == "facet") {
      if (in_facet) in.fail("a facet begins before the one before it ended");
      in_facet = true;
      loop.clear();
    } else if (keyword == "endfacet") {
      if (!in_facet) in.fail("'endfacet' without a facet");
      if (loop.size() < 3) in.fail(fmt::format("a facet of {} vertices: at least 3 are needed", loop.size()));
      soup.facets.push_back(loop);
      in_facet = false;
    } else if (keyword == "solid") {
      ++solids;
    } else if (keyword != "outer" && keyword != "endloop" && keyword != "endsolid") {
      in.fail(fmt::format("'{}' opens no statement of an STL file", keyword.substr(0, 20)));
    }
  }
  if (in_facet) in.fail("the file ends inside a facet: it is cut short");
  if (solids > 1) report.notes.push_back(fmt::format("{} solids read as one surface", solids));
  return soup;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_size &&
         header_size + std::uint64_t{triangle_count(bytes)} * triangle_size == bytes.size();
}

Surface_soup parse_stl(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body) {
  // Binary files may begin with `solid` too: the size decides, then the presence of bytes that no text has.
  const bool sized = bytes.size() >= header_size;
  if (is_binary_stl(bytes)) return parse_binary(name, bytes, report, body);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const bool is_text = bytes.find('\0') == std::string_view::npos;
  if (is_text && first != std::string_view::npos && same_word(bytes.substr(first, 5), "solid"))
    return parse_text(name, bytes, report, body);
  if (!sized) fail(name, "too short for an STL file");
  return parse_binary(name, bytes, report, body);
}

}  // namespace cellwalk::io
