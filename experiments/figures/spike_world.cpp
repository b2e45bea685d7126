// SPDX-License-Identifier: LGPL-3.0-or-later
#include "spike_world.h"

#include <algorithm>

namespace cellwalk::figures {
namespace {

using Corners =
    std::array<std::uint32_t, 8>;  // four below, counterclockwise seen from above, then four above

void add_spiked_cube(Cell_soup<3>& soup, const Corners& v, const Spike& spike) {
  const auto add_point = [&](double x, double y, double z) {
    soup.points.push_back({spike.x + x, spike.y + y, z});
    return static_cast<std::uint32_t>(soup.points.size() - 1);
  };
  const double low = 0.5 - spike.half_width, high = 0.5 + spike.half_width;
  const std::array<std::uint32_t, 4> s{add_point(low, low, 0), add_point(high, low, 0),
                                       add_point(high, high, 0), add_point(low, high, 0)};
  const std::uint32_t tip = add_point(0.5, 0.5, spike.height);
  add_pyramid(soup, {s[0], s[1], s[2], s[3], tip});
  soup.solid.back() = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    add_pyramid(soup, {v[i], v[j], s[j], s[i], tip});
    add_pyramid(soup, {v[j], v[i], v[i + 4], v[j + 4], tip});
  }
  add_pyramid(soup, {v[4], v[7], v[6], v[5], tip});
}

}  // namespace

Environment<3> spike_world(const std::array<std::uint32_t, 3>& cubes, const std::vector<Spike>& spikes) {
  const auto [nx, ny, nz] = cubes;
  Cell_soup<3> soup;
  for (std::uint32_t z = 0; z <= nz; ++z)
    for (std::uint32_t y = 0; y <= ny; ++y)
      for (std::uint32_t x = 0; x <= nx; ++x) soup.points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
  const auto point = [row = nx + 1, layer = (nx + 1) * (ny + 1)](std::uint32_t x, std::uint32_t y,
                                                                 std::uint32_t z) {
    return x + row * y + layer * z;
  };
  for (std::uint32_t z = 0; z < nz; ++z)
    for (std::uint32_t y = 0; y < ny; ++y)
      for (std::uint32_t x = 0; x < nx; ++x) {
        const Corners v{
            point(x, y, z),     point(x + 1, y, z),     point(x + 1, y + 1, z),     point(x, y + 1, z),
            point(x, y, z + 1), point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1), point(x, y + 1, z + 1)};
        const auto spike = std::find_if(spikes.begin(), spikes.end(),
                                        [&](const Spike& s) { return z == 0 && s.x == x && s.y == y; });
        if (spike == spikes.end())
          add_hexahedron(soup, v);
        else
          add_spiked_cube(soup, v, *spike);
      }
  return Environment<3>::build(soup);
}

}  // namespace cellwalk::figures
