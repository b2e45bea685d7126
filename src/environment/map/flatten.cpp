// SPDX-License-Identifier: LGPL-3.0-or-later
// The darts of the map sorted by cell, and written as loops in snapshot order.
#include <cellwalk/internal/environment/flatten.h>

#include <algorithm>
#include <numeric>

#include "environment/soup/parallel.h"

namespace cellwalk {
namespace {

template <int D>
Point<D> from_cgal(const typename Map<D>::Point& p) {
  Point<D> result;
  for (int i = 0; i < D; ++i) result[i] = p[i];
  return result;
}

/// Fills cell_begin and darts: all half-facets by cell, in each cell by number.
template <int D>
void sort_by_cell(const Map_storage<D>& storage, Flat_cells<D>& flat) {
  const Map<D>& map = storage.map;
  const auto cell_of = [&](Dart<D> d) { return map.info(Const_dart<D>(d)).cell(); };
  auto& begin = flat.soup.cell_begin;
  begin.assign(storage.cell_count + 1, 0);
  for (const Dart<D>& d : storage.dart_of_half_facet)
    if (d != Dart<D>{}) ++begin[cell_of(d) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  flat.darts.resize(begin.back());
  for (const Dart<D>& d : storage.dart_of_half_facet)
    if (d != Dart<D>{}) flat.darts[next[cell_of(d)]++] = d;
}

/// Sorts the edges of 2D cell c into their order around the cell.
void turn_round(const Map_storage<2>& storage, Flat_cells<2>& flat, std::size_t c) {
  Const_dart<2> d = flat.darts[flat.soup.cell_begin[c]];
  for (std::uint32_t f = flat.soup.cell_begin[c]; f < flat.soup.cell_begin[c + 1]; ++f) {
    flat.darts[f] = storage.dart_of_half_facet[storage.map.info(d).half_facet()];
    d = storage.map.beta<1>(d);
  }
}

template <int D>
std::uint32_t loop_size(const Map<D>& map, Const_dart<D> d) {
  if (D == 2) return 2;
  std::uint32_t n = 0;
  for_each_dart_of_half_facet<D>(map, d, [&](Const_dart<D>) { ++n; });
  return n;
}

/// Writes the loop and mark of half-facet f, and whether its cell is solid.
template <int D>
void write_facet(const Map_storage<D>& storage, Flat_cells<D>& flat, std::size_t f) {
  const Map<D>& map = storage.map;
  const Const_dart<D> d = flat.darts[f];
  std::uint32_t* out = flat.soup.vertices.data() + flat.soup.facet_begin[f];
  if constexpr (D == 2) {
    out[0] = storage.point_of(d);
    out[1] = storage.point_of(map.template beta<1>(d));
  } else {
    for_each_dart_of_half_facet<D>(map, d, [&](Const_dart<D> e) { *out++ = storage.point_of(e); });
  }
  flat.soup.impassable[f] = map.info(d).is_impassable();
}

/// Given cell_begin and darts, fills everything else except points and gluing.
template <int D>
void write_facets(const Map_storage<D>& storage, Flat_cells<D>& flat) {
  Cell_soup<D>& soup = flat.soup;
  soup.facet_begin.assign(flat.darts.size() + 1, 0);
  for_each_parallel(flat.darts.size(), [&](std::size_t f) {
    soup.facet_begin[f + 1] = loop_size<D>(storage.map, flat.darts[f]);
  });
  std::partial_sum(soup.facet_begin.begin(), soup.facet_begin.end(), soup.facet_begin.begin());
  soup.vertices.resize(soup.facet_begin.back());
  soup.impassable.resize(flat.darts.size());
  for_each_parallel(flat.darts.size(), [&](std::size_t f) { write_facet(storage, flat, f); });
  soup.solid.resize(soup.cell_begin.size() - 1);
  for_each_parallel(soup.solid.size(), [&](std::size_t c) {
    soup.solid[c] = storage.map.info(Const_dart<D>(flat.darts[soup.cell_begin[c]])).is_solid();
  });
}

}  // namespace

template <int D>
Flat_cells<D> flatten(const Map_storage<D>& storage) {
  const Map<D>& map = storage.map;
  Flat_cells<D> flat;
  sort_by_cell(storage, flat);
  if constexpr (D == 2)
    for_each_parallel(storage.cell_count, [&](std::size_t c) { turn_round(storage, flat, c); });
  write_facets(storage, flat);

  flat.soup.points.resize(storage.vertex_of_point.size());
  for_each_parallel(flat.soup.points.size(), [&](std::size_t p) {
    flat.soup.points[p] = from_cgal<D>(map.point_of_vertex_attribute(storage.vertex_of_point[p]));
  });
  std::vector<std::uint32_t> facet_of(storage.dart_of_half_facet.size(), no_facet);
  for_each_parallel(flat.darts.size(), [&](std::size_t f) {
    facet_of[map.info(Const_dart<D>(flat.darts[f])).half_facet()] = static_cast<std::uint32_t>(f);
  });
  flat.gluing.opposite.resize(flat.darts.size());
  for_each_parallel(flat.darts.size(), [&](std::size_t f) {
    const Const_dart<D> d = flat.darts[f];
    flat.gluing.opposite[f] =
        map.template is_free<D>(d) ? no_facet : facet_of[map.info(map.template beta<D>(d)).half_facet()];
  });
  return flat;
}

template Flat_cells<2> flatten(const Map_storage<2>&);
template Flat_cells<3> flatten(const Map_storage<3>&);

}  // namespace cellwalk
