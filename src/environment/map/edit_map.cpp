// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edit_map.h"

#include <array>
#include <unordered_map>
#include <unordered_set>

namespace cellwalk {
namespace {

/// Calls f on each dart that starts from the vertex of d and lies in d's cell.
template <int D, class F>
void for_each_dart_in_corner(Map<D>& map, Dart<D> d, const F& f) {
  Dart<D> e = d;
  do {
    f(e);
    if constexpr (D == 3) e = map.template beta<2>(map.template beta<0>(e));
  } while (e != d);
}

template <int D>
using New_darts = std::array<Dart<D>, static_cast<std::size_t>(D)>;

}  // namespace

template <int D>
Star<D> find_star(Map_storage<D>& storage, std::uint32_t point) {
  Map<D>& map = storage.map;
  Star<D> star;
  std::unordered_set<std::uint32_t> seen;
  const auto add = [&](Dart<D> d) {
    if (seen.insert(map.info(d).cell()).second) star.darts.push_back(d);
  };
  const auto cross = [&](Dart<D> facet, Dart<D> start) {
    if (map.template is_free<D>(facet))
      star.on_boundary = true;
    else
      add(start);
  };
  for (const Map_vertex<D> vertex : storage.vertices_of(point)) {
    std::size_t next = star.darts.size();
    add(map.template dart_of_attribute<0>(vertex));
    while (next < star.darts.size())
      for_each_dart_in_corner<D>(map, star.darts[next++], [&](Dart<D> d) {
        // The dart before the vertex is xv; its other side vx starts from the vertex.
        const Dart<D> before = map.template beta<0>(d);
        cross(before, map.template beta<D>(before));
        if constexpr (D == 2) {
          // The edge after the vertex: the next edge of its other side xv starts from the vertex.
          const Dart<D> across = map.template beta<D>(d);
          cross(d, map.template is_free<D>(d) ? across : map.template beta<1>(across));
        }
      });
  }
  return star;
}

template <int D>
Map_vertex<D> insert_vertex_in_cell(Map_storage<D>& storage, std::span<const Dart<D>> facets,
                                    std::uint32_t point, const Point<D>& position) {
  Map<D>& map = storage.map;
  std::vector<Dart<D>> outer;
  for (const Dart<D> first : facets)
    for_each_dart_of_half_facet<D>(map, first, [&](Dart<D> d) { outer.push_back(d); });
  std::unordered_map<const void*, std::size_t> number;
  for (std::size_t i = 0; i < outer.size(); ++i) number.emplace(&*outer[i], i);

  // All allocations come first, since they may fail. For each dart: the new ones of the face behind its edge
  // (2D: of its triangle), in the order of their loop.
  std::vector<New_darts<D>> created(outer.size());
  storage.vertex_of_point.reserve(storage.vertex_of_point.size() + 1);
  const Map_vertex<D> apex = map.create_vertex_attribute(to_map_point(position), point);
  std::size_t made = 0;
  try {
    for (; made < outer.size() * D; ++made) created[made / D][made % D] = map.create_dart();
  } catch (...) {
    while (made-- > 0) map.erase_dart(created[made / D][made % D]);
    map.erase_vertex_attribute(apex);
    throw;
  }

  const auto new_darts = [&](Dart<D> d) -> New_darts<D>& { return created[number.at(&*d)]; };
  const auto vertex = [&](Dart<D> d) { return map.template attribute<0>(d); };
  std::vector<Dart<D>> next(outer.size()), across(outer.size());
  for (std::size_t i = 0; i < outer.size(); ++i) {
    next[i] = map.template beta<1>(outer[i]);
    across[i] = map.template beta<2>(outer[i]);
  }
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Dart<D> d = outer[i];
    Dart_info info = map.info(d);
    info.set_impassable(false);
    for (const Dart<D> e : created[i]) map.info(e) = info;
    if constexpr (D == 2) {
      // d = uv; the triangle is uv, v apex, apex u.
      const auto [to_apex, back] = created[i];
      map.template set_dart_attribute<0>(to_apex, vertex(next[i]));
      map.template set_dart_attribute<0>(back, apex);
      map.basic_link_beta_1(d, to_apex);
      map.basic_link_beta_1(to_apex, back);
      map.basic_link_beta_1(back, d);
      map.template basic_link_beta_for_involution<2>(to_apex, new_darts(next[i])[1]);
    } else {
      // d = uv; the triangle behind its edge is vu, u apex, apex v.
      const auto [along, to_apex, back] = created[i];
      map.template set_dart_attribute<0>(along, vertex(next[i]));
      map.template set_dart_attribute<0>(to_apex, vertex(d));
      map.template set_dart_attribute<0>(back, apex);
      map.basic_link_beta_1(along, to_apex);
      map.basic_link_beta_1(to_apex, back);
      map.basic_link_beta_1(back, along);
      map.template basic_link_beta_for_involution<2>(d, along);
      map.template basic_link_beta_for_involution<2>(back, new_darts(next[i])[1]);
      const auto& behind = new_darts(across[i]);
      map.template basic_link_beta_for_involution<3>(along, behind[0]);
      map.template basic_link_beta_for_involution<3>(to_apex, behind[2]);
      map.template basic_link_beta_for_involution<3>(back, behind[1]);
    }
  }
  storage.vertex_of_point.push_back(apex);
  return apex;
}

template Star<2> find_star(Map_storage<2>&, std::uint32_t);
template Star<3> find_star(Map_storage<3>&, std::uint32_t);
template Map_vertex<2> insert_vertex_in_cell<2>(Map_storage<2>&, std::span<const Dart<2>>, std::uint32_t,
                                                const Point<2>&);
template Map_vertex<3> insert_vertex_in_cell<3>(Map_storage<3>&, std::span<const Dart<3>>, std::uint32_t,
                                                const Point<3>&);

}  // namespace cellwalk
