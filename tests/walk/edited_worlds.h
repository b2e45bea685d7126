// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds to be edited, and edits made up for them: many that make vertices of a facet collinear.
#ifndef CELLWALK_TESTS_WALK_EDITED_WORLDS_H
#define CELLWALK_TESTS_WALK_EDITED_WORLDS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "oracle/seed.h"

namespace cellwalk::oracle {

/// Pyramids over the cells of a plane world: all have one apex above the plane, or one below. Their bases are
/// polygons whose vertices can move within the plane; walls of the plane world stand upright, and some bases
/// are walls.
inline Cell_soup<3> pyramids_over(const Cell_soup<2>& flat, Random& random) {
  Cell_soup<3> soup;
  Point<2> middle{};
  for (const Point<2>& p : flat.points) {
    soup.points.push_back({p[0], p[1], 0});
    middle = middle + 1.0 / static_cast<double>(flat.points.size()) * p;
  }
  const auto above = static_cast<std::uint32_t>(flat.points.size());
  for (const double height : {4.0, -4.0})
    soup.points.push_back({std::round(middle[0]), std::round(middle[1]), height});
  for (std::size_t c = 0; c < flat.cell_count(); ++c) {
    const bool is_wall = random.chance(0.3), has_below = random.chance(0.9);
    for (const bool is_below : {false, true}) {
      if (is_below && !has_below) continue;
      std::vector<std::uint32_t> base;
      for (std::uint32_t f = flat.cell_begin[c]; f < flat.cell_begin[c + 1]; ++f)
        base.push_back(flat.facet(f)[0]);
      // Seen from outside, counterclockwise: from above for the pyramids below.
      if (!is_below) std::reverse(base.begin(), base.end());
      soup.add_facet(base, is_wall);
      for (std::uint32_t f = flat.cell_begin[c]; f < flat.cell_begin[c + 1]; ++f) {
        const std::uint32_t u = flat.facet(f)[0], v = flat.facet(f)[1];
        const std::uint32_t apex = above + is_below;
        soup.add_facet(
            is_below ? std::vector<std::uint32_t>{v, u, apex} : std::vector<std::uint32_t>{u, v, apex},
            flat.impassable[f]);
      }
      soup.end_cell(flat.solid[c]);
    }
  }
  return soup;
}

/// World number i. Integer lattices, so that all that lies on a line does so exactly.
template <int D>
Cell_soup<D> editable_world(std::uint64_t i) {
  const std::uint64_t seed = oracle::reseeded(i);
  Random random(seed);
  if (D == 3 && i % 3 == 0) {
    auto options = mixed_lattice_world<D>(seed);
    options.cells.fill(2);
    const Cell_soup<D> soup = lattice_world(options);
    if (soup.cell_count() > 0) return soup;
    options.removed_share = 0;  // all cells were left out
    return lattice_world(options);
  }
  auto flat = mixed_lattice_world<2>(seed);
  flat.cells.fill(D == 2 ? 5 : 3);
  flat.star_share = i % 2 ? 0 : 0.2;
  flat.membrane_share = 0.2;
  if constexpr (D == 2)
    return lattice_world(flat);
  else
    return pyramids_over(lattice_world(flat), random);
}

/// A new place for a vertex: in the plane of a facet that has it (2D: anywhere), where weights of two other
/// vertices there are multiples of 1/8; half of the time on the line through these two, and often they are
/// its neighbours, and it the second of the facet's loop. On a lattice of 1/64.
template <int D>
Point<D> new_place(const Snapshot<D>& snapshot, std::uint32_t& point, Random& random) {
  const Cell c = snapshot.cell(random.below(snapshot.cell_count()));
  std::vector<std::uint32_t> loop(snapshot.view(c).vertices.begin(), snapshot.view(c).vertices.end());
  if (D == 3) {
    // Of a few facets the one with most vertices.
    for (int tries = 0; tries < 6; ++tries) {
      const auto other = snapshot.loop(snapshot.half_facet(c, random.below(snapshot.facet_count(c))));
      if (tries == 0 || other.size() > loop.size()) loop = other;
    }
  }
  const std::size_t n = loop.size(), at = random.chance(0.5) ? 1 : random.below(n);
  const bool by_neighbours = random.chance(0.5);
  const std::size_t next = (at + (by_neighbours ? 1 : 1 + random.below(n - 1))) % n;
  const std::size_t previous = (at + (by_neighbours ? n - 1 : 1 + random.below(n - 1))) % n;
  point = loop[at];
  const Point<D>&x = snapshot.point(point), &a = snapshot.point(loop[next]),
        &b = snapshot.point(loop[previous]);
  const double i = random.chance(0.5) ? 4 : static_cast<double>(random.below(13)) - 2;
  const double j = random.chance(0.5) ? 8 - i : static_cast<double>(random.below(9)) - 4;
  Point<D> target = x + (i / 8) * (a - x) + (j / 8) * (b - x);
  for (double& t : target) t = std::round(64 * t) / 64;
  return target;
}

/// A point strictly inside a cell, on a lattice of 1/64 if there is one near its middle.
template <int D>
Point<D> middle_of(const Snapshot<D>& snapshot, Cell c) {
  const Cell_view<D> cell = snapshot.view(c);
  Point<D> sum{};
  for (std::size_t i = 0; i < cell.vertex_count(); ++i) sum = sum + cell.point(i);
  Point<D> middle = 1.0 / static_cast<double>(cell.vertex_count()) * sum;
  for (double& t : middle) t = std::round(64 * t) / 64;
  return middle;
}

/// Loops that start otherwise than they did (their half-facets by slot).
template <int D>
std::vector<std::uint32_t> first_vertices(const Snapshot<D>& snapshot) {
  std::vector<std::uint32_t> first(snapshot.half_facet_slots());
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = snapshot.half_facet(snapshot.cell(i), k);
      first[to_index(f)] = snapshot.loop(f)[0];
    }
  return first;
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_WALK_EDITED_WORLDS_H
