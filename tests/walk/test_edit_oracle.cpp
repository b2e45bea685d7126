// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments after many edits, judged by the oracle: they are certified, equal to what compiling them from
// scratch gives, and walks in them are right. Particles left in cells that are gone are refused.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/strategy.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "environment/snapshot_checks.h"
#include "oracle/seed.h"
#include "walk/edited_worlds.h"
#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"
#include "walk/walk_judge.h"

namespace cellwalk::oracle {
namespace {

struct Edit_tally {
  std::size_t moved = 0, moves_refused = 0, loops_turned = 0;
  std::size_t toggled = 0, toggles_refused = 0, inserted = 0, gone_refused = 0;
  std::size_t walks = 0, wrong = 0, blocked = 0, arrived = 0, crossings = 0;
  std::string first_fault;
};

template <int D>
class Edited {
 public:
  Edited(std::uint64_t number, Edit_tally& tally)
      : environment_(Environment<D>::build(editable_world<D>(number), {Duplicate_vertices::refuse})),
        snapshot_(environment_.snapshot()),
        random_(reseeded(number)),
        tally_(tally) {}

  void edit() {
    switch (random_.below(6)) {
      case 0:
        toggle();
        break;
      case 1:
        insert();
        break;
      default:
        move_vertex();
    }
    ASSERT_NO_THROW(environment_.certify());
    const Cell_soup<D> soup = environment_.soup();
    ASSERT_EQ(test::facts(snapshot_), test::facts(Snapshot<D>::compile(soup, glue(soup))));
    test::expect_planes_hold(snapshot_, random_.bits());
  }

  /// Walks between points of all kinds, in the environment as it is.
  void walk_about(int motions) {
    World<D> world;
    world.name = "edited";
    world.soup = environment_.soup();
    const Oracle<D> oracle(world.soup);
    Motion_source<D> source(world, random_.bits());
    for (int i = 0; i < motions; ++i) {
      const Motion_kind kind = source.kind(i % 4 == 0);
      Case<D> motion;
      motion.from = source.start(kind);
      const Place place = oracle.place(motion.from);
      if (place.free_cells.empty()) continue;
      motion.to = source.target(kind, motion.from, motion.from);
      motion.start = place.free_cells[random_.below(place.free_cells.size())];
      motion.trace = oracle.trace(motion.from, motion.to);
      motion.truth = judge(motion.trace, motion.start);
      Particle<D> particle;
      particle.position = motion.from;
      particle.cell = snapshot_.cell(motion.start);
      particle.dimension = static_cast<std::uint16_t>(place.dimension);
      judge_one(oracle, motion, particle);
    }
  }

 private:
  void judge_one(const Oracle<D>& oracle, const Case<D>& motion, const Particle<D>& particle) {
    Walk_counts counts;
    std::vector<Cell> visited;
    Walk_options options;
    options.visited = &visited;
    const Walk_result<D> result = walk(snapshot_, particle, motion.to, counts, options);
    ++tally_.walks;
    tally_.blocked += result.status == Walk_status::contact;
    tally_.arrived += result.status == Walk_status::arrived;
    tally_.crossings += visited.size() - 1;
    const Verdict verdict = judge_walk(oracle, snapshot_, motion, result, visited);
    if (verdict == Verdict::right) return;
    if (tally_.wrong++ == 0) tally_.first_fault = std::string(name(verdict)) + ": " + describe(motion);
  }

  void toggle() {
    const Cell c = snapshot_.cell(random_.below(snapshot_.cell_count()));
    const Half_facet f = snapshot_.half_facet(c, random_.below(snapshot_.facet_count(c)));
    attempt([&] { environment_.set_impassable(f, !snapshot_.is_impassable(f)); }, tally_.toggled,
            tally_.toggles_refused);
  }

  void move_vertex() {
    const std::vector<std::uint32_t> before = first_vertices(snapshot_);
    const std::size_t moved = tally_.moved;
    for (int tries = 0; tries < 12 && tally_.moved == moved; ++tries) {
      std::uint32_t point = 0;
      const Point<D> target = new_place(snapshot_, point, random_);
      attempt([&] { environment_.move_vertex(point, target); }, tally_.moved, tally_.moves_refused);
    }
    const std::vector<std::uint32_t> after = first_vertices(snapshot_);
    for (std::size_t f = 0; f < before.size(); ++f) tally_.loops_turned += before[f] != after[f];
  }

