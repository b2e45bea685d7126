// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls joined into groups at their common ridges, and the choice of a side for each group.
#include "supporting_wall_search.h"

#include <cellwalk/internal/walk/star.h>

namespace cellwalk::detail {
namespace {

bool has_in_facet(const Exact_edge& edge, Half_facet f, const Fraction& t) {
  const std::optional<Span> met = edge.in_facet(f);
  return met && met->low <= t && t <= met->high;
}

}  // namespace

Supporting_wall_search::Supporting_wall_search(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                                               const Swept_in_plane& swept, const Candidate_walls& candidates)
    : snapshot_(snapshot), triangle_(triangle), swept_(swept), walls_(candidates.walls) {
  for (const Half_facet wall : candidates.walls) add(wall);
  pair_one_sided();
  groups_.resize(patches_.size());
  for (std::size_t k = 0; k < patches_.size(); ++k) join(patches_[k].behind, k);
  for (const Ridge& ridge : ridges_) join(ridge.patches, ridge.patches.empty() ? 0 : ridge.patches.front());
  for (const Patch& patch : patches_)
    if (patch.behind.empty()) groups_[patch.group].may_be(-patch.side) = false;  // no free space there
  for (const Ridge& ridge : ridges_) bound(ridge);
}

void Supporting_wall_search::add(Half_facet wall) {
  const Cell_view<3> cell = view(wall);
  const std::size_t i = snapshot_.facet_of(wall);
  const bool in_plane = triangle_.holds(cell, i);
  const std::size_t first = patches_.size();
  if (in_plane) {
    if (!overlap(cell, i)) return;
    const int side = triangle_.side_of_cell(cell, i);
    patches_.push_back({wall, side, first, false});
    const Half_facet other = snapshot_.opposite(wall);
    if (other != Half_facet::none && !snapshot_.is_solid(snapshot_.cell_of(other))) {
      patches_.push_back({other, -side, first + 1, true, {first}});
      patches_[first].behind.push_back(first + 1);
    }
  }
  const auto loop = cell.loop(i);
  std::vector<int> heights;
  for (const std::uint16_t v : loop) heights.push_back(triangle_.side(cell.point(v)));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::size_t next = k + 1 == loop.size() ? 0 : k + 1;
    if (heights[k] != 0 || heights[next] != 0) continue;
    if (!overlap(cell.point(loop[k]), cell.point(loop[next]))) continue;
    Ridge& ridge = ridge_of(cell.point_index(loop[k]), cell.point_index(loop[next]), wall);
    if (in_plane) ridge.patches.push_back(first);
    // A wall out of the plane with a ridge in it lies on one side.
    ridge.is_above |= std::any_of(heights.begin(), heights.end(), [](int h) { return h > 0; });
    ridge.is_below |= std::any_of(heights.begin(), heights.end(), [](int h) { return h < 0; });
  }
}

Supporting_wall_search::Ridge& Supporting_wall_search::ridge_of(std::uint32_t u, std::uint32_t v,
                                                                Half_facet wall) {
  for (Ridge& ridge : ridges_)
    if ((ridge.u == u && ridge.v == v) || (ridge.u == v && ridge.v == u)) return ridge;
  ridges_.push_back({u, v, false, false, wall, {}});
  return ridges_.back();
}

void Supporting_wall_search::pair_one_sided() {
  std::vector<std::size_t> above, below;
  for (std::size_t k = 0; k < patches_.size(); ++k)
    if (patches_[k].behind.empty()) (patches_[k].side > 0 ? above : below).push_back(k);
  for (const std::size_t k : above) {
    for (const std::size_t m : below) {
      const Half_facet f = patches_[k].half, g = patches_[m].half;
      if (!overlap(view(f), snapshot_.facet_of(f), view(g), snapshot_.facet_of(g))) continue;
      patches_[k].behind.push_back(m);
      patches_[m].behind.push_back(k);
    }
  }
}

template <class Patches>
void Supporting_wall_search::join(const Patches& others, std::size_t with) {
  for (const std::size_t other : others) {
    const std::size_t from = patches_[other].group, to = patches_[with].group;
    if (from == to) continue;
    for (Patch& patch : patches_)
      if (patch.group == from) patch.group = to;
  }
}

