// SPDX-License-Identifier: GPL-3.0-or-later
// Collapsed, repeated and doubled triangles.
#include "tidy.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "edges.h"
#include "meshing/fill/surface_topology.h"

namespace cellwalk::detail {
namespace {

/// Pairs of triangles that differ in their orientation only.
std::vector<std::pair<std::uint32_t, std::uint32_t>> doubled(const Facets& surface) {
  std::unordered_map<Triangle, std::uint32_t, Triangle_hash> first;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    if (surface.facets[f].part != Part::surface) continue;
    const auto [at, is_new] = first.insert({sorted(surface.facets[f].corners), f});
    if (!is_new) pairs.push_back({at->second, f});
  }
  return pairs;
}

}  // namespace

Left_out leave_out_useless(Facets& surface) {
  Left_out left_out;
  std::vector<Facet>& facets = surface.facets;
  std::erase_if(facets, [&](const Facet& f) {
    if (!is_on_one_line(surface.corner(f, 0), surface.corner(f, 1), surface.corner(f, 2))) return false;
    left_out.collinear.add(centre(surface, f));
    return true;
  });
  // The order of the file stays.
  std::vector<std::uint32_t> order(facets.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::pair<Triangle, bool>> key;
  for (const Facet& f : facets) key.push_back({sorted(f.corners), runs_upwards(f.corners)});
  std::sort(order.begin(), order.end(), [&](std::uint32_t f, std::uint32_t g) {
    return std::tie(key[f], facets[f].part, f) < std::tie(key[g], facets[g].part, g);
  });
  std::vector<bool> is_repeated(facets.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key[order[i]] == key[order[i - 1]]) is_repeated[order[i]] = true;
  std::vector<Facet> kept;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    if (is_repeated[f])
      left_out.repeated.add(centre(surface, facets[f]));
    else
      kept.push_back(facets[f]);
  }
  facets = std::move(kept);
  return left_out;
}

void join_points(Facets& surface, const std::vector<std::uint32_t>& target) {
  for (Facet& f : surface.facets)
    for (std::uint32_t& v : f.corners) v = target[v];
  std::erase_if(surface.facets, [](const Facet& f) {
    const Triangle& t = f.corners;
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

Found find_doubled_sheets(Facets& surface) {
  const auto pairs = doubled(surface);
  Found found;
  if (pairs.empty()) return found;
  const std::size_t none = pairs.size();
  std::vector<std::size_t> pair_of(surface.facets.size(), none);
  for (std::size_t i = 0; i < pairs.size(); ++i) pair_of[pairs[i].first] = pair_of[pairs[i].second] = i;
  Joined_sets parts(pairs.size());
  std::vector<bool> has_own_edge(pairs.size(), false);
  const auto uses = edge_uses(surface.facets);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    std::size_t first = none;
    for (const Edge_use& use : edge) {
      const std::size_t pair = pair_of[use.facet];
      if (pair == none) continue;
      if (first != none) parts.join(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pair));
      first = pair;
    }
    if (edge.size() == 2 && first != none && pair_of[edge[0].facet] == pair_of[edge[1].facet])
      has_own_edge[first] = true;
  });
  std::vector<bool> is_sheet(pairs.size(), false);
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    if (has_own_edge[i]) is_sheet[parts.find(i)] = true;
  std::vector<bool> second_side(surface.facets.size(), false);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    if (!is_sheet[parts.find(i)]) continue;
    surface.facets[pairs[i].first].part = Part::sheet;
    second_side[pairs[i].second] = true;
    found.add(centre(surface, surface.facets[pairs[i].first]));
  }
  std::vector<Facet> kept;
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    if (!second_side[f]) kept.push_back(surface.facets[f]);
  surface.facets = std::move(kept);
  return found;
}

}  // namespace cellwalk::detail
