// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits of an environment's map by CGAL's own operations: certified and compiled, or refused with nothing
// changed.
#include <cellwalk/environment/map_edit.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace cellwalk {
namespace {

/// All that can be seen of an environment, in the order of its indices.
template <int D>
struct Seen {
  Cell_soup<D> soup;
  std::vector<std::uint32_t> cells, facets;  ///< names

  explicit Seen(const Environment<D>& environment) : soup(environment.soup()) {
    const Snapshot<D>& snapshot = environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      cells.push_back(to_index(c));
      if (c == Cell::none) continue;
      for (std::size_t k = 0; k < snapshot.facet_count(c); ++k)
        facets.push_back(to_index(snapshot.neighbour(Snapshot<D>::half_facet(c, k))));
    }
  }
  bool operator==(const Seen& other) const {
    return soup.points == other.soup.points && soup.vertices == other.soup.vertices &&
           soup.impassable == other.soup.impassable && soup.solid == other.soup.solid &&
           cells == other.cells && facets == other.facets;
  }
};

template <int D>
Environment<D> grid(bool with_walls = false) {
  if constexpr (D == 2) {
    auto environment = Environment<2>::build(square_grid({.cells = {4, 3}}));
    if (with_walls) environment.fill(environment.snapshot().cell(5));
    return environment;
  } else {
    auto environment = Environment<3>::build(hex_grid({.cells = {3, 3, 3}}));
    if (with_walls) environment.fill(environment.snapshot().cell(13));
    return environment;
  }
}

/// A dart of a facet with cells on both sides; the k-th such dart.
template <int D>
Dart<D> inner_dart(Map<D>& map, std::size_t k = 0) {
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
    if (!map.template is_free<D>(it) && k-- == 0) return it;
  throw std::logic_error("no such dart");
}

template <int D>
std::size_t inner_darts(Map<D>& map) {
  std::size_t count = 0;
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it) count += !map.template is_free<D>(it);
  return count;
}

/// What an edit does if it is refused.
template <int D, class Change>
std::string refusal(Environment<D>& environment, const Change& change) {
  const Seen<D> before(environment);
  const std::uint64_t epoch = environment.snapshot().epoch();
  std::string message;
  try {
    environment.edit(change);
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_FALSE(message.empty());
  EXPECT_TRUE(Seen<D>(environment) == before) << message;
  EXPECT_EQ(environment.snapshot().epoch(), epoch);
  environment.certify();
  return message;
}

TEST(MapEdit, FacetsAndCellsAreCutByCgal) {
  auto environment = grid<3>();
  const auto cells = environment.snapshot().cell_count();
  environment.edit([](Map<3>& map) { map.insert_barycenter_in_cell<2>(inner_dart<3>(map)); });
  environment.certify();
  EXPECT_EQ(environment.snapshot().cell_count(), cells);
  EXPECT_EQ(environment.snapshot().points().size(), 65u);
  // Without the facet between them, two cells become one.
  environment.edit([](Map<3>& map) { map.remove_cell<2>(inner_dart<3>(map, inner_darts<3>(map) / 2)); });
  environment.certify();
  EXPECT_EQ(environment.snapshot().cell_count(), cells - 1);
}

TEST(MapEdit, NamesOfWhatStaysAreTold) {
  auto environment = grid<3>(true);
  const Seen<3> before(environment);
  const Snapshot<3>& snapshot = environment.snapshot();
  std::vector<std::vector<std::uint32_t>> loops(snapshot.half_facet_slots());
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    for (std::size_t k = 0; k < snapshot.facet_count(snapshot.cell(i)); ++k) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(i), k);
      loops[to_index(f)] = snapshot.loop(f);
    }
  const auto points = std::vector(snapshot.points().begin(), snapshot.points().end());
  const Compaction names =
      environment.edit([](Map<3>& map) { map.insert_barycenter_in_cell<2>(inner_dart<3>(map)); });
  std::size_t kept = 0;
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const Half_facet now = names.half_facets[f];
    if (now == Half_facet::none) continue;
    ++kept;
    std::vector<std::uint32_t> loop = loops[f];
    for (std::uint32_t& p : loop) p = names.points[p];
    std::vector<std::uint32_t> other = snapshot.loop(now);
    std::sort(loop.begin(), loop.end());
    std::sort(other.begin(), other.end());
    EXPECT_EQ(loop, other);
  }
  EXPECT_EQ(kept, 25u * 6);
  EXPECT_EQ(std::count(names.cells.begin(), names.cells.end(), Cell::none),
            static_cast<std::ptrdiff_t>(names.cells.size()) - 25);
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_EQ(snapshot.point(names.points[p]), points[p]);
}

