// SPDX-License-Identifier: LGPL-3.0-or-later
// Snapshots compared cell by cell through their public interface, and their planes against exact signs.
#ifndef CELLWALK_TESTS_ENVIRONMENT_SNAPSHOT_CHECKS_H
#define CELLWALK_TESTS_ENVIRONMENT_SNAPSHOT_CHECKS_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/policies.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

namespace cellwalk::test {

/// A facet as seen from its cell, free of anything that depends on the order in which a snapshot was made.
struct Facet_facts {
  std::vector<std::uint32_t> loop;  ///< rotated to start at the lowest point
  std::uint32_t neighbour;          ///< input index, or no_facet
  bool impassable;

  auto operator<=>(const Facet_facts&) const = default;
};

struct Cell_facts {
  bool solid = false;
  std::set<std::uint32_t> vertices;
  std::vector<Facet_facts> facets;  ///< sorted

  bool operator==(const Cell_facts&) const = default;
};

template <int D>
struct Snapshot_facts {
  std::vector<Point<D>> points;
  std::vector<Cell_facts> cells;  ///< by input index

  bool operator==(const Snapshot_facts&) const = default;
};

template <int D>
Snapshot_facts<D> facts(const Snapshot<D>& snapshot) {
  Snapshot_facts<D> result;
  result.points.assign(snapshot.points().begin(), snapshot.points().end());
  for (std::uint32_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    EXPECT_EQ(snapshot.index(c), i);
    Cell_facts cell;
    cell.solid = snapshot.is_solid(c);
    cell.vertices = {snapshot.view(c).vertices.begin(), snapshot.view(c).vertices.end()};
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = snapshot.half_facet(c, k);
      EXPECT_EQ(snapshot.cell_of(f), c);
      EXPECT_EQ(snapshot.facet_of(f), k);
      std::vector<std::uint32_t> loop = snapshot.loop(f);
      if (D == 3) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      const Cell neighbour = snapshot.neighbour(f);
      if (neighbour != Cell::none) {
        EXPECT_EQ(snapshot.opposite(snapshot.opposite(f)), f);
      }
      cell.facets.push_back(
          {loop, neighbour == Cell::none ? no_facet : snapshot.index(neighbour), snapshot.is_impassable(f)});
    }
    std::sort(cell.facets.begin(), cell.facets.end());
    result.cells.push_back(cell);
  }
  return result;
}

template <int D>
Point<D> mean_of_vertices(const Cell_view<D>& cell) {
  Point<D> sum{};
  for (std::size_t i = 0; i < cell.vertex_count(); ++i) sum = sum + cell.point(i);
  return 1.0 / static_cast<double>(cell.vertex_count()) * sum;
}

inline int exact_side(const Cell_view<2>& cell, std::size_t facet, const Point<2>& p) {
  Predicate_counts counts;
  const auto loop = cell.loop(facet);
  return -Lazy::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), p);
}

inline int exact_side(const Cell_view<3>& cell, std::size_t facet, const Point<3>& p) {
  Predicate_counts counts;
  const auto loop = cell.loop(facet);
  return Lazy::orientation(counts, cell.point(loop[0]), cell.point(loop[1]), cell.point(loop[2]), p);
}

/// Where a plane is certain of a sign, it is the exact one. Returns the share of signs that were certain.
template <int D>
double expect_planes_hold(const Snapshot<D>& snapshot, std::uint64_t seed) {
  Random random(seed);
  std::size_t asked = 0, certain = 0;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    const Cell_view<D> cell = snapshot.view(c);
    const Point<D>& p = snapshot.point(static_cast<std::uint32_t>(random.below(snapshot.points().size())));
    std::array<float, static_cast<std::size_t>(D)> y;
    if (!snapshot.frame().map(p, y)) continue;
    for (std::size_t k = 0; k < cell.facet_count(); ++k) {
      const float value = evaluate<D>(snapshot.blocks(c)[k / 4], y)[k % 4];
      ++asked;
      if (std::abs(value) <= plane_error) continue;
      ++certain;
      EXPECT_EQ(exact_side(cell, k, p), value > 0 ? 1 : -1) << "cell " << i << " facet " << k;
    }
  }
  return asked ? static_cast<double>(certain) / static_cast<double>(asked) : 1;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_SNAPSHOT_CHECKS_H
