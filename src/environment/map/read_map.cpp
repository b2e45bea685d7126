// SPDX-License-Identifier: LGPL-3.0-or-later
// Vertices are told from new ones by their handles, cells by the loops of their facets.
#include "read_map.h"

#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "environment/soup/describe_place.h"
#include "map_matches_snapshot.h"

namespace cellwalk {
namespace {

/// A mark of a map that no dart has, until the scope ends.
template <int D>
class Scoped_mark {
 public:
  explicit Scoped_mark(Map<D>& map) : map_(map), mark_(map.get_new_mark()) {}
  ~Scoped_mark() { map_.free_mark(mark_); }
  Scoped_mark(const Scoped_mark&) = delete;
  Scoped_mark& operator=(const Scoped_mark&) = delete;

  bool has(Dart<D> d) const { return map_.is_marked(d, mark_); }
  void enter(Dart<D> d) { map_.mark(d, mark_); }

 private:
  Map<D>& map_;
  typename Map<D>::size_type mark_;
};

template <int D>
class Map_reader {
 public:
  Map_reader(Map_storage<D>& storage, const Snapshot<D>& snapshot)
      : storage_(storage), map_(storage.map), snapshot_(snapshot) {}

  Read_map<D> read() {
    for (auto it = map_.darts().begin(); it != map_.darts().end(); ++it) check_links(it);
    read_points();
    read_cells();
    std::stable_sort(cells_.begin(), cells_.end(),
                     [](const Read_cell& a, const Read_cell& b) { return a.index < b.index; });
    for (const Read_cell& cell : cells_) write(cell);
    glue();
    drop_points();
    return std::move(result_);
  }

 private:
  using Result = Read_map<D>;
  struct Read_cell {
    std::uint32_t index;  ///< of the snapshot, or none
    std::vector<Dart<D>> facets;
    std::vector<Half_facet> before;
  };

  Point<D> place_of(Dart<D> d) const {
    Point<D> place{};
    if (map_.template attribute<0>(d) == nullptr) return place;
    for (int i = 0; i < D; ++i) place[static_cast<std::size_t>(i)] = map_.point(d)[i];
    return place;
  }

  [[noreturn]] void refuse(Dart<D> d, const std::string& what) const {
    throw Error(Error_code::not_certified,
                "the edited map has " + what + " at " + detail::describe_place(place_of(d)));
  }

  void check_links(Dart<D> d) const {
    if (map_.template attribute<0>(d) == nullptr) refuse(d, "a dart without a vertex");
    if (map_.template is_free<1>(d) || map_.template is_free<0>(d))
      refuse(d, D == 2 ? "a cell that is not closed" : "a facet that is not closed");
    if (D == 3 && map_.template is_free<2>(d)) refuse(d, "a cell that is not closed");
  }

  bool is_vertex_of(Map_vertex<D> vertex, std::uint32_t point) const {
    if (point >= storage_.vertex_of_point.size()) return false;
    const auto vertices = storage_.vertices_of(point);
    return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
  }

  /// Numbers the points: those of the snapshot as there, others after them.
  void read_points() {
    auto& points = result_.soup.points;
    points.assign(snapshot_.points().begin(), snapshot_.points().end());
    const std::size_t old_count = points.size();
    std::vector<char> is_placed(old_count, 0);
    std::vector<Map_vertex<D>> others;
    const auto point_of = [&](Map_vertex<D> vertex) {
      Point<D> x;
      for (int i = 0; i < D; ++i) x[static_cast<std::size_t>(i)] = map_.point_of_vertex_attribute(vertex)[i];
      detail::check_finite(x, "a vertex of the edited map");
      return x;
    };
    // A vertex may share its point with others that touch it there; where one of them moved away, with none.
    const auto enter = [&](Map_vertex<D> vertex, std::uint32_t point) {
      const Point<D> x = point_of(vertex);
      if (is_placed[point] && points[point] != x) return false;
      is_placed[point] = 1;
      points[point] = x;
      result_.vertices.emplace_back(vertex, point);
      return true;
    };
    auto& attributes = map_.template attributes<0>();
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
      const std::uint32_t point = map_.template info_of_attribute<0>(it);
      if (!is_vertex_of(it, point) || !enter(it, point)) others.push_back(it);
    }
    // Where CGAL splits a vertex, both have its information.
    for (const Map_vertex<D> vertex : others) {
      const std::uint32_t known = map_.template info_of_attribute<0>(vertex);
      if (known < old_count && is_placed[known] && enter(vertex, known)) continue;
      const auto added = static_cast<std::uint32_t>(points.size());
      points.push_back(point_of(vertex));
      map_.template info_of_attribute<0>(vertex) = added;
      result_.vertices.emplace_back(vertex, added);
    }
  }

  void read_cells() {
    Scoped_mark<D> seen(map_);
    std::vector<char> is_claimed(snapshot_.cell_slots(), 0);
    for (auto it = map_.darts().begin(); it != map_.darts().end(); ++it) {
      if (seen.has(it)) continue;
      Read_cell cell{Result::none, {}, {}};
      // The first dart of each facet, and those across its edges (2D: and the next one).
      std::vector<Dart<D>> reached{it};
      while (!reached.empty()) {
        const Dart<D> first = reached.back();
        reached.pop_back();
        if (seen.has(first)) continue;
        cell.facets.push_back(first);
        for_each_dart_of_half_facet<D>(map_, first, [&](Dart<D> d) {
          seen.enter(d);
          reached.push_back(map_.template beta < D == 2 ? 1 : 2 > (d));
        });
      }
      find_before(cell, is_claimed);
      cells_.push_back(std::move(cell));
    }
  }

