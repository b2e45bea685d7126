// SPDX-License-Identifier: LGPL-3.0-or-later
// What must not change the answers to moves of walls: going back, the order of moves that have nothing to do
// with each other, the size and the direction of the world, and the order in which it is listed.
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "edge/relisted.h"
#include "reshape/definition_oracle.h"
#include "reshape/dimensions.h"
#include "reshape/reshape_world.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

using test::count_at_least;
using test::hold;

template <int D>
using World = test::Reshape_world<D>;

template <int D>
std::vector<test::Registered_edge<D>> registrations(const World<D>& world) {
  std::vector<test::Registered_edge<D>> result;
  for (const Particle<D>& p : world.particles) result.push_back({p.position, p.position, p.cell, p.cell, {}});
  for (const auto& body : world.bodies)
    for (std::size_t e = 0; e < body->edges().size(); ++e) {
      const Particle<D>&p = body->particles()[body->edges()[e][0]],
            &q = body->particles()[body->edges()[e][1]];
      const Chain& chain = body->chain(e);
      result.push_back({p.position, q.position, p.cell, q.cell, {chain.begin(), chain.end()}});
    }
  return result;
}

/// Registrations that are not equal to those before, while all stands where it stood then.
template <int D>
int changed(const World<D>& world, std::uint32_t v, const std::vector<test::Registered_edge<D>>& before) {
  const Point<D>& place = world.snapshot.point(v);
  const test::Wall_motion<D> standing{world.snapshot, v, place, place};
  const auto after = registrations(world);
  int result = 0;
  for (std::size_t k = 0; k < after.size(); ++k)
    result += after[k].chain != before[k].chain || after[k].p_cell != before[k].p_cell
                  ? !test::is_end(standing, test::fate_of(standing, before[k]), after[k])
                  : 0;
  return result;
}

template <int D>
void go_there_and_back(bool generic, std::size_t worlds) {
  int moves = 0, stuck = 0, parted = 0, changes = 0;
  for (std::uint64_t number = 0; number < count_at_least(worlds); ++number) {
    World<D> world(number, generic);
    world.populate(8, 6);
    Reshaping<D> reshaping(world.environment, world.residents(), hold);
    for (int k = 0; k < 10; ++k) {
      const std::uint32_t v = world.vertex();
      const Point<D> from = world.snapshot.point(v);
      const auto before = registrations(world);
      const std::uint64_t followed = reshaping.counts().followed;
      // Where something was touched, there may have been a choice.
      if (reshaping.move(v, world.target(v)).end != Move_end::reached ||
          followed != reshaping.counts().followed)
        continue;
      ++moves;
      // A boundary that touched itself may part, and does not come back.
      const Move_end back = reshaping.move(v, from).end;
      parted += back == Move_end::boundary;
      stuck += back != Move_end::reached && back != Move_end::boundary;
      if (world.snapshot.point(v) == from) changes += changed(world, v, before);
    }
  }
  EXPECT_EQ(stuck, 0);
  EXPECT_LE(parted, moves / 20);
  EXPECT_EQ(changes, 0);
  EXPECT_GT(moves, static_cast<int>(count_at_least(worlds)));
}

TEST(Metamorphic, ThereAndBackChangesNothing) {
  go_there_and_back<2>(true, 20);
  go_there_and_back<2>(false, 20);
  go_there_and_back<3>(true, 8);
  go_there_and_back<3>(false, 8);
}

template <int D>
bool is_same(const Vertex_result<D>& x, const Vertex_result<D>& y) {
  return x.end == y.end && x.hit.has_value() == y.hit.has_value() &&
         (!x.hit || x.hit->exact_time() == y.hit->exact_time());
}

