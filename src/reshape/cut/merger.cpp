// SPDX-License-Identifier: LGPL-3.0-or-later
#include "merger.h"

#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/star_index.h>

#include <algorithm>

#include "reshape/replace/patch.h"
#include "simplices.h"

namespace cellwalk::detail {

/// True if the facet that a kept cell gets where a gap cell vanishes is passable: solid heals, and free space
/// stays joined unless a membrane was on either side of the gap cell.
template <int D>
bool Merger<D>::is_sewn(Cell kept, Cell gap, std::uint32_t point, std::uint32_t onto) const {
  const Snapshot<D>& s = snapshot();
  const Half_facet inner = facet_off(s, gap, onto), outer = facet_off(s, gap, point);
  const Cell beyond = s.neighbour(outer);
  if (beyond == Cell::none || s.is_solid(beyond) != s.is_solid(kept)) return false;
  return s.is_solid(kept) || !(s.is_impassable(inner) || s.is_impassable(outer));
}

/// Adds the cells around a point, with another one instead of it, but for those that have both. Returns why
/// this cannot be; empty if it can.
/// \param opened receives the facets that are to be passable where a gap cell vanishes
template <int D>
std::string Merger<D>::add_cells(std::span<const Cell> star, std::uint32_t point, std::uint32_t onto,
                                 Cell_soup<D>& soup, std::vector<Seam>& opened) const {
  const Snapshot<D>& s = snapshot();
  const auto has_both = [&](Cell c) { return has_corner(s, c, onto); };
  if (std::ranges::any_of(star, [&](Cell c) { return has_both(c) && s.is_solid(c); }))
    return "a solid cell has both points";
  if (std::ranges::none_of(star, has_both)) return "no free cell has both points";
  for (const Cell c : star) {
    const auto old = corners_of(s, c);
    const bool vanishes = has_both(c);
    std::array<bool, static_cast<std::size_t>(D) + 1> walls{};
    std::array<Point<D>, static_cast<std::size_t>(D) + 1> x;
    for (std::size_t k = 0; k < old.size(); ++k) {
      x[k] = s.point(old[k] == point ? onto : old[k]);
      const Half_facet facet = facet_off(s, c, old[k]);
      const Cell other = s.neighbour(facet);
      walls[k] = s.is_impassable(facet);
      if (old[k] == point) continue;
      if (other == Cell::none) return "the boundary has the point";
      if (vanishes || !has_corner(s, other, onto)) continue;
      walls[k] = !is_sewn(c, other, point, onto);
      if (!walls[k]) opened.push_back({soup.cell_count(), old[k]});
    }
    if (vanishes) continue;
    if (volume_sign(x) <= 0) return "a cell would be flat or inverted";
    auto simplex = old;
    std::ranges::replace(simplex, point, onto);
    add_cell(soup, simplex, walls, s.is_solid(c));
  }
  return "";
}

/// All that is registered in some free cells, and the faces near them.
template <int D>
std::vector<Resident> Merger<D>::find_holders(std::span<const Cell> free) {
  const Snapshot<D>& s = snapshot();
  const auto is_among = [&](Cell c) { return std::ranges::find(free, c) != free.end(); };
  std::vector<Member> vertices, edges;
  groups_.find(free, vertices, edges);
  std::vector<Resident> holders;
  holders.reserve(vertices.size() + edges.size());
  for (const Member v : vertices) holders.push_back(groups_.at(v, Body_feature::vertex));
  for (const Member e : edges) {  // the table may still name cells that an edge has left
    const auto ends = groups_.all()[e.group].edges[e.number];
    if (std::ranges::any_of(ends,
                            [&](std::uint32_t v) {
                              return is_among(groups_.particle({e.group, v}).cell);
                            }) ||
        std::ranges::any_of(groups_.chain(e), [&](Half_facet f) { return is_among(s.neighbour(f)); }))
      holders.push_back(groups_.at(e, Body_feature::edge));
  }
  for (const Member f : groups_.faces_near(box_of<D>(s, free)))
    holders.push_back(groups_.at(f, Body_feature::face));
  std::sort(holders.begin(), holders.end());
  return holders;
}

template <int D>
Replacement Merger<D>::merge(std::uint32_t point, std::uint32_t onto) {
  const Snapshot<D>& s = snapshot();
  const std::vector<Cell> star = environment_.cells_around(point);
  Replacement result;
  Cell_soup<D> soup;
  std::vector<Seam> opened;
  result.reason = add_cells(star, point, onto, soup, opened);
  if (!result.reason.empty()) return result;
  std::vector<Cell> free;
  std::ranges::copy_if(star, std::back_inserter(free), [&](Cell c) { return !s.is_solid(c); });
  counts_.opened += groups_.open(box_of<D>(s, star));
  if (groups_.has_open()) {
    result.held_by = find_holders(free);
    if (!result.held_by.empty()) {
      result.reason = "something lies in the free cells around the point";
      return result;
    }
  }
  relinker_.note(free);
  is_broken_ = true;
  result.cells = patcher_.replace(star, soup, glue_patch(soup));
  free.clear();
  std::ranges::copy_if(result.cells, std::back_inserter(free), [&](Cell c) { return !s.is_solid(c); });
  relinker_.relink(free);
  for (const Seam& seam : opened) toggle_.open(facet_off(s, result.cells[seam.cell], seam.apex));
  is_broken_ = false;
  result.is_made = true;
  result.point = point;
  return result;
}

template class Merger<2>;
template class Merger<3>;

}  // namespace cellwalk::detail
