// SPDX-License-Identifier: LGPL-3.0-or-later
// The .poly format of Shewchuk's Triangle. CGAL's reader names no line.
#include <cellwalk/internal/io/planar_file.h>

#include <fmt/format.h>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

struct Numbered_points {
  std::vector<Point<2>> points;
  std::uint32_t base = 0;  ///< the number of the first point: 0 or 1
};

/// Reads `count dimension attributes markers` (line already current) and the rows of points.
Numbered_points read_points(Line_reader& in) {
  const std::uint64_t count = in.count("the number of points");
  if (!in.at_line_end()) {
    const std::uint64_t dimension = in.count("the dimension");
    if (dimension == 3)
      in.fail("a .poly file of dimension 3 (TetGen's): write the surface as OFF, PLY or STL instead");
    if (dimension != 2) in.fail(fmt::format("dimension {}: only 2 is read", dimension));
  }
  Numbered_points result;
  result.points.reserve(in.plausible(count, 6));
  for (std::uint64_t i = 0; i < count; ++i) {
    in.need_line(fmt::format("point {} of {}", i + 1, count));
    const std::uint64_t number = in.count("the number of a point");
    if (i == 0 && number > 1) in.fail("points are numbered from 0 or 1");
    if (i == 0) result.base = static_cast<std::uint32_t>(number);
    if (number != i + result.base)
      in.fail(
          fmt::format("point {} where {} should be: points are numbered in order", number, i + result.base));
    Point<2> p;
    for (double& x : p) x = in.number("a coordinate");
    result.points.push_back(p);
  }
  return result;
}

Numbered_points points_beside(const std::string& name) {
  const std::filesystem::path beside = std::filesystem::path(name).replace_extension(".node");
  const std::string text = load(beside);
  Line_reader in(beside.string(), text);
  in.need_line("the number of points");
  return read_points(in);
}

}  // namespace

Planar_domain parse_poly(const std::string& name, std::string_view text, Read_report* report) {
  Line_reader in(name, text);
  in.need_line("the number of points");
  Numbered_points read = read_points(in);
  if (read.points.empty()) read = points_beside(name);
  Planar_domain domain;
  domain.points = std::move(read.points);

  in.need_line("the number of segments");
  const std::uint64_t segment_count = in.count("the number of segments");
  for (std::uint64_t i = 0; i < segment_count; ++i) {
    in.need_line(fmt::format("segment {} of {}", i + 1, segment_count));
    in.count("the number of a segment");
    const std::uint32_t a = in.index("point", domain.points.size(), read.base);
    const std::uint32_t b = in.index("point", domain.points.size(), read.base);
    if (a == b) in.fail(fmt::format("a segment from point {} to itself", a + read.base));
    domain.segments.push_back({a, b});
  }
  if (domain.segments.empty()) fail(name, "holds no segments: there is nothing that bounds a domain");

  in.need_line("the number of holes");
  const std::uint64_t hole_count = in.count("the number of holes");
  for (std::uint64_t i = 0; i < hole_count; ++i) {
    in.need_line(fmt::format("hole {} of {}", i + 1, hole_count));
    in.count("the number of a hole");
    Point<2> p;
    for (double& x : p) x = in.number("a coordinate");
    domain.holes.push_back(p);
  }
  if (report) {
    *report = {"Triangle .poly", domain.points.size(), 0, domain.segments.size(), {}};
    if (in.next_line()) report->notes.push_back("regional attributes ignored");
  }
  return domain;
}

Planar_domain read_poly(const std::filesystem::path& path, Read_report* report) {
  return parse_poly(path.string(), load(path), report);
}

}  // namespace cellwalk::io
