// SPDX-License-Identifier: LGPL-3.0-or-later
// Darts are created in the order of the soup, those of a half-facet consecutively; then cells and facets are
// linked in parallel: every link writes only into the darts that it joins.
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "environment/soup/corner_orbits.h"
#include "environment/soup/parallel.h"

namespace cellwalk {
namespace {

/// \throw Error(not_certified) for the first 2D cell whose edges do not form a chain
void check_chains(const Cell_soup<2>& soup) {
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    for (std::uint32_t f = soup.cell_begin[c], end = soup.cell_begin[c + 1]; f < end; ++f) {
      const std::uint32_t next = f + 1 == end ? soup.cell_begin[c] : f + 1;
      if (soup.facet(f)[1] != soup.facet(next)[0])
        throw Error(Error_code::not_certified, "cell " + std::to_string(c) + " is not closed: edge " +
                                                   std::to_string(f - soup.cell_begin[c]) +
                                                   " does not end where the next one starts");
    }
}

/// Links the facets of cells across their edges (beta_2 in 3D).
class Cell_linker {
 public:
  Cell_linker(Map_storage<3>& storage, const Cell_soup<3>& soup) : storage_(storage), soup_(soup) {}

  /// Returns false if the cell is not closed.
  bool link(std::size_t c) {
    edges_.clear();
    for (std::uint32_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) {
      const auto loop = soup_.facet(f);
      Dart<3> d = storage_.dart_of_half_facet[f];
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t u = loop[i], v = loop[i + 1 == loop.size() ? 0 : i + 1];
        edges_.push_back({std::min(u, v), std::max(u, v), u < v, d});
        d = storage_.map.beta<1>(d);
      }
    }
    const auto key = [](const Edge& e) { return std::make_tuple(e.low, e.high, e.ascending); };
    std::sort(edges_.begin(), edges_.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    if (edges_.size() % 2) return false;
    for (std::size_t i = 0; i < edges_.size(); i += 2) {
      const Edge &a = edges_[i], &b = edges_[i + 1];
      const bool is_pair = a.low == b.low && a.high == b.high && a.ascending != b.ascending;
      const bool is_repeated = i > 0 && edges_[i - 1].low == a.low && edges_[i - 1].high == a.high;
      if (!is_pair || is_repeated) return false;
      storage_.map.basic_link_beta_for_involution<2>(a.dart, b.dart);
    }
    return true;
  }

 private:
  struct Edge {
    std::uint32_t low, high;
    bool ascending;
    Dart<3> dart;
  };
  Map_storage<3>& storage_;
  const Cell_soup<3>& soup_;
  std::vector<Edge> edges_;
};

/// \throw Error(not_certified) for the first cell that is not closed
void link_cells(Map_storage<3>& storage, const Cell_soup<3>& soup) {
  std::atomic<std::size_t> first_open{soup.cell_count()};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, soup.cell_count(), 1024), [&](const auto& range) {
    Cell_linker linker(storage, soup);
    for (std::size_t c = range.begin(); c != range.end(); ++c) {
      if (linker.link(c)) continue;
      std::size_t known = first_open;
      while (c < known && !first_open.compare_exchange_weak(known, c)) {
      }
      return;
    }
  });
  if (first_open < soup.cell_count())
    throw Error(Error_code::not_certified,
                "cell " + std::to_string(first_open) +
                    " is not closed: some edge does not lie in exactly two facets");
}

/// Joins the two sides of a facet (beta_D).
void link_facets(Map_storage<2>& storage, const Cell_soup<2>&, std::size_t f, std::uint32_t g) {
  storage.map.basic_link_beta_for_involution<2>(storage.dart_of_half_facet[f], storage.dart_of_half_facet[g]);
}

void link_facets(Map_storage<3>& storage, const Cell_soup<3>& soup, std::size_t f, std::uint32_t g) {
  Map<3>& map = storage.map;
  const auto a = soup.facet(f), b = soup.facet(g);
  Dart<3> d = storage.dart_of_half_facet[f], e = storage.dart_of_half_facet[g];
  for (std::size_t j = 0; b[j] != a[1]; ++j) e = map.beta<1>(e);
  for (std::size_t i = 0; i < a.size(); ++i) {
    map.basic_link_beta_for_involution<3>(d, e);
    d = map.beta<1>(d);
    e = map.beta<0>(e);
  }
}

