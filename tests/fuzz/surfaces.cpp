// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces from bytes, up to where a mesher would get them: checked, and their narrowest place found.
#include <cellwalk/meshing/tetrahedralize.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "fuzz/decoder.h"
#include "fuzz/targets.h"
#include "meshing/fill/narrow_place.h"
#include "meshing/shapes.h"

namespace cellwalk::fuzz {
namespace {

constexpr std::size_t most_points = 200;

Surface_soup shape(Decoder& in) {
  return in.flag() ? test::octahedron(static_cast<int>(in.below(2))) : test::box({0, 0, 0}, {1, 1, 1});
}

/// Does something to a surface, most of it harm.
void change(Surface_soup& s, Decoder& in) {
  Point<3>& p = s.points[in.below(s.points.size())];
  switch (in.below(4)) {
    case 0:
      for (double& x : p) x = in.coordinate();
      break;
    case 1: {  // near another point
      p = s.points[in.below(s.points.size())];
      double& coordinate = p[in.below(3)];
      coordinate += std::ldexp(1.0, -static_cast<int>(in.byte()));
      break;
    }
    case 2: {
      constexpr int largest_exponent = 1000;
      const int exponent = static_cast<int>(in.below(2 * largest_exponent)) - largest_exponent;
      for (Point<3>& q : s.points)
        for (double& x : q) x = std::ldexp(x, exponent);
      break;
    }
    default:
      if (s.points.size() < most_points) s = test::join(std::move(s), shape(in));
  }
}

void expect_sense(const Surface_soup& surface) {
  std::vector<std::uint32_t> points(surface.points.size()), facets(surface.facets.size());
  detail::Feature_names names;
  names.add("surface", points, points.size(), facets, facets.size());
  const auto places = detail::narrow_places({surface});
  demand(!places.empty() && places.size() <= 2, "a surface has a narrowest place");
  for (const detail::Narrow_place& place : places) {
    demand(place.distance >= 0 && place.distance <= 1, "a distance is a part of the size");
    demand(place.features[0] != place.features[1], "a narrow place is between two features");
    for (const std::size_t feature : place.features)
      demand(feature < (place.are_vertices ? points : facets).size(), "a feature exists");
    demand(is_finite(place.at), "a place has coordinates");
  }
  demand(detail::describe(places, names).find('\n') == std::string::npos, "a place is told in one line");
}

}  // namespace

void surface(std::string_view bytes) {
  Decoder in(bytes);
  Surface_soup soup = shape(in);
  while (!in.is_empty()) change(soup, in);
  reads([&] { expect_sense(check_surface(soup)); });
}

}  // namespace cellwalk::fuzz
