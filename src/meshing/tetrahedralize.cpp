// SPDX-License-Identifier: GPL-3.0-or-later
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>

#include "sizes.h"
#include "surface_mesh.h"
#include "tetgen_call.h"

namespace cellwalk {
namespace {

using detail::Tetgen_result;
using Triangle = std::array<std::uint32_t, 3>;

/// A refined mesh has 6 to 7 tetrahedra for each point.
constexpr double most_cells_a_point = 10;

struct Triangle_hash {
  std::size_t operator()(const Triangle& t) const {
    std::uint64_t h = t[0];
    for (int i : {1, 2}) h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + t[i];
    return h ^ (h >> 32);
  }
};

/// The surface that each triangle belongs to, by its points in ascending order.
using Owners = std::unordered_map<Triangle, std::uint32_t, Triangle_hash>;

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// The facet of a tetrahedron opposite vertex i.
Triangle opposite(const std::array<std::uint32_t, 4>& t, int i) {
  return sorted({t[(i + 1) & 3], t[(i + 2) & 3], t[(i + 3) & 3]});
}

Owners owners_of(const std::vector<Surface_soup>& surfaces) {
  Owners owners;
  std::uint32_t first = 0;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    for (const auto& f : surfaces[s].facets) owners[sorted({first + f[0], first + f[1], first + f[2]})] = s;
    first += static_cast<std::uint32_t>(surfaces[s].points.size());
  }
  return owners;
}

[[noreturn]] void lost_surface() {
  throw Error(Error_code::not_certified,
              "TetGen did not keep the surface; simplify it where it is very fine, or try Mesh_3");
}

/// Checks that every triangle of the surfaces is a facet of the mesh, with its points unchanged.
void check_kept(const Tetgen_result& mesh, const std::vector<Surface_soup>& surfaces, const Owners& owners) {
  std::size_t point = 0;
  for (const auto& s : surfaces)
    for (const auto& p : s.points)
      if (point >= mesh.points.size() || mesh.points[point++] != p) lost_surface();
  Owners missing = owners;
  for (const auto& t : mesh.tetrahedra)
    for (int i = 0; i < 4; ++i) missing.erase(opposite(t, i));
  if (!missing.empty()) lost_surface();
}

/// The surfaces that enclose each tetrahedron: an odd number of their triangles lie between it and the
/// outside. Regions are flooded inwards from the hull; crossing a surface flips the bit of that surface.
class Sides {
 public:
  Sides(const Tetgen_result& mesh, const Owners& owners, std::size_t surfaces)
      : mesh_(mesh), owners_(owners), region_(mesh.tetrahedra.size(), none) {
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
      for (int i = 0; i < 4; ++i) {
        if (mesh.neighbours[t][i] >= 0 || region_[t] != none) continue;
        std::vector<bool> sides(surfaces, false);
        const auto owner = owners.find(opposite(mesh.tetrahedra[t], i));
        if (owner != owners.end()) sides[owner->second] = true;
        flood(t, std::move(sides));
      }
  }

  const std::vector<bool>& operator[](std::size_t t) const { return sides_[region_[t]]; }

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  void flood(std::uint32_t seed, std::vector<bool> seed_sides) {
    std::vector<std::pair<std::uint32_t, std::vector<bool>>> seeds{{seed, std::move(seed_sides)}};
    while (!seeds.empty()) {
      auto [start, sides] = std::move(seeds.back());
      seeds.pop_back();
      if (region_[start] != none) continue;
      const auto region = static_cast<std::uint32_t>(sides_.size());
      std::vector<std::uint32_t> stack{start};
      region_[start] = region;
      while (!stack.empty()) {
        const std::uint32_t t = stack.back();
        stack.pop_back();
        for (int i = 0; i < 4; ++i) {
          const std::int32_t n = mesh_.neighbours[t][i];
          if (n < 0 || region_[n] != none) continue;
          const auto next = static_cast<std::uint32_t>(n);
          const auto owner = owners_.find(opposite(mesh_.tetrahedra[t], i));
          if (owner == owners_.end()) {
            region_[next] = region;
            stack.push_back(next);
          } else {
            seeds.push_back({next, sides});
            seeds.back().second[owner->second].flip();
          }
        }
      }
      sides_.push_back(std::move(sides));
    }
  }