TEST(MapEdit, WallsAreOpenedAndClosedByDarts) {
  auto environment = grid<3>();
  const auto walls = [&] {
    const Cell_soup<3> soup = environment.soup();
    return std::count(soup.impassable.begin(), soup.impassable.end(), 1);
  };
  const auto boundary = walls();
  environment.edit([](Map<3>& map) { set_impassable<3>(map, inner_dart<3>(map), true); });
  EXPECT_EQ(walls(), boundary + 2);
  environment.edit([](Map<3>& map) { set_impassable<3>(map, inner_dart<3>(map), false); });
  EXPECT_EQ(walls(), boundary);
  // Part of a wall that is cut stays wall.
  environment.edit([](Map<3>& map) {
    set_impassable<3>(map, inner_dart<3>(map), true);
    map.insert_barycenter_in_cell<2>(inner_dart<3>(map));
  });
  EXPECT_EQ(walls(), boundary + 8);
}

TEST(MapEdit, CellsAreAddedAndVerticesMoved) {
  auto environment = grid<2>();
  environment.edit([](Map<2>& map) {
    using P = Map<2>::Point;
    const auto d = map.make_quadrangle(P(4, 0), P(5, 0), P(5, 1), P(4, 1));
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
      if (map.point(it) == P(4, 0) && map.point(map.beta<1>(it)) == P(4, 1)) {
        map.sew<2>(map.beta<0>(d), it);
        break;
      }
  });
  environment.certify();
  EXPECT_EQ(environment.snapshot().cell_count(), 13u);
  EXPECT_EQ(environment.snapshot().points().size(), 22u);
  environment.edit([](Map<2>& map) {
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
      if (map.point(it) == Map<2>::Point(1, 1)) {
        map.point(it) = Map<2>::Point(1.25, 1.125);
        break;
      }
  });
  environment.certify();
  const auto points = environment.snapshot().points();
  EXPECT_NE(std::find(points.begin(), points.end(), Point<2>{1.25, 1.125}), points.end());
}

TEST(MapEdit, WhatIsNotCertifiedIsUndone) {
  auto environment = grid<3>(true);
  // A cell that is not convex: an L of two rows.
  EXPECT_NE(refusal(environment,
                    [](Map<3>& map) {
                      const auto remove = [&](Map<3>::Point a, Map<3>::Point b) {
                        for (auto it = map.darts().begin(); it != map.darts().end(); ++it) {
                          if (map.is_free<3>(it) || map.point(it) != a || map.point(map.beta<1, 1>(it)) != b)
                            continue;
                          map.remove_cell<2>(it);
                          return;
                        }
                      };
                      remove({1, 0, 0}, {1, 1, 1});
                      remove({0, 1, 0}, {1, 1, 1});
                    })
                .find("cell"),
            std::string::npos);
  EXPECT_NE(
      refusal(environment, [](Map<3>& map) { map.unlink_beta<2>(inner_dart<3>(map)); }).find("not closed"),
      std::string::npos);
  EXPECT_NE(
      refusal(environment, [](Map<3>& map) { map.point(inner_dart<3>(map)) = Map<3>::Point(40, 40, 40); })
          .find("cell"),
      std::string::npos);
  refusal(environment, [](Map<3>& map) { map.clear(); });
  // A cell over another one.
  refusal(environment, [](Map<3>& map) {
    using P = Map<3>::Point;
    map.make_tetrahedron(P(0.25, 0.25, 0.25), P(0.25, 0.5, 0.25), P(0.5, 0.25, 0.25), P(0.25, 0.25, 0.5));
  });
  // A function that throws, after it has changed the map.
  const Seen<3> before(environment);
  EXPECT_THROW(environment.edit([](Map<3>& map) {
    map.remove_cell<2>(inner_dart<3>(map));
    throw std::runtime_error("stop");
  }),
               std::runtime_error);
  EXPECT_TRUE(Seen<3>(environment) == before);
  environment.freeze();
  EXPECT_THROW(environment.edit([](Map<3>&) {}), Error);
}

/// Edits at random, of which some are refused: what holds afterwards is what a new environment of the same
/// cells has.
template <int D>
void edit_at_random(std::uint64_t seed) {
  auto environment = grid<D>(true);
  Random random(seed);
  std::size_t done = 0, refused = 0;
  for (int k = 0; k < 40; ++k) {
    const Seen<D> before(environment);
    try {
      environment.edit([&](Map<D>& map) {
        const std::size_t inner = inner_darts<D>(map);
        if (inner == 0) throw Error(Error_code::input, "no inner facet is left");
        const auto d = inner_dart<D>(map, random.below(inner));
        switch (random.below(5)) {
          case 0:
            map.template insert_barycenter_in_cell<2>(d);
            break;
          case 1:
            map.template remove_cell<D - 1>(d);
            break;
          case 2:
            map.template insert_barycenter_in_cell<1>(d);
            break;
          case 3:
            set_impassable<D>(map, d, random.below(2) == 0);
            break;
          default:
            map.template unsew<D>(d);
        }
      });
      ++done;
      environment.certify();
    } catch (const Error&) {
      ++refused;
      EXPECT_TRUE(Seen<D>(environment) == before);
    }
  }
  EXPECT_GT(done, 5u);
  EXPECT_GT(refused, 0u);
}

TEST(MapEdit, AtRandom) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    edit_at_random<2>(seed);
    edit_at_random<3>(seed);
  }
}

}  // namespace
}  // namespace cellwalk
