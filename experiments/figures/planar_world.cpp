// SPDX-License-Identifier: GPL-3.0-or-later
#include "planar_world.h"

#include <cellwalk/meshing/triangulate.h>

namespace cellwalk::figures {
namespace {

void add_outline(Planar_domain& domain, const Polygon& outline) {
  const auto first = static_cast<std::uint32_t>(domain.points.size()),
             size = static_cast<std::uint32_t>(outline.size());
  domain.points.insert(domain.points.end(), outline.begin(), outline.end());
  for (std::uint32_t i = 0; i < size; ++i) domain.segments.push_back({first + i, first + (i + 1) % size});
}

}  // namespace

Environment<2> planar_world(int width, int height, const std::vector<Polygon>& obstacles) {
  Polygon rectangle;
  for (int x = 0; x < width; ++x) rectangle.push_back({1.0 * x, 0});
  for (int y = 0; y < height; ++y) rectangle.push_back({1.0 * width, 1.0 * y});
  for (int x = width; x > 0; --x) rectangle.push_back({1.0 * x, 1.0 * height});
  for (int y = height; y > 0; --y) rectangle.push_back({0, 1.0 * y});
  Planar_domain domain;
  add_outline(domain, rectangle);
  for (const Polygon& obstacle : obstacles) {
    add_outline(domain, obstacle);
    // The middle of a triangle lies inside it.
    domain.holes.push_back((1.0 / 3) * (obstacle[0] + obstacle[1] + obstacle[2]));
  }
  Triangulate_options options;
  options.keep_holes = true;
  return Environment<2>::build(triangulate(domain, options));
}

}  // namespace cellwalk::figures
