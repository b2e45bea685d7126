// SPDX-License-Identifier: LGPL-3.0-or-later
#include "toggle.h"

#include <algorithm>
#include <array>

#include "shrinkage.h"

namespace cellwalk::detail {
namespace {

Change_result made() { return {true, {}, {}}; }
Change_result refused(const char* reason) { return {false, reason, {}}; }

template <int D>
Box<D> box_of_facet(const Snapshot<D>& snapshot, Half_facet facet) {
  Box<D> box;
  for (const std::uint32_t p : snapshot.loop(facet)) box.extend(snapshot.point(p));
  return box;
}

}  // namespace

template <int D>
Change_result Toggle<D>::open(Half_facet facet) {
  editor_.check(facet);
  if (!snapshot().is_impassable(facet)) return made();
  const Cell own = snapshot().cell_of(facet), other = snapshot().neighbour(facet);
  if (other == Cell::none) return refused("the facet lies on the boundary of the environment");
  if (snapshot().is_solid(own) != snapshot().is_solid(other))
    return refused("the facet parts a solid cell from a free one");
  editor_.set_wall(facet, false);
  forget_rests(std::array{facet, snapshot().opposite(facet)});
  return made();
}

template <int D>
Change_result Toggle<D>::excavate(Cell cell) {
  editor_.check(cell);
  if (!snapshot().is_solid(cell)) return made();
  editor_.excavate(cell);
  std::vector<Half_facet> opened;
  for (const Half_facet f : editor_.passages(cell, false)) opened.push_back(snapshot().opposite(f));
  forget_rests(opened);
  return made();
}

/// Faces rest no more on facets that are no walls any more. They are on the same sides of all others, also if
/// something of their bodies is stale.
template <int D>
void Toggle<D>::forget_rests(std::span<const Half_facet> facets) {
  if (D == 2 || facets.empty()) return;
  Box<D> box;
  for (const Half_facet f : facets) box.extend(box_of_facet<D>(snapshot(), f));
  const auto& groups = groups_.all();
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const Resident_group<D>& group = groups[g];
    if (!group.body || !group.body->keeps_faces() || !group.reach.meets(box)) continue;
    for (std::uint32_t f = 0; f < group.faces.size(); ++f) {
      Supporting_walls walls = group.body->supporting_walls(f);
      const auto left = std::remove_if(walls.begin(), walls.end(), [&](Half_facet wall) {
        return std::find(facets.begin(), facets.end(), wall) != facets.end();
      });
      if (left == walls.end()) continue;
      walls.erase(left, walls.end());
      groups_.rest({g, f}, walls);
    }
  }
}

template <int D>
Change_result Toggle<D>::close(Half_facet facet) {
  editor_.check(facet);
  if (snapshot().is_impassable(facet)) return made();
  if (!snapshot().is_solid(snapshot().cell_of(facet))) {
    Change_result result = refused("something lies on both sides of the facet");
    result.held_by = Shrinkage<D>(editor_, groups_, std::array{facet}, Cell::none, counts_).run();
    return result.held_by.empty() ? made() : result;
  }
  editor_.set_wall(facet, true);
  return made();
}

template <int D>
Change_result Toggle<D>::fill(Cell cell) {
  editor_.check(cell);
  if (snapshot().is_solid(cell)) return made();
  Change_result result = refused("something lies in the cell");
  const std::vector<Half_facet> walls = editor_.passages(cell, false);
  result.held_by = Shrinkage<D>(editor_, groups_, walls, cell, counts_).run();
  return result.held_by.empty() ? made() : result;
}

template class Toggle<2>;
template class Toggle<3>;

}  // namespace cellwalk::detail
