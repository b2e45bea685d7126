// SPDX-License-Identifier: LGPL-3.0-or-later
// A body is registered if it can be on some sides of walls, and then on such: judged by definition, in worlds
// of all kinds, for small bodies many of whose parts lie in walls; and the same listed in another order.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "body/registration/lift_judge.h"
#include "oracle/seed.h"
#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"
#include "walk/reordered.h"

namespace cellwalk::test {
namespace {

using oracle::Motion_kind;

/// Two to seven points, most of them in the plane of a wall or in the line of a ridge.
std::vector<Point<3>> some_points(oracle::Motion_source<3>& source) {
  Random& random = source.random();
  const bool is_in_plane = random.below(3) != 0, is_in_line = random.below(4) == 0;
  const std::size_t count = 2 + random.below(6);
  Point<3> from = source.start(is_in_plane ? Motion_kind::in_wall_plane : Motion_kind::to_lattice);
  if (is_in_line) from = source.start(Motion_kind::along_edge);
  Point<3> last = from;
  std::vector<Point<3>> points{from};
  while (points.size() < count) {
    Motion_kind kind = source.kind(false);
    if (is_in_line && random.below(3) != 0)
      kind = Motion_kind::along_edge;
    else if (is_in_plane && random.below(5) != 0)
      kind = Motion_kind::in_wall_plane;
    else if (kind == Motion_kind::in_wall_plane || kind == Motion_kind::along_edge)
      kind = Motion_kind::to_wall;
    Point<3> x = source.target(kind, from, last);
    const double share = std::array{1.0, 0.5, 0.25}[random.below(3)];
    for (std::size_t k = 0; k < 3; ++k) x[k] = from[k] + share * (x[k] - from[k]);
    points.push_back(x);
    last = from;
    if (random.below(2) == 0) from = x;
  }
  return points;
}

/// Up to four faces and two edges more.
Body_soup<3> some_body(oracle::Motion_source<3>& source) {
  Body_parts<3> parts;
  parts.points = some_points(source);
  Random& random = source.random();
  std::vector<std::uint32_t> order(parts.points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto take = [&](std::size_t n) {
    random.shuffle(order);
    return std::vector(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n));
  };
  if (order.size() > 2)
    for (std::size_t f = 1 + random.below(4); f > 0; --f) parts.polygons.push_back(take(3));
  for (std::size_t e = order.size() > 2 ? random.below(3) : 1; e > 0; --e) {
    const auto ends = take(2);
    parts.segments.push_back({ends[0], ends[1]});
  }
  return make_body(parts).body;
}

/// The same body, with vertices, edges and faces in another order.
Body_soup<3> relisted(const Body_soup<3>& body, Random& random) {
  std::vector<std::uint32_t> number(body.points.size());
  std::iota(number.begin(), number.end(), 0u);
  random.shuffle(number);
  Body_parts<3> parts;
  parts.points.resize(body.points.size());
  for (std::size_t v = 0; v < number.size(); ++v) parts.points[number[v]] = body.points[v];
  for (const auto& [u, v, w] : body.faces) parts.polygons.push_back({number[v], number[w], number[u]});
  for (const auto& [u, v] : body.edges) parts.segments.push_back({number[v], number[u]});
  random.shuffle(parts.polygons);
  return make_body(parts).body;
}

/// The body, or null if it is refused.
std::unique_ptr<Body<3>> registered(const Snapshot<3>& snapshot, const Body_soup<3>& soup) {
  try {
    auto body = std::make_unique<Body<3>>(snapshot, Locator<3>(snapshot), soup);
    body->validate();
    return body;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::outside) << error.what();
    return nullptr;
  }
}

TEST(RegistrationJudged, AcceptsBodiesThatCanBeOnSomeSides) {
  // Planes cut each other: beyond this number they take the judge too long.
  constexpr std::size_t most_planes = 45, bodies_in_world = 20;
  std::size_t accepted = 0, refused = 0, with_choice = 0, total = oracle::scaled_count(500);
  for (std::uint64_t number = 0; accepted + refused < total; ++number) {
    const oracle::World<3> world = oracle::make_world<3>(number);
    const Snapshot<3> snapshot = Snapshot<3>::compile(world.soup, glue(world.soup));
    const oracle::Reordered_world<3> reordered(world.soup, number + 1);
    oracle::Motion_source<3> source(world, number);
    for (std::size_t k = 0; k < bodies_in_world; ++k) {
      const Body_soup<3> soup = some_body(source);
      if (Near_cells_exact(snapshot, soup.points).planes().size() > most_planes) continue;
      const Lift_judge judge(snapshot, soup);
      const auto body = registered(snapshot, soup);
      const std::string place = world.name + ", body " + std::to_string(k);
      ASSERT_EQ(body != nullptr, judge.can_be_somewhere()) << place;
      const Body_soup<3> other = relisted(soup, source.random());
      ASSERT_EQ(registered(reordered.snapshot, other) != nullptr, body != nullptr) << place;
      ++(body ? accepted : refused);
      if (!body) continue;
      ASSERT_EQ(judge.fault(*body), "") << place;
      with_choice += judge.may_choose();
    }
  }
  std::cout << accepted << " bodies accepted, " << with_choice << " of them with a choice; " << refused
            << " refused\n";
  EXPECT_GT(accepted, total / 8);
  EXPECT_GT(refused, total / 4);
  EXPECT_GT(with_choice, total / 60);
}

}  // namespace
}  // namespace cellwalk::test