void Supporting_wall_search::bound(const Ridge& ridge) {
  if (ridge.is_above && ridge.is_below) piercing_ = ridge.wall;
  for (const std::size_t k : ridge.patches) {
    Group& group = groups_[patches_[k].group];
    group.may_be(1) &= !ridge.is_above;
    group.may_be(-1) &= !ridge.is_below;
    if (!group.may_be(1) && !group.may_be(-1)) piercing_ = ridge.wall;
  }
}

void Supporting_wall_search::take(const Patch& patch) {
  Group& group = groups_[patch.group];
  if (group.side == 0 && group.may_be(patch.side)) group.side = patch.side;
  if (group.side == patch.side || piercing_ != Half_facet::none) return;
  piercing_ = patch.behind.empty() ? patch.half : patches_[patch.behind.front()].half;
}

bool Supporting_wall_search::take(Half_facet half) {
  const auto patch = std::ranges::find(patches_, half, &Patch::half);
  if (patch == patches_.end()) return false;
  const bool is_news = groups_[patch->group].determined() == 0;
  take(*patch);
  return is_news;
}

// Where walls near begin and end along an edge, ascending: between two of these places nothing changes.
std::vector<Fraction> Supporting_wall_search::ends_along(const Exact_edge& edge) const {
  std::vector<Fraction> ends;
  for (const Half_facet wall : walls_)
    if (const std::optional<Span> met = edge.in_facet(wall)) ends.insert(ends.end(), {met->low, met->high});
  std::sort(ends.begin(), ends.end());
  return ends;
}

// Chooses the sides on which the chain of an edge passes.
void Supporting_wall_search::follow(const Face_side& side) {
  if (side.from == side.to) return;
  const Exact_edge edge(snapshot_, side.from, side.to);
  std::vector<Fraction> ends;
  for (std::size_t first = 0; first < patches_.size(); ++first) {
    if (patches_[first].is_second) continue;
    const std::optional<Span> met = edge.in_facet(patches_[first].half);
    if (!met) continue;
    if (ends.empty()) ends = ends_along(edge);
    std::vector<Fraction> points;
    if (!(met->low < met->high)) points.push_back(met->low);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      if (ends[k] < ends[k + 1] && !(ends[k] < met->low) && !(met->high < ends[k + 1]))
        points.push_back(middle(ends[k], ends[k + 1]));
    for (const Fraction& t : points) {
      const std::vector<Cell> linked = linked_cells(edge, side.start, *side.chain.chain, t);
      const auto is_linked = [&](const Patch& patch) {
        return std::find(linked.begin(), linked.end(), snapshot_.cell_of(patch.half)) != linked.end();
      };
      for (std::size_t k = first; k < patches_.size() && (k == first || patches_[k].is_second); ++k) {
        const Patch& patch = patches_[k];
        if (!is_linked(patch)) continue;
        // Around the rim of a wall, the edge is linked with both sides.
        const bool is_round = std::any_of(patch.behind.begin(), patch.behind.end(), [&](std::size_t other) {
          return is_linked(patches_[other]) && has_in_facet(edge, patches_[other].half, t);
        });
        if (!is_round) take(patch);
      }
    }
  }
}

bool Supporting_wall_search::choose_next() {
  for (const Patch& patch : patches_) {
    Group& group = groups_[patch.group];
    if (group.side != 0 || !group.may_be(1) || !group.may_be(-1)) continue;
    group.side = triangle_.fixed_side();
    return true;
  }
  return false;
}

std::vector<Half_facet> Supporting_wall_search::taken() const {
  std::vector<Half_facet> halves;
  for (const Patch& patch : patches_)
    if (groups_[patch.group].determined() == patch.side) halves.push_back(patch.half);
  return halves;
}

std::vector<Half_facet> Supporting_wall_search::halves_at(int side) const {
  std::vector<Half_facet> halves;
  for (const Patch& patch : patches_)
    if (patch.side == side) halves.push_back(patch.half);
  return halves;
}

Supporting_walls Supporting_wall_search::under_face() const {
  Supporting_walls found;
  for (const Patch& patch : patches_)
    if (side_of(groups_[patch.group]) == patch.side &&
        triangle_.overlaps(view(patch.half), snapshot_.facet_of(patch.half)))
      found.push_back(patch.half);
  sort(found);
  return found;
}

int Supporting_wall_search::side_of(const Group& group) const {
  const int fixed = triangle_.fixed_side();
  return group.side != 0 ? group.side : group.may_be(fixed) ? fixed : -fixed;
}

}  // namespace cellwalk::detail
