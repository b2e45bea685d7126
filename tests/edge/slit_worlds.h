// SPDX-License-Identifier: LGPL-3.0-or-later
// Slits: facets whose sides are cut into polygons in different ways, so that they are walls of one side each
// that coincide without being glued.
#ifndef CELLWALK_TESTS_EDGE_SLIT_WORLDS_H
#define CELLWALK_TESTS_EDGE_SLIT_WORLDS_H

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "edge/rational_face.h"
#include "oracle/exact_world.h"
#include "oracle/squares_and_cubes.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::test {

/// How a side of a facet becomes polygons.
enum class Cut { none, diagonal, fan };

class Slit_maker {
 public:
  explicit Slit_maker(const Cell_soup<3>& soup) : soup_(soup), cuts_(soup.facet_count(), Cut::none) {
    result_.points = soup.points;
  }

  /// Makes the facet with these two half-facets a slit; false if its points do not allow it exactly.
  bool part(std::size_t f, std::size_t g, Cut of_f, Cut of_g) {
    if (!can(f, of_f) || !can(g, of_g) || of_f == of_g) return false;
    cuts_[f] = of_f;
    cuts_[g] = of_g;
    return true;
  }

  Cell_soup<3> soup() {
    for (std::size_t c = 0; c < soup_.cell_count(); ++c) {
      for (std::size_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) add(f);
      result_.end_cell(soup_.solid[c] != 0);
    }
    return result_;
  }

 private:
  const Point<3>& point(std::size_t f, std::size_t k) const {
    return soup_.points[soup_.facet(f)[k % soup_.facet(f).size()]];
  }

  /// The middle of the vertices of a triangle or quadrangle, with weights that keep small coordinates exact.
  Point<3> middle(std::size_t f) const {
    const std::size_t n = soup_.facet(f).size();
    Point<3> sum = point(f, 0) + point(f, 1) + point(f, 2) + point(f, n == 3 ? 0 : 3);
    for (double& x : sum) x /= 4;
    return sum;
  }

  bool can(std::size_t f, Cut cut) const {
    const std::size_t n = soup_.facet(f).size();
    if (cut == Cut::none) return true;
    if (n > 4) return false;
    for (std::size_t k = 0; k < n; ++k)
      if (are_collinear(point(f, k), point(f, k + 1), point(f, k + 2))) return false;
    if (cut == Cut::diagonal) return n == 4;
    return orientation_of(point(f, 0), point(f, 1), point(f, 2), middle(f)) == 0;
  }

  void add(std::size_t f) {
    const auto loop = soup_.facet(f);
    const bool wall = soup_.impassable[f] != 0;
    if (cuts_[f] == Cut::diagonal) {
      result_.add_facet({loop[0], loop[1], loop[2]}, wall);
      result_.add_facet({loop[0], loop[2], loop[3]}, wall);
    } else if (cuts_[f] == Cut::fan) {
      const auto apex = static_cast<std::uint32_t>(result_.points.size());
      result_.points.push_back(middle(f));
      for (std::size_t k = 0; k < loop.size(); ++k)
        result_.add_facet({loop[k], loop[(k + 1) % loop.size()], apex}, wall);
    } else {
      result_.add_facet(loop, wall);
    }
  }

  const Cell_soup<3>& soup_;
  std::vector<Cut> cuts_;
  Cell_soup<3> result_;
};

/// A world in which inner walls, as far as their points allow, and some other facets are slits. `slits`
/// counts them.
inline oracle::World<3> with_slits(oracle::World<3> world, std::uint64_t seed, int& slits) {
  world.name += ", with slits";
  Random random(seed);
  Slit_maker maker(world.soup);
  const oracle::Facet_table table = oracle::make_facet_table(world.soup);
  for (std::size_t f = 0; f < world.soup.facet_count(); ++f) {
    if (table.opposite[f] < static_cast<std::int64_t>(f)) continue;
    if (table.passable[f] && random.below(10) != 0) continue;
    const auto g = static_cast<std::size_t>(table.opposite[f]);
    bool is_parted = false;
    for (int k = 0; k < 4 && !is_parted; ++k) {
      const auto of_f = static_cast<Cut>(random.below(3)), of_g = static_cast<Cut>(random.below(3));
      is_parted = maker.part(f, g, of_f, of_g);
    }
    slits += is_parted;
  }
  world.soup = maker.soup();
  return world;
}

/// Two layers of cubes with walls in the plane between them, one in so many facets, and across it; some cubes
/// are solid, some missing.
inline oracle::World<3> layered_world(std::uint64_t seed, std::uint64_t one_in = 3) {
  constexpr std::uint32_t n = 4;
  Random random(seed);
  const Cell_soup<3> cubes = oracle::make_cubes(n, n, 2);
  oracle::World<3> world;
  world.name = "layers, world " + std::to_string(seed);
  world.soup.points = cubes.points;
  const auto other = [&](std::uint32_t c, std::size_t k) -> std::uint32_t {  // across facet k
    const std::uint32_t x = c % n, y = c / n % n;
    switch (k) {
      case 0:
        return c < n * n ? c : c - n * n;
      case 2:
        return y == 0 ? c : c - n;
      case 5:
        return x == 0 ? c : c - 1;
      default:
        return c;
    }
  };
  Cell_soup<3> walled = cubes;
  for (std::uint32_t c = 0; c < cubes.cell_count(); ++c)
    for (const std::size_t k : {0u, 2u, 5u})
      if (other(c, k) != c && random.below(k == 0 ? one_in : 12) == 0)
        oracle::set_wall(walled, c, other(c, k));
  for (std::uint32_t c = 0; c < cubes.cell_count(); ++c) {
    const std::uint64_t chance = random.below(20);
    if (chance == 0) continue;
    for (std::size_t f = walled.cell_begin[c]; f < walled.cell_begin[c + 1]; ++f)
      world.soup.add_facet(walled.facet(f), walled.impassable[f] != 0 || chance == 1);
    world.soup.end_cell(chance == 1);
  }
  return world;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_SLIT_WORLDS_H
