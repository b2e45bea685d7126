// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits of the map by its user: the result is read, certified apart, and takes the place of the snapshot; if
// it is refused, the map is built again from the snapshot.
#include <cellwalk/environment/map_edit.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "environment/certify/facing.h"
#include "environment/map/read_map.h"
#include "environment/snapshot/compiler.h"
#include "prepare_soup.h"

namespace cellwalk {
namespace {

/// The names of what is in the snapshot and in the new one.
template <int D>
Compaction names_after(const Snapshot<D>& before, const Snapshot<D>& after, Read_map<D>& read,
                       const std::vector<Half_facet>& names) {
  Compaction result;
  result.points = std::move(read.points);
  result.half_facets.assign(before.half_facet_slots(), Half_facet::none);
  result.cells.assign(before.half_facet_slots() / 4, Cell::none);
  for (std::size_t f = 0; f < names.size(); ++f) {
    if (read.before[f] == Half_facet::none) continue;
    result.half_facets[to_index(read.before[f])] = names[f];
    result.cells[to_index(before.cell_of(read.before[f]))] = after.cell_of(names[f]);
  }
  return result;
}

/// Writes indices, marks and names into the map, as if it had been built from the soup.
template <int D>
void index_map(Map_storage<D>& storage, const Read_map<D>& read, const std::vector<Half_facet>& names,
               std::size_t slots) {
  const Cell_soup<D>& soup = read.soup;
  storage.cell_count = storage.cell_slots = soup.cell_count();
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      for_each_dart_of_half_facet<D>(storage.map, read.darts[f], [&](Dart<D> d) {
        storage.map.info(d) = Dart_info(c, to_index(names[f]), soup.impassable[f], soup.solid[c]);
      });
  storage.vertex_of_point.assign(soup.points.size(), Map_vertex<D>{});
  storage.pinched.clear();
  for (const auto& [vertex, point] : read.vertices) {
    storage.map.template info_of_attribute<0>(vertex) = point;
    if (storage.vertex_of_point[point] == Map_vertex<D>{})
      storage.vertex_of_point[point] = vertex;
    else
      storage.pinched.emplace_back(point, vertex);
  }
  std::stable_sort(storage.pinched.begin(), storage.pinched.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  assign_half_facets<D>(storage, read.darts, names, slots);
  try {
    check_map(storage);
  } catch (const Error& error) {
    throw Error(
        Error_code::not_certified,
        std::string("the edited map is sewn wrongly: sew facets whose points agree (") + error.what() + ")");
  }
}

}  // namespace

template <int D>
void set_impassable(Map<D>& map, Dart<D> facet, bool wall) {
  for_each_dart_of_half_facet<D>(map, facet, [&](Dart<D> d) { map.info(d).set_impassable(wall); });
  if (map.template is_free<D>(facet)) return;
  for_each_dart_of_half_facet<D>(map, map.template beta<D>(facet),
                                 [&](Dart<D> d) { map.info(d).set_impassable(wall); });
}

template <int D>
Compaction Environment<D>::edit_storage(const std::function<void(Map_storage<D>&)>& change) {
  Map_storage<D>& storage = editable();
  try {
    change(storage);
    Read_map<D> read = read_map(storage, *snapshot_);
    if (read.soup.cell_count() == 0)
      throw Error(Error_code::input, "the edited map has no cells: an environment needs at least one");
    check_soup(read.soup);
    mark_walls(read.soup, read.gluing);
    std::vector<Half_facet> names;
    Snapshot<D> snapshot = Snapshot<D>::compile(read.soup, read.gluing, &names);
    Facing_walls facing;
    cellwalk::certify(snapshot, allow_duplicates_, &facing);
    if (!allow_duplicates_) detail::refuse_overlapping<D>(facing.overlapping);
    Compaction result = names_after(*snapshot_, snapshot, read, names);
    index_map(storage, read, names, snapshot.half_facet_slots());
    std::vector<std::pair<Half_facet, Half_facet>> turned;
    std::vector<Cell> added;
    for (std::size_t f = 0; f < names.size(); ++f) {
      const Half_facet old = read.before[f];
      if (old == Half_facet::none) {
        if (added.empty() || added.back() != snapshot.cell_of(names[f]))
          added.push_back(snapshot.cell_of(names[f]));
      } else if (snapshot_->is_impassable(old) != snapshot.is_impassable(names[f])) {
        turned.emplace_back(names[f], snapshot.opposite(names[f]));
      }
    }
    Snapshot_compiler<D> compiler(snapshot);
    compiler.follow(*snapshot_, {result.cells, result.half_facets});
    compiler.note_edited(added, turned);
    *snapshot_ = std::move(snapshot);
    boundary_.reset();
    stars_.reset();
    return result;
  } catch (...) {
    storage_.reset();
    thaw();
    throw;
  }
}

template Compaction Environment<2>::edit_storage(const std::function<void(Map_storage<2>&)>&);
template Compaction Environment<3>::edit_storage(const std::function<void(Map_storage<3>&)>&);
template void set_impassable<2>(Map<2>&, Dart<2>, bool);
template void set_impassable<3>(Map<3>&, Dart<3>, bool);

}  // namespace cellwalk
