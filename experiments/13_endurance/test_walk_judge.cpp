// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of walks against the slow oracle, and against answers that were made wrong.
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/repro_file.h>
#include <cellwalk/io/mesh_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

#include "trial.h"
#include "walk/oracle_trial.h"
#include "walk/walk_judge.h"
#include "walk_judge.h"
#include "wrong.h"

namespace cellwalk::endurance {
namespace {

struct Seen {
  std::size_t motions = 0, degenerate = 0, blocked = 0, choices = 0, refused = 0;
  std::array<std::size_t, 8> faults{};
};

template <int D>
class Comparison {
 public:
  Comparison(const Population& population, std::uint64_t seed)
      : draw_(seed),
        bits_(bits_of(population.grid, walk_bits)),
        world_(random_lattice<D>(population.cut, Walls::any, draw_),
               random_placement<D>(Placing::affine, bits_, reach_in_cells, draw_), bits_),
        oracle_(soup_of(world_.lattice, world_.place, bits_)),
        judge_(world_.lattice, bits_),
        sites_(world_.lattice, population.grid, bits_) {}

  void compare(std::size_t motions, Seen& seen) {
    for (std::size_t k = 0; k < motions;) {
      Site<D> at = sites_.begin(draw_);
      auto particles = world_.locator.particles_at(world_.place(at));
      if (particles.empty()) continue;
      Particle<D> particle = particles[draw_.whole(static_cast<std::uint32_t>(particles.size()))];
      for (const std::size_t end = std::min(motions, k + 8); k < end; ++k) at = walk(particle, at, seen);
    }
  }

 private:
  Site<D> walk(Particle<D>& particle, const Site<D>& at, Seen& seen) {
    Walk_motion<D> motion{
        at, sites_.next(at, draw_), particle.position, {}, world_.snapshot().index(particle.cell)};
    motion.to = world_.place(motion.b);
    oracle::Case<D> slow;
    slow.from = motion.from;
    slow.to = motion.to;
    slow.start = motion.cell;
    slow.trace = oracle_.trace(motion.from, motion.to);
    slow.truth = oracle::judge(slow.trace, slow.start);
    const Walk_truth truth = judge_.follow(motion.cell, motion.a, motion.b);
    expect_equal(slow, truth);

    std::vector<Cell> visited;
    Walk_counts counts;
    const Walk_result<D> result = move(world_.snapshot(), particle, motion.to, counts, {&visited});
    EXPECT_EQ(judge_walk(oracle_, world_.snapshot(), slow, result, visited), oracle::Verdict::right);
    EXPECT_EQ(fault_of(world_, judge_, truth, motion, result), Walk_fault::none);
    ++seen.motions;
    seen.degenerate += truth.degenerate;
    seen.blocked += !truth.arrives;
    seen.choices += slow.truth.choices > 0;
    refuse(motion, slow, result, seen);
    return result.status == Walk_status::arrived ? motion.b : at;
  }

