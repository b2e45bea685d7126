// SPDX-License-Identifier: LGPL-3.0-or-later
// An exact check of the map that is cheap enough to run after every build; CGAL's is_valid() visits every
// orbit with marks.
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <string>

namespace cellwalk {
namespace {

/// The contribution of a range of half-facets to the counts, and the first cell with a wrong link.
struct Tally {
  std::size_t facets = 0, boundary_facets = 0, darts = 0;
  std::uint32_t bad_cell = no_facet;
};

Tally operator+(const Tally& a, const Tally& b) {
  return {a.facets + b.facets, a.boundary_facets + b.boundary_facets, a.darts + b.darts,
          std::min(a.bad_cell, b.bad_cell)};
}

template <int D>
class Checker {
 public:
  explicit Checker(const Map_storage<D>& storage) : storage_(storage), map_(storage.map) {}

  Tally check_half_facet(std::size_t slot) const {
    Tally tally;
    if (storage_.dart_of_half_facet[slot] == Dart<D>{}) return tally;
    const Const_dart<D> first = storage_.dart_of_half_facet[slot];
    const Dart_info& info = map_.info(first);
    bool good = info.half_facet() == slot && info.cell() < storage_.cell_slots;
    // Links are followed only as long as they are valid, since a damaged loop might not end.
    Const_dart<D> d = first;
    do {
      good = good && map_.info(d) == info && is_linked_well(d);
      ++tally.darts;
      if (D == 3 && good) d = map_.template beta<1>(d);
    } while (good && d != first);
    if (!good) {
      tally.bad_cell = info.cell();
      return tally;
    }
    const bool boundary = map_.template is_free<D>(first);
    tally.boundary_facets = boundary;
    tally.facets = boundary || is_lower_side(first);
    if (boundary && !info.is_impassable()) tally.bad_cell = info.cell();
    return tally;
  }

 private:
  /// True if the facet is counted with this side: that of the lower number.
  bool is_lower_side(Const_dart<D> d) const {
    return map_.info(d).half_facet() < map_.info(map_.template beta<D>(d)).half_facet();
  }

  bool start_at_one_vertex(Const_dart<D> d, Const_dart<D> e) const {
    return map_.template attribute<0>(d) == map_.template attribute<0>(e);
  }

  bool is_linked_well(Const_dart<D> d) const {
    if (map_.template is_free<1>(d) || map_.template is_free<0>(d)) return false;
    const Const_dart<D> next = map_.template beta<1>(d);
    if (map_.template beta<0>(next) != d || map_.template attribute<0>(d) == nullptr) return false;
    if (map_.info(next).cell() != map_.info(d).cell()) return false;
    if (D == 3 && !is_linked_in_cell(d, next)) return false;
    return map_.template is_free<D>(d) || is_linked_across(d, next);
  }

  /// Checks the link across the edge of d in its cell (3D).
  bool is_linked_in_cell(Const_dart<D> d, Const_dart<D> next) const {
    if (map_.template is_free<2>(d)) return false;
    const Const_dart<D> e = map_.template beta<2>(d);
    return e != d && map_.template beta<2>(e) == d && start_at_one_vertex(e, next) &&
           start_at_one_vertex(d, map_.template beta<1>(e)) && map_.info(e).cell() == map_.info(d).cell() &&
           map_.info(e).half_facet() != map_.info(d).half_facet();
  }

  /// Checks the link to the other side of the facet of d.
  bool is_linked_across(Const_dart<D> d, Const_dart<D> next) const {
    const Const_dart<D> e = map_.template beta<D>(d);
    const Dart_info &own = map_.info(d), &other = map_.info(e);
    return map_.template beta<D>(e) == d && start_at_one_vertex(e, next) &&
           (D == 2 || map_.template beta<D>(next) == map_.template beta<0>(e)) &&
           own.cell() != other.cell() && own.is_impassable() == other.is_impassable() &&
           (own.is_solid() == other.is_solid() || own.is_impassable());
  }

  const Map_storage<D>& storage_;
  const Map<D>& map_;
};

[[noreturn]] void refuse(const std::string& what) {
  throw Error(Error_code::other, "the map is damaged: " + what + "; edit it through Environment only");
}

/// Checks that every vertex belongs to its point, and that vertices have as many references as there are
/// darts.
template <int D>
void check_vertices(const Map_storage<D>& storage) {
  using Vertex = typename Map<D>::template Attribute_const_handle<0>::type;
  const Map<D>& map = storage.map;
  std::size_t references = 0, vertices = 0;
  const auto check = [&](std::uint32_t point, Vertex v) {
    if (map.template info_of_attribute<0>(v) != point || map.template dart_of_attribute<0>(v) == nullptr ||
        map.template attribute<0>(map.template dart_of_attribute<0>(v)) != v)
      refuse("point " + std::to_string(point) + " and its vertex do not refer to each other");
    references += map.template get_attribute_ref_counting<0>(v);
    ++vertices;
  };
  for (std::uint32_t p = 0; p < storage.vertex_of_point.size(); ++p)
    if (storage.vertex_of_point[p] != Map_vertex<D>{}) check(p, storage.vertex_of_point[p]);
  for (const auto& [point, vertex] : storage.pinched) check(point, vertex);
  if (vertices != map.template number_of_attributes<0>() || references != map.number_of_darts())
    refuse("there are vertices or darts that no cell knows");
}

}  // namespace

template <int D>
Map_counts check_map(const Map_storage<D>& storage) {
  const Checker<D> checker(storage);
  const tbb::blocked_range<std::size_t> all(0, storage.dart_of_half_facet.size(), 1024);
  const Tally tally = tbb::parallel_reduce(
      all, Tally{},
      [&](const auto& range, Tally sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) sum = sum + checker.check_half_facet(i);
        return sum;
      },
      [](const Tally& a, const Tally& b) { return a + b; });
  if (tally.bad_cell != no_facet)
    refuse("the links or marks of cell " + std::to_string(tally.bad_cell) + " are wrong");
  if (tally.darts != storage.map.number_of_darts()) refuse("there are darts that no half-facet knows");
  check_vertices(storage);
  return {storage.cell_count, tally.facets, tally.boundary_facets,
          storage.map.template number_of_attributes<0>(), tally.darts};
}

template Map_counts check_map(const Map_storage<2>&);
template Map_counts check_map(const Map_storage<3>&);

}  // namespace cellwalk