/// Vertices without a common cell move in both orders.
template <int D>
void swap_order(bool generic, std::size_t worlds) {
  int pairs = 0, different = 0;
  for (std::uint64_t number = 0; number < count_at_least(worlds); ++number)
    for (int trial = 0; trial < 3; ++trial) {
      World<D> one(number, generic), other(number, generic);
      one.populate(8, 6);
      other.populate(8, 6);
      for (int k = 0; k < trial; ++k) one.vertex();
      std::uint32_t u = one.vertex(), v = one.vertex();
      const std::vector<Cell> at_u = one.environment.cells_around(u), at_v = one.environment.cells_around(v);
      const auto is_at_v = [&](Cell c) { return std::ranges::find(at_v, c) != at_v.end(); };
      if (std::ranges::any_of(at_u, is_at_v)) continue;
      const Point<D> u_to = one.target(u), v_to = one.target(v);
      Reshaping<D> first(one.environment, one.residents(), hold);
      Reshaping<D> second(other.environment, other.residents(), hold);
      const auto u_first = first.move(u, u_to), v_second = first.move(v, v_to);
      const auto v_first = second.move(v, v_to), u_second = second.move(u, u_to);
      first.finish();
      second.finish();
      // The boundary may come near itself by both.
      if (u_first.end == Move_end::boundary || v_first.end == Move_end::boundary ||
          u_second.end == Move_end::boundary || v_second.end == Move_end::boundary)
        continue;
      ++pairs;
      different += !is_same(u_first, u_second) || !is_same(v_first, v_second);
      const auto before = registrations(one);
      different += changed(other, u, before);
    }
  EXPECT_EQ(different, 0);
  EXPECT_GT(pairs, static_cast<int>(count_at_least(worlds)) / 3);
}

TEST(Metamorphic, VerticesWithoutACommonCellCommute) {
  swap_order<2>(true, 20);
  swap_order<2>(false, 20);
  swap_order<3>(true, 8);
  swap_order<3>(false, 8);
}

