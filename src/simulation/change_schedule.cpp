// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/kernel/error.h>
#include <cellwalk/simulation/change_schedule.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "scene_shape.h"

namespace cellwalk {
namespace {

constexpr std::array change_names{"open", "close", "excavate", "fill"};

bool is_of_facets(Change_kind kind) { return kind == Change_kind::open || kind == Change_kind::close; }

template <int D>
Point<D> mean_of_cell(const Cell_view<D>& cell) {
  Vector<D> sum{};
  for (std::size_t v = 0; v < cell.vertex_count(); ++v) sum = sum + (cell.point(v) - Point<D>{});
  return Point<D>{} + (1.0 / static_cast<double>(cell.vertex_count())) * sum;
}

template <int D>
Point<D> mean_of_facet(const Cell_view<D>& cell, std::size_t facet) {
  Vector<D> sum{};
  const auto loop = cell.loop(facet);
  for (const std::uint16_t v : loop) sum = sum + (cell.point(v) - Point<D>{});
  return Point<D>{} + (1.0 / static_cast<double>(loop.size())) * sum;
}

template <int D>
bool is_in_shape(const Environment_part<D>& part, const Point<D>& x) {
  return !part.shape || detail::distance<D>(std::span<const Scene_shape<D>>(&*part.shape, 1), x) == 0;
}

template <int D>
bool is_in_front(const Scene_plane<D>& plane, const Point<D>& x) {
  return dot(x - plane.point, plane.normal) > 0;
}

/// True if a facet, whose cells are both free, is to become a wall or passable.
template <int D>
bool needs_change(const Snapshot<D>& snapshot, Change_kind kind, Half_facet facet) {
  const Cell other = snapshot.neighbour(facet);
  return other != Cell::none && !snapshot.is_solid(snapshot.cell_of(facet)) && !snapshot.is_solid(other) &&
         snapshot.is_impassable(facet) == (kind == Change_kind::open);
}

template <int D>
bool needs_change(const Snapshot<D>& snapshot, Change_kind kind, Cell cell) {
  return snapshot.is_solid(cell) == (kind == Change_kind::excavate);
}

template <class Name>
void sort_once(std::vector<Name>& names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace

template <int D>
Selection<D> select(const Snapshot<D>& snapshot, const Environment_part<D>& part) {
  Selection<D> result;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    const Cell_view<D> view = snapshot.view(cell);
    const Point<D> mean = mean_of_cell(view);
    const bool is_front = part.plane && is_in_front(*part.plane, mean);
    if (is_in_shape(part, mean) && (!part.plane || is_front)) result.cells.push_back(cell);
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const Cell other = snapshot.neighbour(facet);
      if (other == Cell::none || snapshot.index(other) < i) continue;
      if (!is_in_shape(part, mean_of_facet(view, f))) continue;
      if (part.plane && is_front == is_in_front(*part.plane, mean_of_cell(snapshot.view(other)))) continue;
      result.facets.push_back(facet);
    }
  }
  return result;
}

template <int D>
Change_schedule<D>::Change_schedule(const Snapshot<D>& snapshot, const Environment_changes<D>& changes) {
  std::map<std::string, Selection<D>> groups;
  for (const auto& [name, part] : changes.groups) groups[name] = select(snapshot, part);
  for (std::size_t i = 0; i < changes.list.size(); ++i) {
    const Environment_change<D>& change = changes.list[i];
    Planned& planned = planned_.emplace_back(Planned{i, change.kind, change.step, change.until, {}});
    const auto group = groups.find(change.part.group);
    planned.left = group == groups.end() ? select(snapshot, change.part) : group->second;
    const bool of_facets = is_of_facets(change.kind);
    if (of_facets ? planned.left.facets.empty() : planned.left.cells.empty())
      throw Error(Error_code::input, fmt::format("changes[{}].{}: no {} of the environment lies there", i,
                                                 change_names[static_cast<std::size_t>(change.kind)],
                                                 of_facets ? "facet between two cells" : "cell"));
  }
}

template <int D>
bool Change_schedule<D>::is_due(std::uint32_t step) const {
  return std::any_of(planned_.begin(), planned_.end(), [&](const Planned& planned) {
    return planned.step <= step && step <= planned.until &&
           !(is_of_facets(planned.kind) ? planned.left.facets.empty() : planned.left.cells.empty());
  });
}

template <int D>
std::vector<Change_outcome> Change_schedule<D>::apply(const Snapshot<D>& snapshot, Reshaping<D>& reshaping,
                                                      std::uint32_t step) {
  std::vector<Change_outcome> outcomes;
  for (Planned& planned : planned_)
    if (planned.step <= step && step <= planned.until) apply_once(snapshot, reshaping, planned, outcomes);
  return outcomes;
}

/// Keeps what is refused.
template <int D>
void Change_schedule<D>::apply_once(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, Planned& planned,
                                    std::vector<Change_outcome>& outcomes) const {
  const auto change_all = [&](auto& names, const auto& change) {
    auto kept = names.begin();
    for (const auto name : names) {
      if (!needs_change(snapshot, planned.kind, name)) continue;
      Change_outcome& outcome = outcomes.emplace_back();
      outcome.change = planned.number;
      outcome.kind = planned.kind;
      outcome.result = change(name, outcome);
      if (!outcome.result.is_made) *kept++ = name;
    }
    names.erase(kept, names.end());
  };
  if (is_of_facets(planned.kind))
    change_all(planned.left.facets, [&](Half_facet facet, Change_outcome& outcome) {
      outcome.facet = facet;
      outcome.cell = snapshot.cell_of(facet);
      return planned.kind == Change_kind::open ? reshaping.open(facet) : reshaping.close(facet);
    });
  else
    change_all(planned.left.cells, [&](Cell cell, Change_outcome& outcome) {
      outcome.cell = cell;
      return planned.kind == Change_kind::excavate ? reshaping.excavate(cell) : reshaping.fill(cell);
    });
}

template <int D>
Selection<D> Change_schedule<D>::changing(const Snapshot<D>& snapshot) const {
  Selection<D> result;
  const auto add = [&](Half_facet f) {
    const Half_facet other = snapshot.opposite(f);
    if (other != Half_facet::none) result.facets.push_back(std::min(f, other));
  };
  for (const Planned& planned : planned_) {
    if (is_of_facets(planned.kind)) {
      std::for_each(planned.left.facets.begin(), planned.left.facets.end(), add);
      continue;
    }
    result.cells.insert(result.cells.end(), planned.left.cells.begin(), planned.left.cells.end());
    for (const Cell c : planned.left.cells)
      for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) add(snapshot.half_facet(c, f));
  }
  sort_once(result.facets);
  sort_once(result.cells);
  return result;
}

template Selection<2> select(const Snapshot<2>&, const Environment_part<2>&);
template Selection<3> select(const Snapshot<3>&, const Environment_part<3>&);
template class Change_schedule<2>;
template class Change_schedule<3>;

}  // namespace cellwalk
