// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of a replacement: residents noted, cells exchanged, residents registered again.
#include "cell_transaction.h"

#include <cellwalk/internal/environment/boundary_index.h>

#include <algorithm>
#include <iterator>

#include "reshape/toggle/shrinkage.h"

namespace cellwalk::detail {

template <int D>
Cell_transaction<D>::Cell_transaction(Environment<D>& environment, Resident_groups<D>& groups,
                                      Reshape_counts& counts)
    : environment_(environment),
      groups_(groups),
      counts_(counts),
      patcher_(environment),
      relinker_(groups, environment.snapshot(), counts.walk) {}

template <int D>
std::vector<Cell> Cell_transaction<D>::free_of(std::span<const Cell> cells) const {
  std::vector<Cell> free;
  std::ranges::copy_if(cells, std::back_inserter(free), [&](Cell c) { return !snapshot().is_solid(c); });
  return free;
}

template <int D>
void Cell_transaction<D>::open(std::span<const Cell> cells) {
  counts_.opened += groups_.open(box_of<D>(snapshot(), cells));
}

template <int D>
std::vector<Resident> Cell_transaction<D>::leave(std::span<const Cell> free, const Moved_walls* moved) {
  Wall_editor<D> editor(environment_);
  Shrinkage<D> leaving(editor, groups_, free, counts_.walk);
  std::vector<Resident> holders = leaving.holders();
  if (moved) add_holders(free, *moved, holders);
  if (holders.empty()) leaving.make();
  return holders;
}

/// Walls between solid cells are behind others, and need not be left out.
template <int D>
void Cell_transaction<D>::add_holders(std::span<const Cell> free, const Moved_walls& moved,
                                      std::vector<Resident>& holders) const {
  for (const Member f : groups_.faces_near(box_of<D>(snapshot(), free)))
    holders.push_back(groups_.at(f, Body_feature::face));
  const auto& [soup, added] = moved;
  std::vector<Point<D>> corners;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    if (soup.impassable[f] == 0) continue;
    corners.clear();
    for (const std::uint32_t p : soup.facet(f))
      corners.push_back(added && p == snapshot().next_point() ? *added : snapshot().point(p));
    groups_.add_nearer(corners, holders);
  }
  std::ranges::sort(holders);
  holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
}

template <int D>
std::vector<Cell> Cell_transaction<D>::replace(std::span<const Cell> removed, const Cell_soup<D>& soup,
                                               const Gluing& gluing, const std::optional<Point<D>>& added,
                                               Into into,
                                               const std::function<void(std::span<const Cell>)>& finish) {
  is_broken_ = true;
  std::vector<Cell> cells = patcher_.replace(removed, soup, gluing, added);
  counts_.relinked +=
      into == Into::all ? relinker_.relink(cells) : relinker_.relink(std::span<const Cell>(free_of(cells)));
  if (finish) finish(cells);
  is_broken_ = false;
  return cells;
}

template class Cell_transaction<2>;
template class Cell_transaction<3>;

}  // namespace cellwalk::detail