/// The same bodies, in a world that a map of points and cells gives, registered on the same sides, and the
/// answers to the same questions there.
template <int D, class Map>
void ask_in_images(bool generic, std::size_t worlds, const Map& map, double share_of_all) {
  int asked = 0, contacts = 0, different = 0, bodies = 0, kept = 0;
  for (std::uint64_t k = 0; k < count_at_least(worlds); ++k) {
    // Worlds of simplices, whose cells are not split.
    const std::uint64_t number = oracle::world_kinds * k + (generic ? 10 : 9);
    World<D> world(number, generic);
    world.populate(0, 12);
    oracle::World<D> made = oracle::make_world<D>(number);
    const auto image = map(made.soup, number);
    made.soup = image.soup;
    World<D> other(std::move(made), number, generic);
    const Locator<D> locator(other.snapshot);
    const auto has_same_cell = [&](const Particle<D>& x, const Particle<D>& y) {
      return image.new_cell[world.snapshot.index(x.cell)] == other.snapshot.index(y.cell);
    };
    const auto cell_behind = [&](Half_facet f) {
      return image.new_cell[world.snapshot.index(world.snapshot.neighbour(f))];
    };
    const auto cell_behind_there = [&](Half_facet f) {
      return other.snapshot.index(other.snapshot.neighbour(f));
    };
    std::vector<std::unique_ptr<Body<D>>> same;
    for (const auto& body : world.bodies) {
      ++bodies;
      Body_soup<D> soup{
          {}, {body->edges().begin(), body->edges().end()}, {body->faces().begin(), body->faces().end()}};
      for (const Point<D>& x : body->positions()) soup.points.push_back(image.place(x));
      auto copy = std::make_unique<Body<D>>(other.snapshot, locator, soup);
      bool is_alike = true;
      for (std::size_t v = 0; v < body->vertex_count(); ++v)
        is_alike &= has_same_cell(body->particles()[v], copy->particles()[v]);
      for (std::size_t e = 0; e < body->edges().size(); ++e)
        is_alike &= std::ranges::equal(body->chain(e), copy->chain(e), {}, cell_behind, cell_behind_there);
      if (!is_alike) continue;  // on another side, or another way to the same one
      same.push_back(std::make_unique<Body<D>>(*body));
      other.bodies.push_back(std::move(copy));
      ++kept;
    }
    world.bodies = std::move(same);
    if (world.bodies.empty()) continue;
    Reshaping<D> here(world.environment, world.residents(), hold);
    Reshaping<D> there(other.environment, other.residents(), hold);
    for (int i = 0; i < 40; ++i) {
      const std::uint32_t v = static_cast<std::uint32_t>(world.random.below(world.snapshot.points().size()));
      const Point<D> target = world.target(v);
      const auto answer = here.test_move(v, target),
                 in_image = there.test_move(image.new_point[v], image.place(target));
      ++asked;
      contacts += answer.end == Move_end::contact;
      different += !is_same(answer, in_image);
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(contacts, asked / 40);
  EXPECT_GT(kept, share_of_all * bodies);
}

template <int D>
struct Image {
  Cell_soup<D> soup;
  std::vector<std::uint32_t> new_cell, new_point;
  Point<D> (*place)(const Point<D>&);
};

template <int D>
Image<D> same_lists(const Cell_soup<D>& soup, Point<D> (*place)(const Point<D>&)) {
  Image<D> image{soup, {}, {}, place};
  for (Point<D>& x : image.soup.points) x = place(x);
  for (std::uint32_t c = 0; c < soup.cell_count(); ++c) image.new_cell.push_back(c);
  for (std::uint32_t p = 0; p < soup.points.size(); ++p) image.new_point.push_back(p);
  return image;
}

template <int D>
void scale_by(bool generic, std::size_t worlds) {
  ask_in_images<D>(
      generic, worlds,
      [](const Cell_soup<D>& soup, std::uint64_t number) {
        return number % 2 == 0
                   ? same_lists<D>(soup,
                                   [](const Point<D>& x) { return Point<D>{} + 0x1p40 * (x - Point<D>{}); })
                   : same_lists<D>(soup,
                                   [](const Point<D>& x) { return Point<D>{} + 0x1p-40 * (x - Point<D>{}); });
      },
      0.99);
}

TEST(Metamorphic, ScaledWorldsGiveTheSameAnswers) {
  scale_by<2>(true, 6);
  scale_by<2>(false, 6);
  scale_by<3>(true, 4);
  scale_by<3>(false, 4);
}

/// Turned about the first diagonal (3D) or by a right angle (2D).
template <int D>
Point<D> turned(const Point<D>& x) {
  if constexpr (D == 2)
    return {-x[1], x[0]};
  else
    return {x[1], x[2], x[0]};
}

template <int D>
void turn(bool generic, std::size_t worlds) {
  ask_in_images<D>(
      generic, worlds, [](const Cell_soup<D>& soup, std::uint64_t) { return same_lists<D>(soup, turned<D>); },
      0.3);
}

TEST(Metamorphic, TurnedWorldsGiveTheSameAnswers) {
  turn<2>(true, 6);
  turn<2>(false, 6);
  turn<3>(true, 4);
  turn<3>(false, 4);
}

template <int D>
void list_again(bool generic, std::size_t worlds) {
  ask_in_images<D>(
      generic, worlds,
      [](const Cell_soup<D>& soup, std::uint64_t number) {
        auto other = test::relisted(soup, number + 1);
        Image<D> image{std::move(other.soup), std::move(other.new_cell), std::move(other.new_point),
                       [](const Point<D>& x) { return x; }};
        return image;
      },
      0.3);
}

TEST(Metamorphic, WorldsListedInAnotherOrderGiveTheSameAnswers) {
  list_again<2>(true, 6);
  list_again<2>(false, 6);
  list_again<3>(true, 4);
  list_again<3>(false, 4);
}

}  // namespace
}  // namespace cellwalk