  const Tetgen_result& mesh_;
  const Owners& owners_;
  std::vector<std::uint32_t> region_;     // per tetrahedron
  std::vector<std::vector<bool>> sides_;  // per region: enclosed by each surface
};

/// True if a tetrahedron violates the bounds of quality and size, up to rounding.
bool is_out_of_bounds(const Tetgen_result& mesh, const std::array<std::uint32_t, 4>& t,
                      const Tetrahedralize_options& options) {
  constexpr double rounding = 1 + 1e-9;
  const auto& p = mesh.points;
  const std::array<Vector<3>, 3> side{p[t[1]] - p[t[0]], p[t[2]] - p[t[0]], p[t[3]] - p[t[0]]};
  const double volume = std::abs(dot(side[0], cross(side[1], side[2]))) / 6;
  if (options.cell_size > 0 && volume > rounding * detail::largest_volume(options.cell_size)) return true;
  if (options.quality == 0) return false;
  // From the first point, the centre of the circumsphere is `centre` / (12 volume).
  Vector<3> centre{};
  double shortest = length(side[0]);
  for (int i = 0; i < 3; ++i) {
    const Vector<3>&u = side[(i + 1) % 3], &v = side[(i + 2) % 3];
    centre = centre + dot(side[i], side[i]) * cross(u, v);
    shortest = std::min({shortest, length(side[i]), length(v - u)});
  }
  return length(centre) > rounding * 12 * volume * options.quality * shortest;
}

/// A tetrahedron with positive orientation.
std::array<std::uint32_t, 4> positive(const Tetgen_result& mesh, std::array<std::uint32_t, 4> t) {
  Predicate_counts counts;
  const auto& p = mesh.points;
  const int sign = Exact::orientation(counts, p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
  if (sign == 0)
    throw Error(Error_code::not_certified,
                "TetGen made a flat tetrahedron; try another quality bound, or Mesh_3, which approximates "
                "the surface");
  if (sign < 0) std::swap(t[0], t[1]);
  return t;
}

/// The tetrahedra inside, with the surfaces as walls.
Cell_soup<3> collect(const Tetgen_result& mesh, const Owners& owners, std::size_t surfaces,
                     const Tetrahedralize_options& options, Tetrahedralize_report& report) {
  const Sides sides(mesh, owners, surfaces);
  Cell_soup<3> soup;
  std::vector<std::uint32_t> number(mesh.points.size(), 0xffffffffu);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const auto& s = sides[i];
    if (!s[0]) continue;
    const bool in_obstacle = std::count(s.begin() + 1, s.end(), true) > 0;
    if (in_obstacle && !options.keep_obstacles) continue;
    const auto t = positive(mesh, mesh.tetrahedra[i]);
    for (std::uint32_t v : t)
      if (number[v] == 0xffffffffu) {
        number[v] = static_cast<std::uint32_t>(soup.points.size());
        soup.points.push_back(mesh.points[v]);
      }
    // The facets in the order of add_tetrahedron(), each with its wall.
    for (const Triangle& f : {Triangle{t[0], t[2], t[1]}, Triangle{t[0], t[1], t[3]},
                              Triangle{t[1], t[2], t[3]}, Triangle{t[2], t[0], t[3]}}) {
      const bool wall = owners.contains(sorted(f));
      report.boundary_facets += wall && !in_obstacle;
      soup.add_facet({number[f[0]], number[f[1]], number[f[2]]}, wall || in_obstacle);
    }
    soup.end_cell(in_obstacle);
    report.solid_cells += in_obstacle;
    report.out_of_bounds += is_out_of_bounds(mesh, t, options);
  }
  return soup;
}

}  // namespace

Cell_soup<3> tetrahedralize(const Surface_soup& surface, const std::vector<Surface_soup>& obstacles,
                            const Tetrahedralize_options& options, Tetrahedralize_report* report) {
  if (!(options.quality == 0 || (options.quality >= 1.1 && options.quality <= 1e6)))
    throw Error(Error_code::usage, "tetrahedralize: the quality bound must be 0 (none) or lie in [1.1, 1e6]");
  if (!(options.cell_size >= 0))
    throw Error(Error_code::usage, "tetrahedralize: the cell size must not be negative");
  Tetrahedralize_report own;
  Tetrahedralize_report& r = report ? *report : own;
  r = {};
  const auto surfaces =
      detail::check_apart(surface, obstacles, options.obstacle_names, r.surface, r.obstacles);
  if (options.cell_size > 0)
    detail::check_cell_size("TetGen", options.cell_size, detail::free_volume(r.surface, r.obstacles),
                            most_cells_a_point * static_cast<double>(options.most_added_points));
  const Owners owners = owners_of(surfaces);
  const Tetgen_result mesh = detail::call_tetgen(surfaces, options);
  check_kept(mesh, surfaces, owners);
  r.added_points = mesh.points.size();
  for (const auto& s : surfaces) r.added_points -= s.points.size();
  return collect(mesh, owners, surfaces.size(), options, r);
}

}  // namespace cellwalk
