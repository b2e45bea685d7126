// SPDX-License-Identifier: LGPL-3.0-or-later
// Environment::edit() with functions that leave maps no operation of CGAL would, and between other edits.
#include <cellwalk/environment/map_edit.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace cellwalk {
namespace {

template <int D>
Environment<D> small_grid() {
  if constexpr (D == 2)
    return Environment<2>::build(square_grid({.cells = {4, 3}}));
  else
    return Environment<3>::build(hex_grid({.cells = {3, 2, 2}}));
}

template <int D>
std::vector<std::vector<Point<D>>> sorted_loops(const Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  std::vector<std::vector<Point<D>>> result(snapshot.half_facet_slots());
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      for (const std::uint32_t p : snapshot.loop(f)) result[to_index(f)].push_back(snapshot.point(p));
      std::sort(result[to_index(f)].begin(), result[to_index(f)].end());
    }
  }
  return result;
}

template <int D>
bool is_same_soup(const Cell_soup<D>& a, const Cell_soup<D>& b) {
  return a.points == b.points && a.vertices == b.vertices && a.facet_begin == b.facet_begin &&
         a.cell_begin == b.cell_begin && a.impassable == b.impassable && a.solid == b.solid;
}

template <int D>
Dart<D> any_dart_of(Map<D>& map, Random& random) {
  auto it = map.darts().begin();
  for (std::size_t k = random.below(map.number_of_darts()); k > 0; --k) ++it;
  return it;
}

/// Whatever happens to it, an edit is done as a whole or not at all.
template <int D, class Change>
bool is_done(Environment<D>& environment, const Change& change) {
  const Cell_soup<D> before = environment.soup();
  const auto before_loops = sorted_loops(environment);
  const std::vector<Point<D>> points(environment.snapshot().points().begin(),
                                     environment.snapshot().points().end());
  const std::uint64_t epoch = environment.snapshot().epoch();
  Compaction names;
  try {
    names = environment.edit(change);
  } catch (...) {  // CGAL's marks throw what is no std::exception
    EXPECT_TRUE(is_same_soup(environment.soup(), before));
    EXPECT_EQ(sorted_loops(environment), before_loops);
    EXPECT_EQ(environment.snapshot().epoch(), epoch);
    environment.certify();
    return false;
  }
  environment.certify();
  EXPECT_GT(environment.snapshot().epoch(), epoch);
  const auto now = sorted_loops(environment);
  for (std::size_t f = 0; f < before_loops.size(); ++f)
    if (names.half_facets[f] != Half_facet::none) {
      EXPECT_EQ(now[to_index(names.half_facets[f])].size(), before_loops[f].size());
      EXPECT_NE(environment.snapshot().cell_of(names.half_facets[f]), Cell::none);
    }
  return true;
}

TEST(HostileMapEdit, FacetsSewnToOtherOnes) {
  for (const bool partly : {false, true}) {
    auto environment = small_grid<3>();
    // The first facets on the boundary at both ends of the grid.
    EXPECT_FALSE(is_done(environment, [&](Map<3>& map) {
      Dart<3> one{}, other{};
      for (auto it = map.darts().begin(); it != map.darts().end(); ++it) {
        if (!map.is_free<3>(it)) continue;
        if (map.point(it).x() == 0 && map.point(map.beta<1>(it)).x() == 0 &&
            map.point(map.beta<0>(it)).x() == 0)
          one = it;
        if (map.point(it).x() == 3 && map.point(map.beta<1>(it)).x() == 3 &&
            map.point(map.beta<0>(it)).x() == 3)
          other = it;
      }
      for (int k = 0; k < (partly ? 1 : 4); ++k) {
        map.basic_link_beta_for_involution<3>(one, other);
        one = map.beta<1>(one);
        other = map.beta<0>(other);
      }
    })) << partly;
  }
  // Half of a facet is no longer sewn.
  auto environment = small_grid<3>();
  EXPECT_FALSE(is_done(environment, [](Map<3>& map) {
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
      if (!map.is_free<3>(it)) return map.unlink_beta_for_involution<3>(it);
  }));
  // Edges joined crosswise.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    is_done(environment, [&](Map<3>& map) {
      for (std::uint64_t k = 0; k <= seed % 3; ++k) {
        const auto a = any_dart_of<3>(map, random), b = any_dart_of<3>(map, random);
        if (a == b) continue;
        const auto c = map.beta<2>(a), d = map.beta<2>(b);
        if (c == b) continue;
        map.basic_link_beta_for_involution<2>(a, b);
        map.basic_link_beta_for_involution<2>(c, d);
      }
    });
  }
}

TEST(HostileMapEdit, PointsThatAreNotFinite) {
  for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    auto environment = small_grid<3>();
    EXPECT_FALSE(
        is_done(environment, [&](Map<3>& map) { map.point(map.darts().begin()) = Map<3>::Point(x, 0, 0); }));
  }
}

TEST(HostileMapEdit, VerticesWithoutDarts) {
  auto environment = small_grid<3>();
  const std::size_t points = environment.snapshot().points().size();
  EXPECT_TRUE(is_done(environment, [](Map<3>& map) {
    for (int k = 0; k < 100; ++k) map.create_vertex_attribute(Map<3>::Point(1e9, k, 0));
  }));
  EXPECT_TRUE(is_done(environment, [](Map<3>&) {}));
  EXPECT_EQ(environment.snapshot().points().size(), points);
  environment.compact();
  environment.set_impassable(Snapshot<3>::half_facet(environment.snapshot().cell(0), 0), true);
  environment.certify();
}