  /// With a particle that does not know of it.
  void insert() {
    const Cell c = snapshot_.cell(random_.below(snapshot_.cell_count()));
    Particle<D> left;
    left.position = middle_of(snapshot_, c);
    left.cell = c;
    left.dimension = D;
    std::size_t refused = 0;
    attempt([&] { environment_.insert_point(c, left.position); }, tally_.inserted, refused);
    if (refused) return;
    Walk_counts counts;
    for (std::uint32_t p = 0; p < snapshot_.points().size(); ++p) {
      EXPECT_FALSE(detail::certainly_inside(snapshot_, c, snapshot_.point(p), counts));
      EXPECT_EQ(detail::certain_end(snapshot_, left, snapshot_.point(p), counts), Cell::none);
    }
    for (const Point<D>& target : {left.position, snapshot_.point(0), Point<D>{1e3, 1e3}}) {
      Particle<D> particle = left;
      try {
        move(snapshot_, particle, target, counts);
        ADD_FAILURE() << "moved from a cell that is gone";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Error_code::usage);
        ++tally_.gone_refused;
      }
      EXPECT_EQ(particle.position, left.position);
    }
  }

  template <class F>
  void attempt(const F& edit, std::size_t& done, std::size_t& refused) {
    const std::uint64_t epoch = snapshot_.epoch();
    try {
      edit();
      ++done;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::not_certified) << error.what();
      EXPECT_EQ(snapshot_.epoch(), epoch);
      ++refused;
    }
  }

  Environment<D> environment_;
  const Snapshot<D>& snapshot_;
  Random random_;
  Edit_tally& tally_;
};

template <int D>
Edit_tally edit_worlds(std::size_t worlds) {
  Edit_tally tally;
  for (std::uint64_t i = 1; i <= worlds; ++i) {
    SCOPED_TRACE(i);
    Edited<D> world(i, tally);
    for (int round = 0; round < 40; ++round) {
      world.edit();
      if (testing::Test::HasFatalFailure()) return tally;
      world.walk_about(20);
    }
  }
  std::cout << D << "D: " << tally.moved << " vertices moved, " << tally.moves_refused << " not; "
            << tally.loops_turned << " loops turned; " << tally.toggled << " facets opened or closed, "
            << tally.toggles_refused << " not; " << tally.inserted << " points inserted; " << tally.walks
            << " walks, " << tally.blocked << " blocked, " << tally.arrived << " arrived, " << tally.crossings
            << " crossings, " << tally.wrong << " wrong\n";
  EXPECT_EQ(tally.wrong, 0u) << tally.first_fault;
  EXPECT_GT(tally.moved, 4 * worlds);
  EXPECT_GT(tally.moves_refused, worlds);
  EXPECT_GT(tally.toggled, worlds);
  EXPECT_GT(tally.toggles_refused, worlds / 4);
  EXPECT_GT(tally.inserted, worlds);
  EXPECT_EQ(tally.gone_refused, 3 * tally.inserted);
  EXPECT_GT(tally.walks, 300 * worlds);
  EXPECT_GT(tally.blocked, 50 * worlds);
  EXPECT_GT(tally.arrived, 50 * worlds);
  EXPECT_GT(tally.crossings, 50 * worlds);
  return tally;
}

TEST(EditOracle, AWallIsMetWhoseVerticesCameToLieOnOneLine) {
  // A pyramid, a corner of whose base goes to the middle of the base.
  Cell_soup<3> soup;
  soup.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 3}};
  add_pyramid(soup, {0, 1, 2, 3, 4});
  for (std::uint32_t v = 0; v < 4; ++v) {
    Environment<3> environment = Environment<3>::build(soup);
    const Snapshot<3>& snapshot = environment.snapshot();
    environment.move_vertex(v, {2, 2, 0});
    Particle<3> particle;
    particle.position = {2.5, 2.5, 0.25};
    for (int i = 0; i < 2; ++i)
      if (soup.points[v][i] == 4) particle.position[i] = 1.5;
    particle.cell = snapshot.cell(0);
    ASSERT_TRUE(in_closure(snapshot, particle.cell, particle.position));
    for (const Walk_strategy strategy : {Walk_strategy::certified, Walk_strategy::exit_rule}) {
      Walk_counts counts;
      const Point<3> below = particle.position - Vector<3>{0, 0, 5};
      const Walk_result<3> result = walk(snapshot, particle, below, counts, strategy);
      ASSERT_EQ(result.status, Walk_status::contact) << "corner " << v;
      EXPECT_EQ(result.contact->point[2], 0);
      EXPECT_EQ(result.contact->normal, (Vector<3>{0, 0, 1}));
    }
  }
}

TEST(EditOracle, WalksAreRightAfterEdits2) { edit_worlds<2>(scaled_count(30)); }
TEST(EditOracle, WalksAreRightAfterEdits3) {
  const std::size_t worlds = scaled_count(30);
  const auto loops_turned = edit_worlds<3>(worlds).loops_turned;
  if (worlds < 30) return;  // too few to meet some
  EXPECT_GT(loops_turned, worlds) << "few loops had collinear first vertices";
}

}  // namespace
}  // namespace cellwalk::oracle
