// SPDX-License-Identifier: LGPL-3.0-or-later
// The conditions of each change of facets and cells, and the faces that rest on walls opened.
#include "toggle.h"

#include <algorithm>
#include <array>
#include <utility>

#include "shrinkage.h"

namespace cellwalk::detail {
namespace {

Outcome made() { return {true, {}, {}}; }
Outcome refused(const char* reason) { return {false, reason, {}}; }

/// \param reason why not, if something holds
/// \param too_near why not, if only radii forbid it
template <int D>
Outcome shrunk(Shrinkage<D> change, const char* reason, const char* too_near) {
  if (std::vector<Resident> holders = change.holders(); !holders.empty()) {
    if (!change.is_too_near()) return {false, reason, std::move(holders)};
    return {false, too_near, std::move(holders), change.distance()};
  }
  change.make();
  return made();
}

template <int D>
Box<D> box_of_facet(const Snapshot<D>& snapshot, Half_facet facet) {
  Box<D> box;
  for (const std::uint32_t p : snapshot.loop(facet)) box.extend(snapshot.point(p));
  return box;
}

}  // namespace

template <int D>
Outcome Toggle<D>::open(Half_facet facet) {
  editor_.check(facet);
  if (!snapshot().is_impassable(facet)) return made();
  const Cell own = snapshot().cell_of(facet), other = snapshot().neighbour(facet);
  if (other == Cell::none) return refused("the facet lies on the boundary of the environment");
  if (snapshot().is_solid(own) != snapshot().is_solid(other))
    return refused("the facet parts a solid cell from a free one");
  Rests rests = rests_without(std::array{facet, snapshot().opposite(facet)});
  editor_.set_wall(facet, false);
  rest(std::move(rests));
  return made();
}

template <int D>
Outcome Toggle<D>::excavate(Cell cell) {
  editor_.check(cell);
  if (!snapshot().is_solid(cell)) return made();
  std::vector<Half_facet> opened;
  for (std::size_t i = 0; i < snapshot().facet_count(cell); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(cell, i);
    const Cell other = snapshot().neighbour(f);
    if (other != Cell::none && !snapshot().is_solid(other)) opened.push_back(snapshot().opposite(f));
  }
  Rests rests = rests_without(opened);
  editor_.excavate(cell);
  rest(std::move(rests));
  return made();
}

/// The supporting walls of faces once some facets are no walls any more. The faces are on the same sides of
/// all others, also if parts of their bodies are stale.
template <int D>
typename Toggle<D>::Rests Toggle<D>::rests_without(std::span<const Half_facet> facets) const {
  Rests rests;
  if (D == 2 || facets.empty()) return rests;
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
      rests.emplace_back(Member{g, f}, std::move(walls));
    }
  }
  return rests;
}

template <int D>
void Toggle<D>::rest(Rests rests) noexcept {
  for (auto& [face, walls] : rests) groups_.rest(face, std::move(walls));
}

template <int D>
Outcome Toggle<D>::close(Half_facet facet) {
  editor_.check(facet);
  if (snapshot().is_impassable(facet)) return made();
  if (!snapshot().is_solid(snapshot().cell_of(facet)))
    return shrunk(Shrinkage<D>(editor_, groups_, facet, counts_), "something lies on both sides of the facet",
                  "something is nearer to the facet than its radius");
  editor_.set_wall(facet, true);
  return made();
}

template <int D>
Outcome Toggle<D>::fill(Cell cell) {
  editor_.check(cell);
  if (snapshot().is_solid(cell)) return made();
  return shrunk(Shrinkage<D>(editor_, groups_, cell, counts_), "something lies in the cell",
                "something is nearer to the cell than its radius");
}

template class Toggle<2>;
template class Toggle<3>;

}  // namespace cellwalk::detail
