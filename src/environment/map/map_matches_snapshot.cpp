// SPDX-License-Identifier: LGPL-3.0-or-later
// The half-facets of each cell of the map, read by their darts and compared with the stored loops.
#include "map_matches_snapshot.h"

#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <vector>

namespace cellwalk {
namespace {

/// The points of a half-facet of the map, starting at its lowest point.
template <int D>
std::vector<std::uint32_t> loop_of(const Map_storage<D>& storage, Const_dart<D> d) {
  std::vector<std::uint32_t> loop;
  for_each_dart_of_half_facet<D>(storage.map, d,
                                 [&](Const_dart<D> e) { loop.push_back(storage.point_of(e)); });
  if (D == 2) loop.push_back(storage.point_of(storage.map.template beta<1>(d)));
  return loop;
}

bool is_same_loop(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b) {
  // An edge has no rotations.
  if (a.size() > 2) {
    std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
    std::rotate(b.begin(), std::min_element(b.begin(), b.end()), b.end());
  }
  return a == b;
}

template <int D>
bool is_same_half_facet(const Map_storage<D>& storage, const Snapshot<D>& snapshot, Half_facet f) {
  if (storage.dart_of_half_facet[to_index(f)] == Dart<D>{}) return false;
  const Const_dart<D> d = storage.dart_of_half_facet[to_index(f)];
  const Dart_info& info = storage.map.info(d);
  const Half_facet across = storage.map.template is_free<D>(d)
                                ? Half_facet::none
                                : Half_facet{storage.map.info(storage.map.template beta<D>(d)).half_facet()};
  const Cell c = snapshot.cell_of(f);
  return info.cell() == snapshot.index(c) && info.half_facet() == to_index(f) &&
         info.is_impassable() == snapshot.is_impassable(f) && info.is_solid() == snapshot.is_solid(c) &&
         across == snapshot.opposite(f) && has_loop_of(storage, snapshot, d, f);
}

}  // namespace

template <int D>
void check_map_matches_snapshot(const Map_storage<D>& storage, const Snapshot<D>& snapshot) {
  const auto refuse = [](const std::string& what) {
    throw Error(Error_code::other,
                "map and snapshot differ " + what + "; edit them through Environment only");
  };
  if (storage.cell_count != snapshot.cell_count() || storage.cell_slots != snapshot.cell_slots() ||
      storage.dart_of_half_facet.size() != snapshot.half_facet_slots() ||
      storage.vertex_of_point.size() != snapshot.points().size())
    refuse("in the number of their cells or points");
  std::size_t half_facets = 0;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    bool same = snapshot.index(c) == i;
    for (std::size_t k = 0; same && k < snapshot.facet_count(c); ++k, ++half_facets)
      same = is_same_half_facet(storage, snapshot, snapshot.half_facet(c, k));
    if (!same) refuse("in cell " + std::to_string(i));
  }
  const auto is_used = [](Dart<D> d) { return d != Dart<D>{}; };
  if (half_facets != static_cast<std::size_t>(std::count_if(storage.dart_of_half_facet.begin(),
                                                            storage.dart_of_half_facet.end(), is_used)))
    refuse("in the number of their facets");
  for (std::uint32_t p = 0; p < storage.vertex_of_point.size(); ++p) {
    if (snapshot.is_point(p) == (storage.vertex_of_point[p] == Map_vertex<D>{}))
      refuse("in whether there is point " + std::to_string(p));
    for (const Map_vertex<D> v : storage.vertices_of(p))
      for (int i = 0; i < D; ++i)
        if (storage.map.point_of_vertex_attribute(v)[i] != snapshot.point(p)[i])
          refuse("in the position of point " + std::to_string(p));
  }
}

template <int D>
bool has_loop_of(const Map_storage<D>& storage, const Snapshot<D>& snapshot, Const_dart<D> d, Half_facet f) {
  return is_same_loop(loop_of(storage, d), snapshot.loop(f));
}

template bool has_loop_of(const Map_storage<2>&, const Snapshot<2>&, Const_dart<2>, Half_facet);
template bool has_loop_of(const Map_storage<3>&, const Snapshot<3>&, Const_dart<3>, Half_facet);
template void check_map_matches_snapshot(const Map_storage<2>&, const Snapshot<2>&);
template void check_map_matches_snapshot(const Map_storage<3>&, const Snapshot<3>&);

}  // namespace cellwalk
