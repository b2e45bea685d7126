// SPDX-License-Identifier: LGPL-3.0-or-later
// Snapshots made wrong on purpose, to see that oracles notice.
#ifndef CELLWALK_TESTS_EDGE_WRONG_CONVEX_PAIRS_H
#define CELLWALK_TESTS_EDGE_WRONG_CONVEX_PAIRS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/policies.h>

#include <algorithm>
#include <vector>

namespace cellwalk {

template <int>
class Snapshot_compiler;

/// Compilers may write into snapshots. There is none for this dimension, so that tests can have the name.
template <>
class Snapshot_compiler<-1> {
 public:
  template <int D>
  static void set_convex_pair(Snapshot<D>& snapshot, Half_facet f) {
    snapshot.links_[to_index(f)] |= Snapshot<D>::convex_pair_bit;
  }
};

namespace test {

/// Marks pairs of cells as convex whose union is, whatever walls lie between them in the plane of a facet
/// that they share. Returns how many were not so marked.
template <int D>
int forget_slits(Snapshot<D>& snapshot) {
  Predicate_counts counts;
  const auto side = [&](const std::vector<std::uint32_t>& loop, std::uint32_t v) {
    const auto x = [&](std::size_t i) { return snapshot.point(loop[i]); };
    if constexpr (D == 2) {
      return -Exact::orientation(counts, x(0), x(1), snapshot.point(v));
    } else {
      for (std::size_t i = 2; i < loop.size(); ++i)
        for (std::size_t j = 1; j < i; ++j)
          if (const int s = Exact::orientation(counts, x(0), x(j), x(i), snapshot.point(v)); s != 0) return s;
      return 0;
    }
  };
  const auto vertices = [&](Cell c) {
    const auto view = snapshot.view(c);
    return std::vector<std::uint32_t>(view.vertices.begin(), view.vertices.end());
  };
  // No vertex of the one lies outside a facet of the other, but for facets in their common plane.
  const auto bounds = [&](Cell c, Cell other, const std::vector<std::uint32_t>& common) {
    const auto outer = vertices(other);
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
      const auto loop = snapshot.loop(Snapshot<D>::half_facet(c, f));
      if (std::all_of(loop.begin(), loop.end(), [&](std::uint32_t v) { return side(common, v) == 0; }))
        continue;
      if (std::any_of(outer.begin(), outer.end(), [&](std::uint32_t v) { return side(loop, v) > 0; }))
        return false;
    }
    return true;
  };
  int wrong = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t f = 0; f < snapshot.facet_count(snapshot.cell(i)); ++f) {
      const Half_facet path = Snapshot<D>::half_facet(snapshot.cell(i), f);
      if (snapshot.is_impassable(path) || snapshot.is_convex_pair(path)) continue;
      const Cell a = snapshot.cell(i), b = snapshot.neighbour(path);
      const auto plane = snapshot.loop(path);
      if (!bounds(a, b, plane) || !bounds(b, a, plane)) continue;
      Snapshot_compiler<-1>::set_convex_pair(snapshot, path);
      ++wrong;
    }
  return wrong;
}

}  // namespace test
}  // namespace cellwalk

#endif  // CELLWALK_TESTS_EDGE_WRONG_CONVEX_PAIRS_H