TEST(HostileMapEdit, MarksThatAreLeft) {
  auto environment = small_grid<2>();
  // One is left set on some darts, and then all are taken.
  EXPECT_TRUE(is_done(environment, [](Map<2>& map) { map.mark(map.darts().begin(), map.get_new_mark()); }));
  EXPECT_TRUE(is_done(environment, [](Map<2>& map) { map.negate_mark(map.get_new_mark()); }));
  EXPECT_FALSE(is_done(environment, [](Map<2>& map) {
    for (;;) map.get_new_mark();
  }));
  EXPECT_TRUE(
      is_done(environment, [](Map<2>& map) { map.insert_barycenter_in_cell<1>(map.darts().begin()); }));
}

template <int D>
void write_nonsense(std::uint64_t seed) {
  auto environment = small_grid<D>();
  environment.fill(environment.snapshot().cell(3));
  Random random(seed);
  const Cell_soup<D> before = environment.soup();
  EXPECT_TRUE(is_done(environment, [&](Map<D>& map) {
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it) {
      auto& info = map.info(it);
      info.set_cell(static_cast<std::uint32_t>(random.below(1u << 31)));
      info.set_half_facet(static_cast<std::uint32_t>(random.below(random.below(2) == 0 ? 100 : 1u << 29)));
    }
    auto& vertices = map.template attributes<0>();
    for (auto it = vertices.begin(); it != vertices.end(); ++it)
      map.template info_of_attribute<0>(it) =
          static_cast<std::uint32_t>(random.below(random.below(2) == 0 ? 30 : 0xffffffffu));
  }));
  const Cell_soup<D> after = environment.soup();
  EXPECT_EQ(after.cell_count(), before.cell_count());
  EXPECT_EQ(std::count(after.solid.begin(), after.solid.end(), 1), 1);
  EXPECT_EQ(std::count(after.impassable.begin(), after.impassable.end(), 1),
            std::count(before.impassable.begin(), before.impassable.end(), 1));
  auto points = after.points, old_points = before.points;
  std::sort(points.begin(), points.end());
  std::sort(old_points.begin(), old_points.end());
  EXPECT_EQ(points, old_points);
}

TEST(HostileMapEdit, NonsenseInDarts) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    write_nonsense<2>(seed);
    write_nonsense<3>(seed);
  }
}

template <int D>
void edit_in_turn(std::uint64_t seed, std::size_t& done, std::size_t& refused) {
  auto environment = small_grid<D>();
  Random random(seed);
  const auto some_cell = [&] {
    for (;;)
      if (const Cell c = environment.snapshot().cell(random.below(environment.snapshot().cell_slots()));
          c != Cell::none)
        return c;
  };
  for (int k = 0; k < 60; ++k) {
    try {
      switch (random.below(9)) {
        case 0:
          environment.fill(some_cell());
          continue;
        case 1:
          environment.excavate(some_cell());
          continue;
        case 2: {
          const Cell c = some_cell();
          Point<D> centre{};
          std::size_t count = 0;
          for (std::size_t f = 0; f < environment.snapshot().facet_count(c); ++f)
            for (const std::uint32_t p : environment.snapshot().loop(Snapshot<D>::half_facet(c, f))) {
              for (std::size_t i = 0; i < D; ++i) centre[i] += environment.snapshot().point(p)[i];
              ++count;
            }
          for (double& x : centre) x /= static_cast<double>(count);
          if (environment.snapshot().points().size() < 80) environment.insert_point(c, centre);
          continue;
        }
        case 3: {
          const auto p = static_cast<std::uint32_t>(random.below(environment.snapshot().points().size()));
          Point<D> x = environment.snapshot().point(p);
          x[0] += 0.0625;
          environment.move_vertex(p, x);
          continue;
        }
        case 4:
          environment.compact();
          continue;
        case 5:
          environment.freeze();
          environment.thaw();
          continue;
        default:
          break;
      }
    } catch (const Error&) {
      environment.certify();
      continue;
    }
    const bool is_kept = is_done(environment, [&](Map<D>& map) {
      for (std::size_t n = 1 + random.below(2); n > 0; --n) {
        const auto d = any_dart_of<D>(map, random);
        switch (random.below(8)) {
          case 0:
            map.template insert_barycenter_in_cell<2>(d);
            break;
          case 1:
            map.template insert_barycenter_in_cell<1>(d);
            break;
          case 2:
            if (!map.template is_free<D>(d)) map.template remove_cell<D - 1>(d);
            break;
          case 3:
            if (!map.template is_free<D>(d)) map.template unsew<D>(d);
            break;
          case 4:
            map.template remove_cell<D>(d);
            break;
          case 5:
            map.template contract_cell<1>(d);
            break;
          case 6:
            set_impassable<D>(map, d, random.below(2) == 0);
            break;
          default:
            if (random.below(3) == 0) throw std::runtime_error("stop");
            map.info(d).set_solid(random.below(2) == 0);
        }
      }
    });
    ++(is_kept ? done : refused);
  }
}

TEST(HostileMapEdit, AmongOtherEdits) {
  std::size_t done = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    edit_in_turn<2>(seed, done, refused);
    edit_in_turn<3>(seed, done, refused);
  }
  EXPECT_GT(done, 100u);
  EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace cellwalk
