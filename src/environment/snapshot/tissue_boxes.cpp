// SPDX-License-Identifier: LGPL-3.0-or-later
// The boxes of runs and groups, computed when a search first needs them.
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/tissue_boxes.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// The number of names of cells in a run, and of runs in a group.
constexpr std::size_t names_a_run = 64, runs_a_group = 64;

/// True for a solid cell, and for a free one at a wall to a free cell.
template <int D>
bool is_tissue(const Snapshot<D>& snapshot, Cell cell) {
  if (snapshot.is_solid(cell)) return true;
  for (std::size_t i = 0; i < snapshot.facet_count(cell); ++i) {
    const Half_facet facet = Snapshot<D>::half_facet(cell, i);
    if (!snapshot.is_impassable(facet)) continue;
    const Cell other = snapshot.neighbour(facet);
    if (other != Cell::none && !snapshot.is_solid(other)) return true;
  }
  return false;
}

template <int D>
Box<D> box_of(const Cell_view<D>& cell) {
  Box<D> box;
  for (std::size_t v = 0; v < cell.vertex_count(); ++v) box.extend(cell.point(v));
  return box;
}

template <int D>
std::size_t name_count(const Snapshot<D>& snapshot) {
  return snapshot.half_facet_slots() / 4;
}

/// Calls visit(cell) for the tissue of a run.
template <int D, class Visit>
void for_each_of_run(const Snapshot<D>& snapshot, std::size_t run, const Visit& visit) {
  const std::size_t end = std::min((run + 1) * names_a_run, name_count(snapshot));
  for (std::size_t name = run * names_a_run; name < end; ++name) {
    const Cell cell{static_cast<std::uint32_t>(name)};
    if (snapshot.is_cell(cell) && is_tissue(snapshot, cell)) visit(cell);
  }
}

}  // namespace

template <int D>
void Tissue_boxes<D>::clear() {
  runs_.clear();
  groups_.clear();
}

template <int D>
void Tissue_boxes<D>::forget(Cell cell) {
  const std::size_t run = static_cast<std::size_t>(cell) / names_a_run, group = run / runs_a_group;
  if (run < runs_.size()) runs_[run].is_known = false;
  if (group < groups_.size()) groups_[group].is_known = false;
}

template <int D>
const Box<D>& Tissue_boxes<D>::box_of_run(const Snapshot<D>& snapshot, std::size_t run) const {
  Known_box& known = runs_[run];
  if (!known.is_known) {
    known.box = {};
    for_each_of_run(snapshot, run, [&](Cell cell) { known.box.extend(box_of(snapshot.view(cell))); });
    known.is_known = true;
  }
  return known.box;
}

template <int D>
const Box<D>& Tissue_boxes<D>::box_of_group(const Snapshot<D>& snapshot, std::size_t group) const {
  Known_box& known = groups_[group];
  if (!known.is_known) {
    known.box = {};
    const std::size_t end = std::min((group + 1) * runs_a_group, runs_.size());
    for (std::size_t run = group * runs_a_group; run < end; ++run)
      known.box.extend(box_of_run(snapshot, run));
    known.is_known = true;
  }
  return known.box;
}

template <int D>
std::vector<Cell> Tissue_boxes<D>::find(const Snapshot<D>& snapshot,
                                        const std::function<bool(const Box<D>&)>& is_near) const {
  const std::lock_guard lock(mutex_);
  const std::size_t runs = (name_count(snapshot) + names_a_run - 1) / names_a_run;
  if (runs > runs_.size() && !groups_.empty()) groups_.back().is_known = false;  // it may have more runs now
  runs_.resize(runs);
  groups_.resize((runs + runs_a_group - 1) / runs_a_group);
  std::vector<Cell> cells;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    if (!is_near(box_of_group(snapshot, group))) continue;
    const std::size_t end = std::min((group + 1) * runs_a_group, runs);
    for (std::size_t run = group * runs_a_group; run < end; ++run) {
      if (!is_near(box_of_run(snapshot, run))) continue;
      for_each_of_run(snapshot, run, [&](Cell cell) {
        if (is_near(box_of(snapshot.view(cell)))) cells.push_back(cell);
      });
    }
  }
  return cells;
}

template class Tissue_boxes<2>;
template class Tissue_boxes<3>;

}  // namespace cellwalk::detail
