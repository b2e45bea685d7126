// SPDX-License-Identifier: LGPL-3.0-or-later
// The members of groups found by their points after edits, and written back into a soup.
#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>

#include "snapshot_soup.h"

namespace cellwalk {
namespace {

template <class Name>
void sort_and_unite(std::vector<Name>& names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

/// The side of a facet that groups name.
template <int D>
Half_facet named_side(const Snapshot<D>& snapshot, Half_facet f) {
  const Cell other = snapshot.neighbour(f);
  return other == Cell::none || snapshot.index(snapshot.cell_of(f)) < snapshot.index(other)
             ? f
             : snapshot.opposite(f);
}

template <int D>
std::vector<std::uint32_t> sorted_points(const Snapshot<D>& snapshot, Half_facet facet) {
  std::vector<std::uint32_t> points = snapshot.loop(facet);
  std::sort(points.begin(), points.end());
  return points;
}
template <int D>
std::vector<std::uint32_t> sorted_points(const Snapshot<D>& snapshot, Cell cell) {
  const auto vertices = snapshot.view(cell).vertices;
  std::vector<std::uint32_t> points(vertices.begin(), vertices.end());
  std::sort(points.begin(), points.end());
  return points;
}

template <int D>
bool is_there(const Snapshot<D>& snapshot, Half_facet facet) {
  const Cell cell = snapshot.cell_of(facet);
  return snapshot.is_cell(cell) && snapshot.facet_of(facet) < snapshot.facet_count(cell);
}
template <int D>
bool is_there(const Snapshot<D>& snapshot, Cell cell) {
  return snapshot.is_cell(cell);
}

void check_number(const std::string& group, const char* what, std::uint32_t number, std::size_t count) {
  if (number < count) return;
  throw Error(Error_code::input, "group " + group + " names " + what + " " + std::to_string(number) + " of " +
                                     std::to_string(count));
}

}  // namespace

template <int D>
Group_places<D>::Group_places(const Cell_soup<D>& soup, const Soup_groups& groups) {
  for (const auto& [name, group] : groups) {
    names_.push_back(name);
    for (const std::uint32_t cell : group.cells) {
      check_number(name, "cell", cell, soup.cell_count());
      places_.push_back({cell, name, {}});
    }
    for (const std::uint32_t facet : group.facets) {
      check_number(name, "facet", facet, soup.facet_count());
      const auto after = std::upper_bound(soup.cell_begin.begin(), soup.cell_begin.end(), facet);
      Place& place = places_.emplace_back(
          Place{static_cast<std::uint32_t>(after - soup.cell_begin.begin() - 1), name, {}});
      for (const std::uint32_t v : soup.facet(facet)) {
        check_number(name, "a facet of point", v, soup.points.size());
        place.points.push_back(soup.points[v]);
      }
      std::sort(place.points.begin(), place.points.end());
    }
  }
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.cell < b.cell; });
}

template <int D>
Groups<D> Group_places<D>::find(const Snapshot<D>& snapshot, std::span<const std::uint32_t> origin) const {
  Groups<D> groups;
  for (const std::string& name : names_) groups[name];
  if (places_.empty()) return groups;
  const auto origin_of = [&](Cell cell) {
    const std::uint32_t index = snapshot.index(cell);
    return origin.empty() ? index : origin[index];
  };
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    const std::uint32_t input = origin_of(cell);
    for (auto at = std::ranges::lower_bound(places_, input, {}, &Place::cell);
         at != places_.end() && at->cell == input; ++at) {
      const Place& place = *at;
      if (place.points.empty()) {
        groups[place.group].cells.push_back(cell);
        continue;
      }
      // A part of a facet has points of it only, and unlike a facet between parts of the cell, one part
      // beside it.
      for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
        const Half_facet f = Snapshot<D>::half_facet(cell, k);
        const Cell other = snapshot.neighbour(f);
        if (other != Cell::none && origin_of(other) == place.cell) continue;
        if (std::ranges::all_of(snapshot.loop(f), [&](std::uint32_t p) {
              return std::ranges::binary_search(place.points, snapshot.point(p));
            }))
          groups[place.group].facets.push_back(named_side(snapshot, f));
      }
    }
  }
  for (auto& [name, selection] : groups) {
    sort_and_unite(selection.facets);
    sort_and_unite(selection.cells);
  }
  return groups;
}

template <int D>
Lasting_groups<D>::Lasting_groups(const Snapshot<D>& snapshot, const Groups<D>& groups) {
  for (const auto& [name, selection] : groups) {
    Group& group = groups_[name];
    for (const Half_facet f : selection.facets) group.facets.push_back({f, sorted_points(snapshot, f)});
    for (const Cell c : selection.cells) group.cells.push_back({c, sorted_points(snapshot, c)});
  }
}

template <int D>
std::vector<std::string> Lasting_groups<D>::names() const {
  std::vector<std::string> names;
  for (const auto& entry : groups_) names.push_back(entry.first);
  return names;
}

template <int D>
Groups<D> Lasting_groups<D>::now(const Snapshot<D>& snapshot) const {
  Groups<D> groups;
  // Facets whose cell was replaced: another cell may have them.
  std::map<std::vector<std::uint32_t>, std::vector<std::string>> sought;
  for (const auto& [name, group] : groups_) {
    Selection<D>& left = groups[name];
    for (const auto& [cell, points] : group.cells)
      if (is_there(snapshot, cell) && sorted_points(snapshot, cell) == points) left.cells.push_back(cell);
    for (const auto& [facet, points] : group.facets)
      if (is_there(snapshot, facet) && sorted_points(snapshot, facet) == points)
        left.facets.push_back(named_side(snapshot, facet));
      else
        sought[points].push_back(name);
  }
  if (sought.empty()) return groups;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(cell, k);
      const auto found = sought.find(sorted_points(snapshot, f));
      if (found == sought.end()) continue;
      for (const std::string& name : found->second) groups[name].facets.push_back(named_side(snapshot, f));
    }
  }
  for (auto& [name, selection] : groups) sort_and_unite(selection.facets);
  return groups;
}

template <int D>
Soup_groups soup_groups(const Snapshot<D>& snapshot, const Groups<D>& groups) {
  Soup_groups result;
  if (groups.empty()) return result;
  std::vector<Half_facet> names;
  soup_of(snapshot, &names);
  std::vector<std::uint32_t> facet_of(snapshot.half_facet_slots());
  for (std::uint32_t f = 0; f < names.size(); ++f) facet_of[to_index(names[f])] = f;
  // The soup has no gaps between its cells.
  std::vector<std::uint32_t> cell_of(snapshot.cell_slots());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < cell_of.size(); ++i)
    if (snapshot.cell(i) != Cell::none) cell_of[i] = next++;
  for (const auto& [name, selection] : groups) {
    Soup_group& group = result[name];
    for (const Half_facet f : selection.facets) group.facets.push_back(facet_of[to_index(f)]);
    for (const Cell c : selection.cells) group.cells.push_back(cell_of[snapshot.index(c)]);
    sort_and_unite(group.facets);
    sort_and_unite(group.cells);
  }
  return result;
}

template class Group_places<2>;
template class Group_places<3>;
template class Lasting_groups<2>;
template class Lasting_groups<3>;
template Soup_groups soup_groups(const Snapshot<2>&, const Groups<2>&);
template Soup_groups soup_groups(const Snapshot<3>&, const Groups<3>&);

}  // namespace cellwalk
