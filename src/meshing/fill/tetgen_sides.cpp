// SPDX-License-Identifier: GPL-3.0-or-later
// A flood of tetrahedra across facets, whose sides change at those of the surfaces.
#include "tetgen_sides.h"

#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <string>
#include <utility>

#include "narrow_place.h"

namespace cellwalk::detail {
namespace {

[[noreturn]] void refuse_lost(const std::string& feature, const Point<3>& at) {
  throw Error(Error_code::not_certified,
              "TetGen did not keep the surface: " + feature + " is not in its mesh, at " + describe(at));
}

}  // namespace

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
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

Triangle opposite(const std::array<std::uint32_t, 4>& t, int i) {
  return sorted({t[(i + 1) & 3], t[(i + 2) & 3], t[(i + 3) & 3]});
}

void check_kept(const Tetgen_result& mesh, const std::vector<Surface_soup>& surfaces, const Owners& owners,
                const Feature_names& names) {
  std::size_t point = 0;
  for (const auto& s : surfaces)
    for (const auto& p : s.points) {
      if (point >= mesh.points.size() || mesh.points[point] != p) refuse_lost(names.vertex(point), p);
      ++point;
    }
  Owners missing = owners;
  for (const auto& t : mesh.tetrahedra)
    for (int i = 0; i < 4; ++i) missing.erase(opposite(t, i));
  if (missing.empty()) return;
  std::size_t facet = 0;
  std::uint32_t first = 0;
  for (const auto& s : surfaces) {
    for (const auto& f : s.facets) {
      if (missing.contains(sorted({first + f[0], first + f[1], first + f[2]})))
        refuse_lost(names.facet(facet), s.points[f[0]]);
      ++facet;
    }
    first += static_cast<std::uint32_t>(s.points.size());
  }
}

std::array<std::uint32_t, 4> positive(const Tetgen_result& mesh, std::array<std::uint32_t, 4> t) {
  Predicate_counts counts;
  const auto& p = mesh.points;
  const int sign = Exact::orientation(counts, p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
  if (sign == 0)
    throw Error(Error_code::not_certified, "TetGen made a flat tetrahedron, at " + describe(p[t[0]]));
  if (sign < 0) std::swap(t[0], t[1]);
  return t;
}

Sides::Sides(const Tetgen_result& mesh, const Owners& owners, std::size_t surfaces)
    : mesh_(mesh), owners_(owners), region_(mesh.tetrahedra.size(), none) {
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int i = 0; i < 4; ++i) {
      if (mesh.neighbours[t][i] >= 0 || region_[t] != none) continue;
      std::vector<bool> sides(surfaces, false);
      const auto owner = owners.find(opposite(mesh.tetrahedra[t], i));
      if (owner != owners.end()) sides[owner->second] = true;
      flood(t, std::move(sides));
    }
  if (std::find(region_.begin(), region_.end(), none) != region_.end())
    throw Error(Error_code::not_certified, "TetGen made no mesh: its tetrahedra do not fit together");
}

void Sides::flood(std::uint32_t seed, std::vector<bool> seed_sides) {
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

}  // namespace cellwalk::detail
