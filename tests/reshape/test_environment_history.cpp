// SPDX-License-Identifier: LGPL-3.0-or-later
// A compiled copy of an environment that was edited, with its history, does exactly what the environment
// does.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/environment/cell_cluster.h>
#include <cellwalk/internal/environment/environment_history.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "reshape/grids.h"

namespace cellwalk {
namespace {

/// Moves, replaces, opens and closes; the same numbers do the same.
template <int D>
Reshape_counts disturb(Environment<D>& environment, std::uint64_t seed) {
  const Residents<D> none;
  Reshaping<D> reshaping(environment, none);
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(seed);
  std::vector<std::uint32_t> points;
  for (std::uint32_t v = 0; v < snapshot.points().size(); ++v)
    if (snapshot.is_point(v)) points.push_back(v);
  for (const std::uint32_t v : points) {
    Point<D> x = snapshot.point(v);
    if (std::ranges::any_of(x, [](double c) { return c == 0 || c == 4; })) continue;
    for (double& c : x) c += random.real(-0.6, 0.6);
    reshaping.move(v, x);
  }
  reshaping.relax(points);
  for (int k = 0; k < 40; ++k) {
    const Cell cell = snapshot.cell(random.below(snapshot.cell_slots()));
    if (cell == Cell::none) continue;
    const Half_facet facet = Snapshot<D>::half_facet(cell, random.below(D + 1));
    if (snapshot.neighbour(facet) == Cell::none) continue;
    if (random.below(2) == 0)
      reshaping.close(facet);
    else
      reshaping.open(facet);
  }
  reshaping.finish();
  return reshaping.counts();
}

/// Of each point, the cells around it, in order.
template <int D>
std::vector<std::vector<Cell>> stars(Environment<D>& environment) {
  std::vector<std::vector<Cell>> result;
  for (std::uint32_t v = 0; v < environment.snapshot().points().size(); ++v)
    if (environment.snapshot().is_point(v)) result.push_back(environment.cells_around(v));
  return result;
}

template <int D>
void follow() {
  Environment<D> environment = test::simplex_grid<D>(4);
  const auto& clusters = environment.snapshot().clusters();
  const std::uint32_t size = clusters.size(environment.snapshot());  // makes the table
  disturb(environment, 1);
  const Certificate certificate = environment.certify();
  const auto copy_of = [&] {
    auto copy = std::get<Compiled_environment<D>>(
        open_compiled_copy(compile_to_bytes<D>(environment, certificate, {})));
    copy.environment.thaw();
    return std::move(copy.environment);
  };
  Environment<D> copy = copy_of(), stranger = copy_of();
  const detail::Environment_history history = detail::history_of(environment);
  EXPECT_TRUE(history.stars.has_value());
  EXPECT_NE(history.cluster_size, 0u);
  EXPECT_EQ(clusters.size(environment.snapshot()), size);
  detail::follow_history(copy, history);
  EXPECT_EQ(stars(copy), stars(environment));
  if (D == 3) {
    EXPECT_FALSE(stars(stranger) == stars(environment)) << "nothing of its history is to be seen";
  }
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    EXPECT_EQ(std::bit_cast<Count_array<Reshape_counts>>(disturb(copy, seed)),
              std::bit_cast<Count_array<Reshape_counts>>(disturb(environment, seed)));
    EXPECT_EQ(compile_to_bytes<D>(copy, certificate, {}), compile_to_bytes<D>(environment, certificate, {}));
    EXPECT_EQ(stars(copy), stars(environment));
    const detail::Environment_history one = detail::history_of(environment), other = detail::history_of(copy);
    EXPECT_EQ(one.cluster_size, other.cluster_size);
    EXPECT_EQ(one.cluster_places, other.cluster_places);
    EXPECT_EQ(one.stars->first, other.stars->first);
  }
}

TEST(EnvironmentHistory, IsFollowed2) { follow<2>(); }
TEST(EnvironmentHistory, IsFollowed3) { follow<3>(); }

TEST(EnvironmentHistory, OfAnotherEnvironmentIsRefused) {
  Environment<3> environment = test::simplex_grid<3>(4), small = test::simplex_grid<3>(1);
  disturb(environment, 1);
  detail::Environment_history history = detail::history_of(environment);
  EXPECT_THROW(detail::follow_history(small, history), Error);
  history.stars.reset();
  history.cluster_size = 1u << 20;
  EXPECT_THROW(detail::follow_history(environment, history), Error);
  detail::follow_history(small, detail::history_of(small));  // none yet
  EXPECT_FALSE(detail::history_of(small).stars.has_value());
}

}  // namespace
}  // namespace cellwalk
