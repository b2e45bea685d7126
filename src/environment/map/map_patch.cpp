// SPDX-License-Identifier: LGPL-3.0-or-later
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

constexpr auto point_of_vertex = [](const auto& vertex) { return vertex.first; };

}  // namespace

template <int D>
Map_patch<D>::Map_patch(Map_storage<D>& storage, std::span<const Half_facet> removed,
                        const Cell_soup<D>& soup, const Gluing& gluing, std::uint32_t added)
    : storage_(storage),
      soup_(soup),
      gluing_(gluing),
      added_(added),
      removed_(removed.begin(), removed.end()) {
  find_outside(removed);
  // All allocations come first, since they may fail.
  std::size_t slots = storage.dart_of_half_facet.size();
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    slots += (soup.cell_begin[c + 1] - soup.cell_begin[c] + 3) / 4 * 4;
  if (slots >= Dart_info::most_half_facets)
    throw Error(Error_code::input, "more than 2^29 slots of half-facets: split the environment");
  reserve_at_least(storage.dart_of_half_facet, slots);
  reserve_at_least(storage.vertex_of_point, storage.vertex_of_point.size() + 1);
  try {
    make_darts();
  } catch (...) {
    for (const Dart<D> d : new_darts_) storage.map.erase_dart(d);
    throw;
  }
}

template <int D>
Map_patch<D>::~Map_patch() {
  if (is_applied_) return;
  for (const Dart<D> d : new_darts_) storage_.map.erase_dart(d);
  if (added_ != no_point) storage_.map.erase_vertex_attribute(added_vertex_);
}

template <int D>
typename Map_patch<D>::Key Map_patch<D>::key_of(std::span<const std::uint32_t> loop) {
  Key key(loop.begin(), loop.end());
  std::sort(key.begin(), key.end());
  return key;
}

/// Finds the darts and vertices of the removed cells, and the facets that they share with others.
template <int D>
void Map_patch<D>::find_outside(std::span<const Half_facet> removed) {
  const Map<D>& map = storage_.map;
  std::vector<std::uint32_t> cells, loop;
  for (const Half_facet f : removed)
    if (const std::uint32_t c = map.info(storage_.dart_of_half_facet[to_index(f)]).cell();
        cells.empty() || cells.back() != c)
      cells.push_back(c);
  for (const Half_facet f : removed) {
    const Dart<D> first = storage_.dart_of_half_facet[to_index(f)];
    loop.clear();
    for_each_dart_of_half_facet<D>(storage_.map, first, [&](Dart<D> d) {
      old_darts_.push_back(d);
      loop.push_back(storage_.point_of(d));
      const auto known = std::ranges::find(vertices_, loop.back(), point_of_vertex);
      if (known == vertices_.end()) {
        vertices_.emplace_back(loop.back(), storage_.map.template attribute<0>(d));
        old_darts_at_.push_back(1);
      } else if (known->second == storage_.map.template attribute<0>(d)) {
        ++old_darts_at_[static_cast<std::size_t>(known - vertices_.begin())];
      }
    });
    if (map.template is_free<D>(first)) continue;
    if (D == 2) loop.push_back(storage_.point_of(map.template beta<1>(first)));
    const Dart<D> outside = storage_.map.template beta<D>(first);
    if (std::ranges::find(cells, map.info(Const_dart<D>(outside)).cell()) == cells.end())
      open_.push_back({key_of(loop), outside});
  }
}

template <int D>
void Map_patch<D>::make_darts() {
  Map<D>& map = storage_.map;
  const std::size_t count = D == 2 ? soup_.facet_count() : soup_.vertices.size();
  new_darts_.reserve(count);
  first_.reserve(soup_.facet_count());
  while (new_darts_.size() < count) new_darts_.push_back(map.create_dart());
  for (std::size_t f = 0; f < soup_.facet_count(); ++f)
    first_.push_back(new_darts_[D == 2 ? f : soup_.facet_begin[f]]);
  if (added_ != no_point) added_vertex_ = map.create_vertex_attribute(typename Map<D>::Point{}, added_);
}

/// Links the darts of each new cell with each other.
template <int D>
void Map_patch<D>::link_cells() {
  Map<D>& map = storage_.map;
  const auto link_loop = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      map.basic_link_beta_1(new_darts_[i], new_darts_[i + 1 == end ? begin : i + 1]);
  };
  for (std::size_t c = 0; c < soup_.cell_count(); ++c) {
    const std::uint32_t begin = soup_.cell_begin[c], end = soup_.cell_begin[c + 1];
    if constexpr (D == 2) {
      link_loop(begin, end);
    } else {
      for (std::size_t f = begin; f < end; ++f) link_loop(soup_.facet_begin[f], soup_.facet_begin[f + 1]);
      // Across each edge uv of a facet lies the facet with vu.
      const std::size_t first = soup_.facet_begin[begin], last = soup_.facet_begin[end];
      const auto origin = [&](std::size_t i) { return soup_.vertices[i]; };
      std::vector<std::uint32_t> target(last - first);
      for (std::size_t f = begin; f < end; ++f)
        for (std::size_t i = soup_.facet_begin[f]; i < soup_.facet_begin[f + 1]; ++i)
          target[i - first] = origin(i + 1 == soup_.facet_begin[f + 1] ? soup_.facet_begin[f] : i + 1);
      for (std::size_t i = first; i < last; ++i)
        for (std::size_t j = i + 1; j < last; ++j)
          if (origin(i) == target[j - first] && origin(j) == target[i - first])
            map.template basic_link_beta_for_involution<2>(new_darts_[i], new_darts_[j]);
    }
  }
}

