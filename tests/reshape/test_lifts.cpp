// SPDX-License-Identifier: LGPL-3.0-or-later
// Answers to moves of walls depend on the side of walls on which bodies are, and not on the cells and chains
// that stand for it: worlds are listed in another order, so that the same bodies get others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "edge/relisted.h"
#include "reshape/definition_oracle.h"
#include "reshape/dimensions.h"
#include "reshape/reshape_world.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

using test::count_at_least;

/// A world of simplices and the same world listed in another order.
template <int D>
class Twins {
 public:
  explicit Twins(std::uint64_t number)
      : Twins(number, test::relisted(oracle::make_world<D>(number).soup, number + 1)) {}

  /// False if cells were split: then those of one world are not those of the other.
  bool are_alike() const {
    return one.snapshot.cell_slots() == old_cell_.size() && other.snapshot.cell_slots() == old_cell_.size();
  }
  std::uint32_t point_there(std::uint32_t v) const { return new_point_[v]; }

  /// Leaves the bodies that are on the same sides in both worlds, in other cells. Returns how many there
  /// were.
  std::size_t keep_equal_bodies() {
    const Locator<D> locator(other.snapshot);
    std::vector<std::unique_ptr<Body<D>>> all = std::move(one.bodies);
    one.bodies.clear();
    for (auto& body : all) {
      Body_soup<D> soup{
          {}, {body->edges().begin(), body->edges().end()}, {body->faces().begin(), body->faces().end()}};
      soup.points.assign(body->positions().begin(), body->positions().end());
      auto copy = std::make_unique<Body<D>>(other.snapshot, locator, soup);
      if (!are_in_other_cells(*body, *copy)) continue;
      one.bodies.push_back(std::move(body));
      other.bodies.push_back(std::move(copy));
    }
    return all.size();
  }

  test::Reshape_world<D> one, other;

 private:
  using Edge = test::Registered_edge<D>;

  Twins(std::uint64_t number, test::Relisted<D> list)
      : one(number, false), other(with_soup(number, list.soup), number, false), new_point_(list.new_point) {
    old_cell_.resize(list.new_cell.size());
    for (std::uint32_t c = 0; c < old_cell_.size(); ++c) old_cell_[list.new_cell[c]] = c;
    one.populate(0, 14);
  }
  static oracle::World<D> with_soup(std::uint64_t number, const Cell_soup<D>& soup) {
    oracle::World<D> world = oracle::make_world<D>(number);
    world.soup = soup;
    return world;
  }

  Cell here(Cell there) const { return one.snapshot.cell(old_cell_[other.snapshot.index(there)]); }
  Half_facet here(Half_facet there) const {
    const Cell cell = here(other.snapshot.cell_of(there)), next = here(other.snapshot.neighbour(there));
    std::size_t i = 0;
    while (one.snapshot.neighbour(Snapshot<D>::half_facet(cell, i)) != next) ++i;
    return Snapshot<D>::half_facet(cell, i);
  }

  bool are_in_other_cells(const Body<D>& body, const Body<D>& copy) const {
    const Point<D>& place = one.snapshot.point(0);
    const test::Wall_motion<D> standing{one.snapshot, 0, place, place};
    const auto x = body.particles(), y = copy.particles();
    bool is_other = false, is_equal = true;
    const auto compare = [&](const Edge& a, const Edge& b) {
      is_other |= a.p_cell != b.p_cell || a.chain != b.chain;
      is_equal &= test::is_end(standing, test::fate_of(standing, a), b);
    };
    for (std::size_t v = 0; v < x.size(); ++v)
      compare({x[v].position, x[v].position, x[v].cell, x[v].cell, {}},
              {y[v].position, y[v].position, here(y[v].cell), here(y[v].cell), {}});
    for (std::size_t e = 0; e < body.edges().size(); ++e) {
      const auto [p, q] = body.edges()[e];
      Edge a{x[p].position, x[q].position, x[p].cell, x[q].cell, {}};
      Edge b{y[p].position, y[q].position, here(y[p].cell), here(y[q].cell), {}};
      a.chain.assign(body.chain(e).begin(), body.chain(e).end());
      for (const Half_facet f : copy.chain(e)) b.chain.push_back(here(f));
      compare(a, b);
    }
    return is_other && is_equal;
  }

  std::vector<std::uint32_t> old_cell_, new_point_;
};

/// \param first the first of so many worlds
template <int D>
void ask_both(std::uint64_t first, std::uint64_t worlds) {
  constexpr int moves = 60;
  int asked = 0, reached = 0, different = 0;
  std::size_t bodies = 0, kept = 0;
  for (std::uint64_t k = first; k < first + count_at_least(worlds); ++k) {
    // Worlds of simplices on a lattice.
    Twins<D> twins(oracle::world_kinds * k + 9);
    if (!twins.are_alike()) continue;
    bodies += twins.keep_equal_bodies();
    kept += twins.one.bodies.size();
    if (twins.one.bodies.empty()) continue;
    Reshaping<D> here(twins.one.environment, twins.one.residents(), {.at_contact = At_contact::hold});
    Reshaping<D> there(twins.other.environment, twins.other.residents(), {.at_contact = At_contact::hold});
    for (int i = 0; i < moves; ++i) {
      const std::uint32_t v = twins.one.vertex();
      const Point<D> target = twins.one.target(v);
      const auto a = here.test_move(v, target), b = there.test_move(twins.point_there(v), target);
      ++asked;
      reached += a.end == Move_end::reached;
      const bool is_same = a.end == b.end && a.hit.has_value() == b.hit.has_value() &&
                           (!a.hit || a.hit->exact_time() == b.hit->exact_time());
      if (!is_same && ++different < 10) ADD_FAILURE() << "in world " << k << " at point " << v;
    }
  }
  std::printf("%dD: %zu of %zu bodies in other cells; %d asked, %d reached, %d different\n", D, kept, bodies,
              asked, reached, different);
  EXPECT_EQ(different, 0);
  EXPECT_GT(kept, bodies / 10);
  EXPECT_GT(reached, asked / 4);
}

TEST(Lifts, TheCellsThatStandForThemDoNotMatter2D) { ask_both<2>(0, 40); }
TEST(Lifts, TheCellsThatStandForThemDoNotMatter3D) { ask_both<3>(74, 8); }

}  // namespace
}  // namespace cellwalk
