// SPDX-License-Identifier: LGPL-3.0-or-later
// PLY and binary OFF by CGAL's polygon soup readers (Stream_support, LGPL).
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <sstream>

#include "surface_parsers.h"
#include "text.h"

namespace cellwalk::io {
namespace {

using Cgal_point = CGAL::Simple_cartesian<double>::Point_3;

template <class Read>
Surface_soup read_by_cgal(const std::string& name, std::string_view bytes, const char* format, Read read) {
  std::istringstream in{std::string(bytes)};
  std::vector<Cgal_point> points;
  std::vector<std::vector<std::size_t>> polygons;
  bool good = false;
  std::string why;
  try {
    good = read(in, points, polygons);
  } catch (const std::exception& e) {  // a count too large to allocate
    why = fmt::format(" ({})", e.what());
  }
  if (!good) fail(name, fmt::format("broken or cut short: CGAL cannot read it as {}{}", format, why));
  Surface_soup soup;
  soup.points.reserve(points.size());
  for (const Cgal_point& p : points) {
    soup.points.push_back({p.x(), p.y(), p.z()});
    if (!is_finite(soup.points.back()))
      fail(name, fmt::format("vertex {} has a coordinate that is not finite", soup.points.size() - 1));
  }
  for (const auto& polygon : polygons) {
    std::vector<std::uint32_t> loop;
    for (std::size_t v : polygon) {
      if (v >= points.size())
        fail(name, fmt::format("facet {} names vertex {}, of {}", soup.facets.size(), v, points.size()));
      loop.push_back(static_cast<std::uint32_t>(v));
    }
    if (loop.size() < 3) fail(name, fmt::format("facet {} has {} vertices", soup.facets.size(), loop.size()));
    soup.facets.push_back(std::move(loop));
  }
  return soup;
}

}  // namespace

Surface_soup parse_binary_off(const std::string& name, std::string_view bytes, Read_report& report) {
  report.format = "OFF (binary)";
  return read_by_cgal(name, bytes, "binary OFF", [](auto& in, auto& points, auto& polygons) {
    return CGAL::IO::read_OFF(in, points, polygons, CGAL::parameters::verbose(false));
  });
}

Surface_soup parse_ply(const std::string& name, std::string_view bytes, Read_report& report) {
  report.format = "PLY";
  if (!bytes.starts_with("ply")) fail(name, 1, "not a PLY file: it does not begin with 'ply'");
  return read_by_cgal(name, bytes, "PLY", [](auto& in, auto& points, auto& polygons) {
    return CGAL::IO::read_PLY(in, points, polygons, CGAL::parameters::verbose(false));
  });
}

}  // namespace cellwalk::io
