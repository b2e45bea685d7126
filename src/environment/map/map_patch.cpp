// SPDX-License-Identifier: LGPL-3.0-or-later
// Darts and vertices of the new cells: all are allocated before the old ones are unlinked.
#include "map_patch.h"

#include <cellwalk/kernel/error.h>

#include <algorithm>

namespace cellwalk {
namespace {

/// Room for one more and for those to come: the memory of all edits together stays linear.
template <class T>
void reserve_at_least(std::vector<T>& v, std::size_t size) {
  if (v.capacity() < size) v.reserve(std::max(size, 2 * v.capacity()));
}

}  // namespace

template <int D>
Map_patch<D>::Map_patch(Map_storage<D>& storage, const Snapshot<D>& snapshot,
                        const Cell_exchange<D>& exchange, std::uint32_t added)
    : storage_(storage), exchange_(exchange), soup_(exchange.soup), added_(added) {
  // All allocations come first, since they may fail.
  const std::size_t count = D == 2 ? soup_.facet_count() : soup_.vertices.size();
  darts_.reserve(count);
  origins_.reserve(count);
  find_old(snapshot);
  std::size_t slots = storage.dart_of_half_facet.size();
  for (std::size_t c = 0; c < soup_.cell_count(); ++c)
    slots += (soup_.cell_begin[c + 1] - soup_.cell_begin[c] + 3) / 4 * 4;
  if (slots >= Dart_info::most_half_facets)
    throw Error(Error_code::input, "more than 2^29 slots of half-facets: split the environment");
  reserve_at_least(storage.dart_of_half_facet, slots);
  reserve_at_least(storage.vertex_of_point, storage.vertex_of_point.size() + 1);
  try {
    while (darts_.size() < count) darts_.push_back(storage.map.create_dart());
    if (added_ != no_point)
      added_vertex_ = storage.map.create_vertex_attribute(typename Map<D>::Point{}, added_);
  } catch (...) {
    for (std::size_t i = old_darts_; i < darts_.size(); ++i) storage.map.erase_dart(darts_[i]);
    throw;
  }
}

template <int D>
Map_patch<D>::~Map_patch() {
  if (is_applied_) return;
  for (std::size_t i = old_darts_; i < darts_.size(); ++i) storage_.map.erase_dart(darts_[i]);
  if (added_ != no_point) storage_.map.erase_vertex_attribute(added_vertex_);
}

/// Finds the half-facets, darts and vertices of the removed cells.
/// \pre darts_ has the capacity that is needed
template <int D>
void Map_patch<D>::find_old(const Snapshot<D>& snapshot) {
  Map<D>& map = storage_.map;
  const std::size_t count = D == 2 ? soup_.facet_count() : soup_.vertices.size();
  for (const Cell c : exchange_.removed)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      removed_.push_back(f);
      for_each_dart_of_half_facet<D>(map, storage_.dart_of_half_facet[to_index(f)], [&](Dart<D> d) {
        if (darts_.size() < count)
          darts_.push_back(d);
        else
          surplus_.push_back(d);
        const Map_vertex<D> vertex = map.template attribute<0>(d);
        const auto is_vertex = [&](const auto& entry) { return entry.second == vertex; };
        if (std::ranges::none_of(vertices_, is_vertex)) add_vertex(storage_.point_of(d), vertex);
        if (!map.template is_free<D>(d)) __builtin_prefetch(&*map.template beta<D>(d), 1);
      });
    }
  old_darts_ = darts_.size();
}

template <int D>
void Map_patch<D>::add_vertex(std::uint32_t point, Map_vertex<D> vertex) {
  vertices_.emplace_back(point, vertex);
  if (vertices_.size() < 256) place_[point % place_.size()] = static_cast<std::uint8_t>(vertices_.size());
}

template <int D>
Map_vertex<D> Map_patch<D>::vertex_of(std::uint32_t point) const {
  if (point == added_) return added_vertex_;
  const std::size_t place = place_[point % place_.size()];
  if (place != 0 && vertices_[place - 1].first == point) return vertices_[place - 1].second;
  return std::ranges::find(vertices_, point, [](const auto& entry) { return entry.first; })->second;
}

/// The dart in which the other side of a facet begins that a new cell has in common with one that stays;
/// Dart<D>{} for other facets.
template <int D>
Dart<D> Map_patch<D>::dart_outside(std::size_t facet) const {
  const Half_facet outside = exchange_.outside[facet];
  return outside == Half_facet::none ? Dart<D>{} : storage_.dart_of_half_facet[to_index(outside)];
}

/// Makes the darts start from the vertices of the new cells. Vertices without darts are left for later.
template <int D>
void Map_patch<D>::set_vertices(const Snapshot<D>& snapshot) {
  Map<D>& map = storage_.map;
  if (added_ != no_point) {
    map.point_of_vertex_attribute(added_vertex_) = to_map_point(snapshot.point(added_));
    if (added_ == storage_.vertex_of_point.size())
      storage_.vertex_of_point.push_back(added_vertex_);
    else
      storage_.vertex_of_point[added_] = added_vertex_;
  }
  for (std::size_t i = 0; i < darts_.size(); ++i) {
    const Map_vertex<D> vertex = vertex_of(soup_.vertices[D == 2 ? 2 * i : i]);
    origins_.push_back(vertex);
    map.template restricted_set_dart_attribute<0>(darts_[i], vertex);
    map.template set_dart_of_attribute<0>(vertex, darts_[i]);
  }
}