/// Links a facet of the soup to a dart of its other side, in 3D any of them.
template <int D>
void Map_patch<D>::link_across(std::size_t facet, Dart<D> other) {
  Map<D>& map = storage_.map;
  if constexpr (D == 2) {
    map.template basic_link_beta_for_involution<2>(first_[facet], other);
  } else {
    const auto loop = soup_.facet(facet);
    while (storage_.point_of(other) != loop[1]) other = map.template beta<1>(other);
    Dart<D> own = first_[facet];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      map.template basic_link_beta_for_involution<3>(own, other);
      own = map.template beta<1>(own);
      other = map.template beta<0>(other);
    }
  }
}

/// Links the new cells with each other, and with those that stay.
/// \pre the darts have their vertices
template <int D>
void Map_patch<D>::link_to_stay() {
  for (std::size_t f = 0; f < soup_.facet_count(); ++f) {
    const std::uint32_t g = gluing_.opposite[f];
    if (g != no_facet) {
      if (f < g) link_across(f, first_[g]);
      continue;
    }
    const auto open = std::ranges::find(open_, key_of(soup_.facet(f)), &Open_facet::key);
    if (open == open_.end()) continue;
    link_across(f, open->outside);
    open->outside = Dart<D>{};
  }
  for (const Open_facet& open : open_)  // a hole is left
    if (open.outside != Dart<D>{})
      for_each_dart_of_half_facet<D>(storage_.map, open.outside,
                                     [&](Dart<D> d) { storage_.map.template dart_unlink_beta<D>(d); });
}

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
  for (std::size_t i = 0; i < new_darts_.size(); ++i) {
    const std::uint32_t point = soup_.vertices[D == 2 ? 2 * i : i];
    const auto known = std::ranges::find(vertices_, point, point_of_vertex);
    map.template set_dart_attribute<0>(new_darts_[i],
                                       known != vertices_.end() ? known->second : added_vertex_);
  }
}

/// Vertices that no new cell has go, with the last of their darts.
template <int D>
void Map_patch<D>::forget_vertices() {
  auto& pinched = storage_.pinched;
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    const auto [own, vertex] = vertices_[k];
    if (storage_.map.template get_attribute_ref_counting<0>(vertex) != old_darts_at_[k]) continue;
    const auto part = std::ranges::find(pinched, std::pair(own, vertex));
    if (part != pinched.end()) {
      pinched.erase(part);
      continue;
    }
    const auto other = std::ranges::find(pinched, own, [](const auto& entry) { return entry.first; });
    storage_.vertex_of_point[own] = other == pinched.end() ? Map_vertex<D>{} : other->second;
    if (other != pinched.end()) pinched.erase(other);
  }
}

template <int D>
void Map_patch<D>::apply(const Snapshot<D>& snapshot, std::span<const Half_facet> slots) {
  is_applied_ = true;
  Map<D>& map = storage_.map;
  set_vertices(snapshot);
  link_cells();
  link_to_stay();
  forget_vertices();
  for (const Half_facet f : removed_) storage_.dart_of_half_facet[to_index(f)] = Dart<D>{};
  for (const Dart<D> d : old_darts_) map.erase_dart(d);
  storage_.dart_of_half_facet.resize(snapshot.half_facet_slots(), Dart<D>{});
  storage_.cell_count = snapshot.cell_count();
  storage_.cell_slots = snapshot.cell_slots();
  for (std::size_t f = 0; f < slots.size(); ++f) {
    storage_.dart_of_half_facet[to_index(slots[f])] = first_[f];
    const Cell cell = snapshot.cell_of(slots[f]);
    const Dart_info info(snapshot.index(cell), to_index(slots[f]), snapshot.is_impassable(slots[f]),
                         snapshot.is_solid(cell));
    for_each_dart_of_half_facet<D>(map, first_[f], [&](Dart<D> d) {
      map.info(d) = info;
      if (!map.template is_free<D>(d)) map.info(map.template beta<D>(d)).set_impassable(info.is_impassable());
    });
  }
  for (const Open_facet& open : open_)
    if (open.outside != Dart<D>{})
      for_each_dart_of_half_facet<D>(map, open.outside, [&](Dart<D> d) { map.info(d).set_impassable(true); });
}

template class Map_patch<2>;
template class Map_patch<3>;

}  // namespace cellwalk