  /// Finds the cell of the snapshot that has the same facets.
  void find_before(Read_cell& cell, std::vector<char>& is_claimed) const {
    Cell same = Cell::none;
    for (const Dart<D> first : cell.facets) {
      const Half_facet f = half_facet_before(first);
      if (f == Half_facet::none || (same != Cell::none && snapshot_.cell_of(f) != same)) break;
      same = snapshot_.cell_of(f);
      cell.before.push_back(f);
    }
    const std::uint32_t index = same == Cell::none ? Result::none : snapshot_.index(same);
    if (cell.before.size() == cell.facets.size() && cell.facets.size() == snapshot_.facet_count(same) &&
        !is_claimed[index]) {
      is_claimed[index] = 1;
      cell.index = index;
    } else {
      cell.before.assign(cell.facets.size(), Half_facet::none);
    }
  }

  /// The half-facet of the snapshot with the loop of that of a dart, if a dart of it names it.
  Half_facet half_facet_before(Dart<D> first) const {
    Half_facet found = Half_facet::none;
    for_each_dart_of_half_facet<D>(map_, first, [&](Dart<D> d) {
      const std::uint32_t number = map_.info(d).half_facet();
      if (found != Half_facet::none || number >= storage_.dart_of_half_facet.size() ||
          storage_.dart_of_half_facet[number] == Dart<D>{})
        return;
      if (has_loop_of(storage_, snapshot_, first, Half_facet{number})) found = Half_facet{number};
    });
    return found;
  }

  void write(const Read_cell& cell) {
    Cell_soup<D>& soup = result_.soup;
    bool is_solid = false;
    std::vector<std::uint32_t> loop;
    for (std::size_t i = 0; i < cell.facets.size(); ++i) {
      const Dart<D> first = cell.facets[i];
      bool is_wall = false;
      loop.clear();
      for_each_dart_of_half_facet<D>(map_, first, [&](Dart<D> d) {
        loop.push_back(storage_.point_of(d));
        is_wall |= map_.info(d).is_impassable();
        is_solid |= map_.info(d).is_solid();
      });
      if (D == 2) loop.push_back(storage_.point_of(map_.template beta<1>(first)));
      const auto number = static_cast<std::uint32_t>(result_.darts.size());
      if (number + 1 >= Dart_info::most_half_facets)
        throw Error(Error_code::input, "more than 2^29 facets of cells: split the environment");
      soup.add_facet(loop, is_wall);
      result_.darts.push_back(first);
      result_.before.push_back(cell.before[i]);
      numbers_.emplace_back(first, number);
    }
    soup.end_cell(is_solid);
  }

  /// The other side of each facet, once all are written.
  void glue() {
    for (const auto& [first, number] : numbers_)
      for_each_dart_of_half_facet<D>(map_, first,
                                     [&, n = number](Dart<D> d) { map_.info(d).set_half_facet(n); });
    for (const Dart<D> d : result_.darts)
      result_.gluing.opposite.push_back(
          map_.template is_free<D>(d) ? no_facet : map_.info(map_.template beta<D>(d)).half_facet());
  }

  /// Points without cells are left out; the others keep their order.
  void drop_points() {
    Cell_soup<D>& soup = result_.soup;
    std::vector<std::uint32_t> renamed(soup.points.size(), Result::none);
    for (const std::uint32_t p : soup.vertices) renamed[p] = 0;
    std::vector<Point<D>> points;
    for (std::size_t p = 0; p < renamed.size(); ++p) {
      if (renamed[p] == Result::none) continue;
      renamed[p] = static_cast<std::uint32_t>(points.size());
      points.push_back(soup.points[p]);
    }
    soup.points = std::move(points);
    for (std::uint32_t& p : soup.vertices) p = renamed[p];
    for (auto& [vertex, point] : result_.vertices) point = renamed[point];
    // Vertices without darts go, too.
    std::erase_if(result_.vertices, [&](const auto& vertex) {
      if (vertex.second != Result::none) return false;
      map_.template erase_attribute<0>(vertex.first);
      return true;
    });
    renamed.resize(snapshot_.points().size());
    result_.points = std::move(renamed);
  }

  Map_storage<D>& storage_;
  Map<D>& map_;
  const Snapshot<D>& snapshot_;
  std::vector<Read_cell> cells_;
  std::vector<std::pair<Dart<D>, std::uint32_t>> numbers_;  ///< of half-facets, by a dart
  Result result_;
};

}  // namespace

template <int D>
Read_map<D> read_map(Map_storage<D>& storage, const Snapshot<D>& snapshot) {
  return Map_reader<D>(storage, snapshot).read();
}

template Read_map<2> read_map(Map_storage<2>&, const Snapshot<2>&);
template Read_map<3> read_map(Map_storage<3>&, const Snapshot<3>&);

}  // namespace cellwalk
