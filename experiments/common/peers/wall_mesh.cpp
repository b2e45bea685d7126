// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wall_mesh.h"

#include <span>
#include <utility>

namespace cellwalk::experiments {
namespace {

class Mesh_maker {
 public:
  explicit Mesh_maker(const Cell_soup<3>& soup) : soup_(soup), number_(soup.points.size(), unused) {}

  void add(std::uint32_t facet) {
    const std::span<const std::uint32_t> loop = soup_.facet(facet);
    for (std::size_t i = 2; i < loop.size(); ++i)
      mesh_.triangles.push_back({use(loop[0]), use(loop[i - 1]), use(loop[i])});
  }
  Wall_mesh mesh() && { return std::move(mesh_); }

 private:
  std::uint32_t use(std::uint32_t point) {
    if (number_[point] == unused) {
      number_[point] = static_cast<std::uint32_t>(mesh_.points.size());
      mesh_.points.push_back(soup_.points[point]);
    }
    return number_[point];
  }

  static constexpr std::uint32_t unused = 0xffffffffu;
  const Cell_soup<3>& soup_;
  std::vector<std::uint32_t> number_;
  Wall_mesh mesh_;
};

/// For each half-facet whether its cell is solid.
std::vector<std::uint8_t> solid_facets(const Cell_soup<3>& soup) {
  std::vector<std::uint8_t> solid(soup.facet_count());
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) solid[f] = soup.solid[c];
  return solid;
}

}  // namespace

Wall_mesh wall_mesh(const Cell_soup<3>& soup, const Gluing& gluing, Facing facing) {
  const std::vector<std::uint8_t> solid =
      facing == Facing::wall ? solid_facets(soup) : std::vector<std::uint8_t>();
  Mesh_maker maker(soup);
  for (std::uint32_t f = 0; f < soup.facet_count(); ++f) {
    const std::uint32_t other = gluing.opposite[f];
    const bool has_other = other != no_facet;
    if (has_other && !soup.impassable[f] && !soup.impassable[other]) continue;
    // A facet counts where its number is the lower one of the two, or where its cell is free.
    if (facing == Facing::first ? !has_other || f < other : !solid[f]) maker.add(f);
  }
  return std::move(maker).mesh();
}

double enclosed_volume(const Wall_mesh& walls) {
  double six_volumes = 0;
  for (std::size_t i = 0; i < walls.triangles.size(); ++i)
    six_volumes += dot(walls.corner(i, 0), cross(walls.corner(i, 1), walls.corner(i, 2)));
  return six_volumes / 6;
}

}  // namespace cellwalk::experiments