/// The cell of each half-facet.
template <int D>
std::vector<std::uint32_t> cells_of_facets(const Cell_soup<D>& soup) {
  std::vector<std::uint32_t> cell_of(soup.facet_count());
  for_each_parallel(soup.cell_count(), [&](std::size_t c) {
    std::fill(cell_of.begin() + soup.cell_begin[c], cell_of.begin() + soup.cell_begin[c + 1],
              static_cast<std::uint32_t>(c));
  });
  return cell_of;
}

/// The marks of each half-facet: impassable if either side is marked, on the boundary, and between a solid
/// and a free cell.
template <int D>
std::vector<Dart_info> make_infos(const Cell_soup<D>& soup, const Gluing& gluing) {
  const std::vector<std::uint32_t> cell_of = cells_of_facets(soup);
  std::vector<Dart_info> infos(soup.facet_count());
  for_each_parallel(soup.facet_count(), [&](std::size_t f) {
    const std::uint32_t g = gluing.opposite[f];
    const bool solid = soup.solid[cell_of[f]];
    const bool wall =
        g == no_facet || soup.impassable[f] || soup.impassable[g] || solid != bool(soup.solid[cell_of[g]]);
    infos[f] = Dart_info(cell_of[f], static_cast<std::uint32_t>(f), wall, solid);
  });
  return infos;
}

/// The vertices of the map, one for each orbit of darts, and their lookup by dart while darts are created.
template <int D>
class Vertices {
 public:
  Vertices(Map_storage<D>& storage, const Cell_soup<D>& soup, std::vector<std::uint32_t> orbit)
      : storage_(storage), darts_{soup}, orbit_(std::move(orbit)) {
    std::vector<std::uint32_t> first_orbit(soup.points.size(), no_facet);
    storage.vertex_of_point.assign(soup.points.size(), Map_vertex<D>{});
    for (std::uint32_t d = 0; d < orbit_.size(); ++d) {
      if (orbit_[d] != d) continue;
      const std::uint32_t p = darts_.origin(d);
      const Map_vertex<D> vertex = storage.map.create_vertex_attribute(to_map_point(soup.points[p]), p);
      if (first_orbit[p] == no_facet) {
        first_orbit[p] = d;
        storage.vertex_of_point[p] = vertex;
      } else {
        storage.pinched.emplace_back(p, vertex);
        pinched_orbits_.emplace_back(d, vertex);
      }
    }
    std::stable_sort(storage.pinched.begin(), storage.pinched.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  /// The vertex from which dart d of the soup starts.
  Map_vertex<D> of(std::uint32_t d) const {
    // Nearly all maps have no pinched vertex, and need no lookup in the table of orbits.
    if (!pinched_orbits_.empty()) {
      const auto before = [](const auto& entry, std::uint32_t orbit) { return entry.first < orbit; };
      const auto it = std::lower_bound(pinched_orbits_.begin(), pinched_orbits_.end(), orbit_[d], before);
      if (it != pinched_orbits_.end() && it->first == orbit_[d]) return it->second;
    }
    return storage_.vertex_of_point[darts_.origin(d)];
  }

 private:
  Map_storage<D>& storage_;
  Soup_darts<D> darts_;
  std::vector<std::uint32_t> orbit_;
  std::vector<std::pair<std::uint32_t, Map_vertex<D>>> pinched_orbits_;  // sorted by orbit
};

/// Creates the darts of all cells, linked around their facets (2D: around their cells), with marks and
/// vertices.
template <int D>
void create_darts(Map_storage<D>& storage, const Cell_soup<D>& soup, const Gluing& gluing) {
  Map<D>& map = storage.map;
  const Soup_darts<D> darts{soup};
  std::vector<std::uint32_t> orbit;
  std::vector<Dart_info> infos;
  // Reserving memory touches every page of the map for the first time, which takes as long as the rest.
  tbb::parallel_invoke([&] { map.darts().reserve(darts.count()); },
                       [&] {
                         infos = make_infos(soup, gluing);
                         orbit = vertex_orbits(soup, gluing);
                       });
  const Vertices<D> vertices(storage, soup, std::move(orbit));
  storage.dart_of_half_facet.resize(soup.facet_count());
  // Links the darts [begin, end) into a loop; facet_of(d) is the half-facet of dart d.
  const auto create_loop = [&](std::uint32_t begin, std::uint32_t end, const auto& facet_of) {
    Dart<D> first{}, last{};
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t f = facet_of(i);
      const Dart<D> d = map.create_dart();
      map.info(d) = infos[f];
      map.template set_dart_attribute<0>(d, vertices.of(i));
      if (i == darts.first(f)) storage.dart_of_half_facet[f] = d;
      if (i == begin)
        first = d;
      else
        map.basic_link_beta_1(last, d);
      last = d;
    }
    if (begin != end) map.basic_link_beta_1(last, first);
  };
  if constexpr (D == 2) {
    for (std::size_t c = 0; c < soup.cell_count(); ++c)
      create_loop(soup.cell_begin[c], soup.cell_begin[c + 1], [](std::uint32_t d) { return d; });
  } else {
    for (std::uint32_t f = 0; f < soup.facet_count(); ++f)
      create_loop(soup.facet_begin[f], soup.facet_begin[f + 1], [f](std::uint32_t) { return f; });
  }
}

}  // namespace