  void expect_equal(const oracle::Case<D>& slow, const Walk_truth& truth) {
    std::vector<std::uint32_t> ends(judge_.ends().begin(), judge_.ends().end()), expected;
    ASSERT_EQ(truth.arrives, !slow.truth.arrivals.empty()) << describe(slow);
    EXPECT_EQ(truth.has_choice, slow.truth.choices > 0) << describe(slow);
    int dimension = 0;
    if (truth.arrives) {
      expected = slow.truth.arrivals;
      dimension =
          slow.trace.visits[static_cast<std::size_t>(slow.trace.visit_of(expected[0]))].dimension_at_last;
    } else {
      const oracle::Stop& last = slow.truth.stops.back();
      for (const oracle::Stop& s : slow.truth.stops)
        if (s.event == last.event) expected.push_back(s.cell);
      dimension = last.dimension;
      const auto& time = slow.trace.events[static_cast<std::size_t>(last.event)];
      EXPECT_EQ(time.numerator * truth.end.denominator, time.denominator * truth.end.numerator)
          << describe(slow);
    }
    std::sort(ends.begin(), ends.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(ends, expected) << describe(slow);
    EXPECT_EQ(truth.dimension, dimension) << describe(slow);
  }

  /// Answers with one thing changed are refused, unless the change leaves them right.
  void refuse(const Walk_motion<D>& motion, const oracle::Case<D>& slow, const Walk_result<D>& result,
              Seen& seen) {
    const auto expect_refused = [&](const Walk_result<D>& changed) {
      const Walk_truth truth = judge_.follow(motion.cell, motion.a, motion.b);
      const Walk_fault fault = fault_of(world_, judge_, truth, motion, changed);
      EXPECT_NE(fault, Walk_fault::none) << describe(slow);
      ++seen.refused;
      ++seen.faults[static_cast<std::size_t>(fault)];
    };
    Walk_result<D> changed = result;
    if (!result.contact) {
      changed.dimension = static_cast<std::uint16_t>((result.dimension + 1) % (D + 1));
      expect_refused(changed);
      changed = result;
      changed.status = Walk_status::contact;
      changed.contact = Contact<D>{};
      expect_refused(changed);
    } else {
      for (const double towards : {-1.0, 2.0}) {
        changed.contact->time = std::nextafter(result.contact->time, towards);
        expect_refused(changed);
      }
      changed = result;
      changed.contact->kind = static_cast<Contact_kind>((static_cast<int>(result.contact->kind) + 1) % 3);
      expect_refused(changed);
      changed = result;
      changed.contact->normal = -1.0 * result.contact->normal;
      expect_refused(changed);
      changed = result;
      for (double& x : changed.contact->point) x += 1e-9 * (std::abs(x) + length(motion.to - motion.from));
      if (motion.a != motion.b) expect_refused(changed);
      changed = result;
      changed.status = Walk_status::arrived;
      expect_refused(changed);
      changed = result;
      const Half_facet half = Snapshot<D>::half_facet(
          result.cell, draw_.whole(static_cast<std::uint32_t>(world_.lattice.sides_of_cell())));
      changed.contact->facet = half;
      if (judge_walk(oracle_, world_.snapshot(), slow, changed, {}) == oracle::Verdict::wrong_wall)
        expect_refused(changed);
    }
    changed = result;
    changed.cell =
        world_.snapshot().cell(draw_.whole(static_cast<std::uint32_t>(world_.lattice.cell_count())));
    if (changed.contact) changed.contact->cell = changed.cell;
    if (judge_walk(oracle_, world_.snapshot(), slow, changed, {}) == oracle::Verdict::wrong_cell)
      expect_refused(changed);
  }

  Draw draw_;
  const int bits_;
  const World<D> world_;
  const oracle::Oracle<D> oracle_;
  Walk_judge<D> judge_;
  Sites<D> sites_;
};

TEST(WalkJudge, AgreesWithTheOracleAndRefusesWrongAnswers) {
  Seen seen;
  const std::size_t worlds = oracle::scaled_count(8);
  for (const Population& population : populations())
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
      SCOPED_TRACE(population.name() + ", seed " + std::to_string(seed));
      if (population.dimension == 2)
        Comparison<2>(population, seed).compare(120 * population.share(), seen);
      else
        Comparison<3>(population, seed).compare(120 * population.share(), seen);
    }
  std::cout << seen.motions << " motions, " << seen.degenerate << " degenerate, " << seen.blocked
            << " blocked, " << seen.choices << " with a choice; " << seen.refused
            << " wrong answers refused\n";
  EXPECT_GT(seen.degenerate, seen.motions / 2);
  EXPECT_GT(seen.blocked, seen.motions / 5);
  EXPECT_GT(seen.choices, seen.motions / 400);
  for (std::size_t f = 1; f < seen.faults.size(); ++f) EXPECT_GT(seen.faults[f], 20u) << walk_fault_names[f];
}

TEST(WrongAnswers, AreKeptWithTheirWorlds) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "endurance_wrong";
  std::filesystem::remove_all(folder);
  const Trial trial{{3, Cut::simplices, Grid::fine}, 7, 1, folder};
  Draw draw(trial.seed);
  const World<3> world(random_lattice<3>(Cut::simplices, Walls::any, draw),
                       random_placement<3>(Placing::affine, walk_bits, reach_in_cells, draw), walk_bits);
  Sites<3> sites(world.lattice, Grid::fine, walk_bits);
  Walk_motion<3> motion{sites.begin(draw), sites.begin(draw), {}, {}, 5};
  motion.from = world.place(motion.a);
  motion.to = world.place(motion.b);
  keep_walk(trial, world, motion, "made up");
  const auto read =
      std::get<Repro<3>>(io::read_repro(folder / "walk_3D_simplices_fine_0000000000000007.json"));
  EXPECT_EQ(read.from, motion.from);
  EXPECT_EQ(read.to, motion.to);
  EXPECT_EQ(read.cell, 5u);
  EXPECT_EQ(read.soup.points, soup_of(world.lattice, world.place, world.bits).points);

  keep_sweep(trial, world, {motion.a, motion.b, motion.a}, 0.25, "made up");
  const std::filesystem::path path = folder / "thick_3D_simplices_fine_0000000000000007";
  const auto mesh = io::read_mesh(std::filesystem::path(path).replace_extension(".ovm"));
  EXPECT_EQ(std::get<Cell_soup<3>>(mesh.mesh).impassable, read.soup.impassable);
  const auto table = io::Csv_table::read(std::filesystem::path(path).replace_extension(".csv"));
  EXPECT_EQ(table.number(0, table.column("ty")).value, motion.to[1]);
  EXPECT_EQ(table.number(0, table.column("radius")).value, 0.25);
  std::filesystem::remove_all(folder);
}

TEST(WalkJudge, RoundsTimesDown) {
  EXPECT_TRUE(is_rounded(0, {0, 7}));
  EXPECT_TRUE(is_rounded(0.5, {3, 6}));
  EXPECT_FALSE(is_rounded(std::nextafter(0.5, 0), {3, 6}));
  EXPECT_FALSE(is_rounded(std::nextafter(0.5, 1), {3, 6}));
  const double third = 1.0 / 3;  // rounded down
  EXPECT_TRUE(is_rounded(third, {1, 3}));
  EXPECT_FALSE(is_rounded(std::nextafter(third, 1), {1, 3}));
  EXPECT_FALSE(is_rounded(std::nextafter(third, 0), {1, 3}));
  const Whole large = (Whole{1} << 61) - 1;
  EXPECT_TRUE(is_rounded(0x1p-61, {1, large}));
  EXPECT_FALSE(is_rounded(0x1p-62, {1, large}));
  EXPECT_FALSE(is_rounded(0x1p-1000, {1, large}));
  EXPECT_TRUE(is_rounded(std::nextafter(1.0, 0.0), {large - 1, large}));
  EXPECT_FALSE(is_rounded(1, {large - 1, large}));
}

}  // namespace
}  // namespace cellwalk::endurance
