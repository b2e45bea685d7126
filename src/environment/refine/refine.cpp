// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets that face each other are found, divided by each other's sides, and replaced in the soup.
#include <cellwalk/internal/environment/refine.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crossings.h"
#include "environment/certify/common_part.h"
#include "environment/soup/describe_place.h"
#include "hanging_points.h"
#include "joining.h"
#include "lone_facets.h"
#include "pieces.h"

namespace cellwalk {
namespace {

using detail::Facet_pair;
using detail::Lone_facet;

/// Facets that face each other.
template <int D>
struct Facing {
  std::vector<Lone_facet<D>> facets;
  std::vector<Facet_pair> overlapping;  ///< to be divided
  std::vector<Facet_pair> near;         ///< others
  double tolerance = 0;                 ///< 0: exact

  Facing_facets described(const Cell_soup<D>& cells, const std::vector<Facet_pair>& pairs) const {
    return detail::described<D>(cells.points, facets, pairs);
  }
};

/// Nothing if the cells cannot be glued.
template <int D>
std::optional<Facing<D>> find_facing(const Cell_soup<D>& cells, double share) {
  Gluing gluing;
  try {
    gluing = glue(cells);
  } catch (const Error&) {
    return {};
  }
  Facing<D> facing{detail::lone_facets(cells, gluing), {}, {}, 0};
  detail::Box<D> box;
  for (const Lone_facet<D>& facet : facing.facets) box.extend(facet.box);
  const double tolerance =
      share == 0 ? detail::facing_tolerance<D>(box) : detail::facing_tolerance<D>(box, share);
  auto [touching, near] = detail::facing_pairs<D>(cells.points, facing.facets, tolerance, share == 0);
  if (share == 0) {
    facing.overlapping = std::move(touching);
    std::erase_if(near, [&](const Facet_pair& pair) {
      return cells.impassable[facing.facets[pair[0]].facet] && cells.impassable[facing.facets[pair[1]].facet];
    });
    facing.near = std::move(near);
  } else {
    facing.tolerance = tolerance;
    facing.overlapping = std::move(near);
  }
  return facing;
}

/// \throw Error(not_certified) if there are facets that should touch, but do not
void refuse_near(const Facing_facets& facets, const std::string& remedy) {
  if (facets.pairs == 0) return;
  throw Error(
      Error_code::not_certified,
      "cells " + std::to_string(facets.cells[0]) + " and " + std::to_string(facets.cells[1]) +
          " have facets that face each other at " + detail::describe_place(facets.place) +
          " but do not touch" +
          (facets.pairs == 1 ? "" : ", the first of " + std::to_string(facets.pairs) + " such pairs") +
          ": nothing would pass between them; " + remedy);
}

bool name_facets_beyond(const Soup_groups& groups, std::size_t facets) {
  return std::ranges::any_of(groups, [&](const auto& named) {
    return std::ranges::any_of(named.second.facets, [&](std::uint32_t f) { return f >= facets; });
  });
}

/// Replaces facets by their pieces.
void follow_pieces(Soup_groups& groups, const std::vector<std::uint32_t>& begin) {
  for (auto& [name, group] : groups) {
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t f : group.facets)
      for (std::uint32_t piece = begin[f]; piece < begin[f + 1]; ++piece) pieces.push_back(piece);
    group.facets = std::move(pieces);
  }
}

/// Within a tolerance no facets may be left that face each other.
template <int D>
void check_result(const Cell_soup<D>& soup, double share) {
  const Cell_soup<D> cells = detail::united(soup);
  if (const auto left = find_facing(cells, share))
    refuse_near(left->described(cells, left->overlapping), "give another --conform, or mend the mesh there");
  else
    glue(cells);  // says why it cannot be done
}

}  // namespace

template <int D>
Refinement refine(Cell_soup<D>& soup, Soup_groups& groups, double share) {
  Refinement done;
  const bool is_finite_soup =
      std::all_of(soup.points.begin(), soup.points.end(), [](const Point<D>& p) { return is_finite(p); });
  if (!is_finite_soup || name_facets_beyond(groups, soup.facet_count())) return done;
  const auto is_index = [&](std::uint32_t v) { return v < soup.points.size(); };
  if (!std::all_of(soup.vertices.begin(), soup.vertices.end(), is_index)) return done;
  Cell_soup<D> cells = detail::united(soup);
  std::optional<Facing<D>> facing = find_facing(cells, share);
  if (!facing) return done;
  refuse_near(facing->described(cells, facing->near),
              "join them by --conform 1e-9, or keep walls there by --conform off");
  if (facing->overlapping.empty()) return done;

  Refinement made{facing->described(cells, facing->overlapping)};
  if (share != 0 && detail::join_corners<D>(cells, facing->facets, facing->tolerance, made)) {
    facing = find_facing(cells, share);
    if (!facing) return done;
  }
  detail::Sides<D> sides(cells.points, facing->tolerance);
  if constexpr (D == 3)
    detail::add_crossings(cells.points, facing->facets, facing->overlapping, facing->tolerance, sides);
  detail::add_hanging_points<D>(cells.points, facing->facets, facing->overlapping, facing->tolerance, sides);
  made.points_added = cells.points.size() - soup.points.size();
  const auto pieces =
      detail::pieces_of<D>(cells.points, facing->facets, facing->overlapping, sides, facing->tolerance);
  if (!pieces) {
    if (share != 0) check_result(soup, share);
    return done;
  }
  for (const auto& [facet, loops] : *pieces) {
    if (loops.size() == 1) continue;
    ++made.facets;
    made.pieces += loops.size();
  }
  std::vector<std::uint32_t> begin;
  Cell_soup<D> result = detail::with_pieces(soup, cells, *pieces, sides, facing->tolerance, begin);
  if (share != 0) check_result(result, share);
  soup = std::move(result);
  follow_pieces(groups, begin);
  return made;
}

template Refinement refine(Cell_soup<2>&, Soup_groups&, double);
template Refinement refine(Cell_soup<3>&, Soup_groups&, double);

}  // namespace cellwalk