template <int D>
std::vector<Map_vertex<D>> Map_storage<D>::vertices_of(std::uint32_t point) const {
  if (vertex_of_point[point] == Map_vertex<D>{}) return {};
  std::vector<Map_vertex<D>> result{vertex_of_point[point]};
  auto it = std::lower_bound(pinched.begin(), pinched.end(), point,
                             [](const auto& entry, std::uint32_t p) { return entry.first < p; });
  for (; it != pinched.end() && it->first == point; ++it) result.push_back(it->second);
  return result;
}

template <int D>
std::unique_ptr<Map_storage<D>> build_map(const Cell_soup<D>& soup, const Gluing& gluing) {
  if (soup.facet_count() >= Dart_info::most_half_facets)
    throw Error(Error_code::input, "more than 2^29 facets of cells: split the environment");
  if constexpr (D == 2) check_chains(soup);
  auto storage = std::make_unique<Map_storage<D>>();
  storage->cell_count = storage->cell_slots = soup.cell_count();
  create_darts(*storage, soup, gluing);
  if constexpr (D == 3) link_cells(*storage, soup);
  for_each_parallel(soup.facet_count(), [&](std::size_t f) {
    const std::uint32_t g = gluing.opposite[f];
    if (g != no_facet && f < g) link_facets(*storage, soup, f, g);
  });
  return storage;
}

template <int D>
void assign_half_facets(Map_storage<D>& storage, std::span<const Dart<D>> darts,
                        std::span<const Half_facet> half_facets, std::size_t slots) {
  if (slots >= Dart_info::most_half_facets)
    throw Error(Error_code::input, "more than 2^29 slots of half-facets: split the environment");
  std::vector<Dart<D>> dart_of_half_facet(slots, Dart<D>{});
  for_each_parallel(darts.size(), [&](std::size_t i) {
    const std::uint32_t number = to_index(half_facets[i]);
    dart_of_half_facet[number] = darts[i];
    for_each_dart_of_half_facet<D>(storage.map, darts[i],
                                   [&](Dart<D> d) { storage.map.info(d).set_half_facet(number); });
  });
  storage.dart_of_half_facet = std::move(dart_of_half_facet);
}

template struct Map_storage<2>;
template struct Map_storage<3>;
template std::unique_ptr<Map_storage<2>> build_map(const Cell_soup<2>&, const Gluing&);
template std::unique_ptr<Map_storage<3>> build_map(const Cell_soup<3>&, const Gluing&);
template void assign_half_facets<2>(Map_storage<2>&, std::span<const Dart<2>>, std::span<const Half_facet>,
                                    std::size_t);
template void assign_half_facets<3>(Map_storage<3>&, std::span<const Dart<3>>, std::span<const Half_facet>,
                                    std::size_t);

}  // namespace cellwalk