/// Links the darts of each new cell with each other.
template <int D>
void Map_patch<D>::link_cells() {
  Map<D>& map = storage_.map;
  const auto link_loop = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      map.basic_link_beta_1(darts_[i], darts_[i + 1 == end ? begin : i + 1]);
  };
  for (std::size_t c = 0; c < soup_.cell_count(); ++c) {
    const std::uint32_t begin = soup_.cell_begin[c], end = soup_.cell_begin[c + 1];
    if constexpr (D == 2) {
      link_loop(begin, end);
    } else {
      const auto& first = soup_.facet_begin;
      const auto& origin = soup_.vertices;
      for (std::size_t f = begin; f < end; ++f) link_loop(first[f], first[f + 1]);
      // Across each edge uv of a facet lies the facet with vu.
      const auto link_edge = [&](std::size_t f, std::size_t i) {
        const std::uint32_t u = origin[i], v = origin[i + 1 == first[f + 1] ? first[f] : i + 1];
        for (std::size_t g = f + 1; g < end; ++g)
          for (std::size_t j = first[g]; j < first[g + 1]; ++j)
            if (origin[j] == v && origin[j + 1 == first[g + 1] ? first[g] : j + 1] == u) {
              map.template basic_link_beta_for_involution<2>(darts_[i], darts_[j]);
              return;
            }
      };
      for (std::size_t f = begin; f < end; ++f)
        for (std::size_t i = first[f]; i < first[f + 1]; ++i) link_edge(f, i);
    }
  }
}

/// Links a facet of the soup to a dart of its other side, in 3D any of them.
template <int D>
void Map_patch<D>::link_across(std::size_t facet, Dart<D> other) {
  Map<D>& map = storage_.map;
  if constexpr (D == 2) {
    map.template basic_link_beta_for_involution<2>(darts_[facet], other);
  } else {
    const std::size_t begin = soup_.facet_begin[facet], end = soup_.facet_begin[facet + 1];
    while (map.template attribute<0>(other) != origins_[begin + 1]) other = map.template beta<1>(other);
    for (std::size_t i = begin; i < end; ++i) {
      map.template basic_link_beta_for_involution<3>(darts_[i], other);
      other = map.template beta<0>(other);
    }
  }
}

/// Links the new cells with each other, and with those that stay.
/// \pre the darts have their vertices, and are linked in their cells
template <int D>
void Map_patch<D>::link_facets() {
  Map<D>& map = storage_.map;
  const auto unlink = [&](Dart<D> d) { map.template dart_unlink_beta<D>(d); };
  for (std::size_t f = 0; f < soup_.facet_count(); ++f) {
    const std::uint32_t g = exchange_.gluing.opposite[f];
    if (g != no_facet) {
      if (f < g) link_across(f, first(g));
    } else if (const Dart<D> outside = dart_outside(f); outside != Dart<D>{}) {
      link_across(f, outside);
    } else {  // the link to the old dart is gone
      for_each_dart_of_half_facet<D>(map, first(f), unlink);
    }
  }
  for (const Half_facet open : exchange_.left_open)  // a hole is left
    for_each_dart_of_half_facet<D>(map, storage_.dart_of_half_facet[to_index(open)], [&](Dart<D> d) {
      unlink(d);
      map.info(d).set_impassable(true);
      map.template set_dart_of_attribute<0>(map.template attribute<0>(d), d);
    });
}

/// Takes the darts away that no new cell has, and the vertices without darts.
template <int D>
void Map_patch<D>::forget_old() {
  Map<D>& map = storage_.map;
  for (const Dart<D> d : surplus_) map.restricted_erase_dart(d);
  auto& pinched = storage_.pinched;
  for (const auto& [point, vertex] : vertices_) {
    if (map.template get_attribute_ref_counting<0>(vertex) != 0) continue;
    const auto part = std::ranges::find(pinched, std::pair(point, vertex));
    if (part != pinched.end()) {
      pinched.erase(part);
    } else {
      const std::uint32_t own = point;
      const auto other = std::ranges::find(pinched, own, [](const auto& entry) { return entry.first; });
      storage_.vertex_of_point[own] = other == pinched.end() ? Map_vertex<D>{} : other->second;
      if (other != pinched.end()) pinched.erase(other);
    }
    map.template erase_attribute<0>(vertex);
  }
  for (const Half_facet f : removed_) storage_.dart_of_half_facet[to_index(f)] = Dart<D>{};
}

/// Gives the darts of the new cells their marks and numbers.
template <int D>
void Map_patch<D>::mark(const Snapshot<D>& snapshot, std::span<const Half_facet> slots) {
  Map<D>& map = storage_.map;
  storage_.dart_of_half_facet.resize(snapshot.half_facet_slots(), Dart<D>{});
  storage_.cell_count = snapshot.cell_count();
  storage_.cell_slots = snapshot.cell_slots();
  for (std::size_t f = 0; f < slots.size(); ++f) {
    storage_.dart_of_half_facet[to_index(slots[f])] = first(f);
    const Cell cell = snapshot.cell_of(slots[f]);
    const Dart_info info(snapshot.index(cell), to_index(slots[f]), snapshot.is_impassable(slots[f]),
                         snapshot.is_solid(cell));
    const bool has_outside = exchange_.outside[f] != Half_facet::none;
    for_each_dart_of_half_facet<D>(map, first(f), [&](Dart<D> d) {
      map.info(d) = info;
      if (has_outside) map.info(map.template beta<D>(d)).set_impassable(info.is_impassable());
    });
  }
}

template <int D>
void Map_patch<D>::apply(const Snapshot<D>& snapshot, std::span<const Half_facet> slots) {
  is_applied_ = true;
  set_vertices(snapshot);
  link_cells();
  link_facets();
  forget_old();
  mark(snapshot, slots);
}

template class Map_patch<2>;
template class Map_patch<3>;

}  // namespace cellwalk
