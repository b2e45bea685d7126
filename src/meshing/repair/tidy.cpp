// SPDX-License-Identifier: GPL-3.0-or-later
// Collapsed triangles, and triangles in the same place.
#include "tidy.h"

#include <algorithm>
#include <map>
#include <utility>

#include "edges.h"
#include "meshing/fill/surface_topology.h"

namespace cellwalk::detail {
namespace {

/// Two triangles of the file in the same place.
struct Pair {
  std::uint32_t first, second;
};

/// The pairs of triangles in the same place. Of more than two, pairs go until one or two are left.
std::vector<Pair> pairs_in_place(const Facets& surface, std::vector<bool>& is_left_out) {
  std::map<Triangle, std::vector<std::uint32_t>> copies;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f)
    if (surface.facets[f].part == Part::surface) copies[sorted(surface.facets[f].corners)].push_back(f);
  std::vector<Pair> pairs;
  for (auto& [corners, of] : copies) {
    for (; of.size() > 2; of.resize(of.size() - 2))
      is_left_out[of[of.size() - 1]] = is_left_out[of[of.size() - 2]] = true;
    if (of.size() == 2) pairs.push_back({of[0], of[1]});
  }
  return pairs;
}

/// What the edges of connected pairs say about them.
struct Part_of_pairs {
  std::size_t own = 0, odd = 0,
              even = 0;      ///< edges of no other triangle, of an odd and an even number of them
  std::ptrdiff_t alike = 0;  ///< pairs of the same orientation, less those of opposite ones
};

}  // namespace

Found leave_out_collinear(Facets& surface) {
  Found found;
  std::erase_if(surface.facets, [&](const Facet& f) {
    if (!is_on_one_line(surface.corner(f, 0), surface.corner(f, 1), surface.corner(f, 2))) return false;
    found.add(centre(surface, f));
    return true;
  });
  return found;
}

void keep_one_in_each_place(Facets& surface) {
  std::map<Triangle, std::uint32_t> kept;
  std::vector<Facet> facets;
  for (const Facet& f : surface.facets) {
    const auto [at, is_new] = kept.insert({sorted(f.corners), static_cast<std::uint32_t>(facets.size())});
    if (is_new)
      facets.push_back(f);
    else if (f.part < facets[at->second].part)
      facets[at->second] = f;
  }
  surface.facets = std::move(facets);
}

Copies settle_copies(Facets& surface) {
  std::vector<bool> is_left_out(surface.facets.size(), false);
  const std::vector<Pair> pairs = pairs_in_place(surface, is_left_out);
  if (pairs.empty()) return {};
  const auto none = static_cast<std::uint32_t>(pairs.size());
  std::vector<std::uint32_t> pair_of(surface.facets.size(), none);
  for (std::uint32_t i = 0; i < none; ++i) pair_of[pairs[i].first] = pair_of[pairs[i].second] = i;
  Joined_sets sets(pairs.size());
  struct Rim {
    std::uint32_t pair;
    std::size_t others;
  };
  std::vector<Rim> rims;
  const auto uses = edge_uses(surface.facets);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    std::vector<std::uint32_t> here;
    std::size_t others = 0;
    for (const Edge_use& use : edge) {
      if (is_left_out[use.facet]) continue;
      if (pair_of[use.facet] == none)
        ++others;
      else
        here.push_back(pair_of[use.facet]);
    }
    for (const std::uint32_t pair : here) sets.join(here[0], pair);
    if (here.size() == 2) rims.push_back({here[0], others});
  });
  std::vector<Part_of_pairs> parts(pairs.size());
  for (const auto& [pair, others] : rims) {
    Part_of_pairs& part = parts[sets.find(pair)];
    ++(others == 0 ? part.own : others % 2 == 1 ? part.odd : part.even);
  }
  for (std::uint32_t i = 0; i < none; ++i)
    parts[sets.find(i)].alike += runs_upwards(surface.facets[pairs[i].first].corners) ==
                                         runs_upwards(surface.facets[pairs[i].second].corners)
                                     ? 1
                                     : -1;
  Copies result;
  for (std::uint32_t i = 0; i < none; ++i) {
    const Part_of_pairs& part = parts[sets.find(i)];
    // A sheet has an edge of its own, and ends at walls; at the border of an open surface, it has one, too.
    const bool is_sheet = part.own > 0 && part.alike < 0 && part.odd <= part.even;
    // With one of two, an odd number of others is even: the surface is closed. Two solids that touch or
    // overlap have both.
    const bool is_repeated = part.odd > part.even || part.even == 0;
    if (!is_sheet && !is_repeated) continue;
    is_left_out[pairs[i].second] = true;
    if (!is_sheet) continue;
    surface.facets[pairs[i].first].part = Part::sheet;
    result.sheets.add(centre(surface, surface.facets[pairs[i].first]));
  }
  std::vector<Facet> kept;
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    if (!is_left_out[f])
      kept.push_back(surface.facets[f]);
    else if (pair_of[f] == none || surface.facets[pairs[pair_of[f]].first].part != Part::sheet)
      result.repeated.add(centre(surface, surface.facets[f]));
  }
  surface.facets = std::move(kept);
  return result;
}

void join_points(Facets& surface, const std::vector<std::uint32_t>& target) {
  for (Facet& f : surface.facets)
    for (std::uint32_t& v : f.corners) v = target[v];
  std::erase_if(surface.facets, [](const Facet& f) {
    const Triangle& t = f.corners;
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

}  // namespace cellwalk::detail
