// SPDX-License-Identifier: LGPL-3.0-or-later
// A certificate that is wrong on purpose, to see that oracles notice.
#ifndef CELLWALK_TESTS_EDGE_FORGOTTEN_SLITS_H
#define CELLWALK_TESTS_EDGE_FORGOTTEN_SLITS_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <vector>

namespace cellwalk::test {

/// True if the union of the two cells of a facet is convex, whatever walls lie between them in its plane.
template <int D>
bool is_union_convex(const Snapshot<D>& snapshot, Half_facet f) {
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
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const auto loop = snapshot.loop(Snapshot<D>::half_facet(c, i));
      if (std::all_of(loop.begin(), loop.end(), [&](std::uint32_t v) { return side(common, v) == 0; }))
        continue;
      if (std::any_of(outer.begin(), outer.end(), [&](std::uint32_t v) { return side(loop, v) > 0; }))
        return false;
    }
    return true;
  };
  const Cell a = snapshot.cell_of(f), b = snapshot.neighbour(f);
  const auto plane = snapshot.loop(f);
  return bounds(a, b, plane) && bounds(b, a, plane);
}

/// True if the ends of an edge with a chain seem to prove that it passes it: they lie in two cells, one
/// beyond a facet of the other, whose union is convex. So the edge stays in these, but it may pass slits,
/// which part them in the plane of that facet.
template <int D>
bool passes_but_for_slits(const Snapshot<D>& snapshot, const Chain& chain) {
  return chain.size() == 1 && is_union_convex(snapshot, chain.front());
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FORGOTTEN_SLITS_H
