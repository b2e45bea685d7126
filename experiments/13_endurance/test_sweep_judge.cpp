// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of sweeps without a radius against the oracle of chains, and against answers that were made
// wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "edge/sweep_judge.h"
#include "membrane_judge.h"
#include "trial.h"
#include "walk/oracle_trial.h"

namespace cellwalk::endurance {
namespace {

struct Seen {
  std::size_t moves = 0, degenerate = 0, blocked = 0, by_edge = 0, choices = 0;
  std::array<std::size_t, 8> faults{};
};

template <int D, Walls walls>
class Comparison {
 public:
  Comparison(const Population& population, std::uint64_t seed)
      : draw_(seed),
        bits_(bits_of(population.grid, sweep_bits)),
        world_(random_lattice<D>(population.cut, walls, draw_),
               random_placement<D>(Placing::affine, bits_, reach_in_cells, draw_), bits_),
        oracle_(soup_of(world_.lattice, world_.place, bits_)),
        judge_(world_.lattice, bits_),
        membranes_(world_),
        sites_(world_.lattice, population.grid, bits_) {}

  void compare(std::size_t moves, Seen& seen) {
    while (moves > 0) {
      p_at_ = sites_.begin(draw_);
      q_at_ = sites_.next(p_at_, draw_);
      const auto p = particle_at(p_at_);
      const auto q = particle_at(q_at_);
      if (!p || !q) continue;
      Walk_counts counts;
      const Chain_result<D> edge = find_chain(world_.snapshot(), *p, *q, counts);
      if (edge.contact) continue;
      p_ = *p;
      q_ = *q;
      chain_ = edge.chain;
      for (int k = 0; k < 6 && moves > 0; ++k, --moves) sweep(seen);
    }
  }

 private:
  static constexpr bool with_membranes = walls == Walls::any;

  std::optional<Particle<D>> particle_at(const Site<D>& x) {
    const auto particles = world_.locator.particles_at(world_.place(x));
    if (particles.empty()) return {};
    return particles[draw_.whole(static_cast<std::uint32_t>(particles.size()))];
  }

  void sweep(Seen& seen) {
    const Snapshot<D>& snapshot = world_.snapshot();
    const Edge_sites<D> way{p_at_, sites_.next(p_at_, draw_), q_at_};
    const Point<D> target = world_.place(way.b);
    const std::uint32_t cell = snapshot.index(p_.cell);
    Walk_counts counts;
    Particle<D> to = p_;
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    const auto walked = move(snapshot, to, target, counts, {&visited, &crossed});
    const bool is_stopped = walked.status != Walk_status::arrived;
    if (is_stopped) to.position = target, to.cell = visited.back();
    const auto motion =
        test::motion_of(oracle_.soup(), snapshot, {p_, to, visited, crossed, is_stopped}, q_, chain_);
    const oracle::Outcomes outcomes = oracle_.judge(motion);
    const Edge_cells edge{cell, snapshot.index(q_.cell), &chain_};
    const std::optional<Sweep_truth> among_membranes = membranes_.judge(edge, way);
    if (with_membranes && !among_membranes) return;
    const Sweep_truth truth = with_membranes ? *among_membranes : judge_.judge(cell, way);
    if (!walked.had_choice) expect_equal(outcomes, is_stopped, truth);  // else the end may take another side
    if (!with_membranes && among_membranes) {
      EXPECT_TRUE(among_membranes->end == truth.end);  // two judges of one question
    }

    Edge_counts edge_counts;
    const Sweep_result<D> result = sweep_edge(snapshot, p_, target, q_, chain_, {}, edge_counts);
    const Sweep_fault fault = fault_of(world_, truth, way, q_, result);
    EXPECT_EQ(fault, Sweep_fault::none) << sweep_fault_names[static_cast<std::size_t>(fault)];
    if (with_membranes && truth.is_free && !result.contact) {
      EXPECT_TRUE(membranes_.is_chain_after({snapshot.index(result.p.cell), edge.q, &result.chain}, way));
    }
    seen.choices += walked.had_choice;
    ++seen.moves;
    seen.degenerate += truth.degenerate;
    seen.blocked += !truth.is_free;
    seen.by_edge += !truth.is_free && !truth.by_vertex;
    refuse(way, truth, result, seen);
    if (result.contact) return;
    p_at_ = way.b;
    p_ = result.p;
    chain_ = result.chain;
  }

  /// The oracle follows the edge until its end is stopped.
  static void expect_equal(const oracle::Outcomes& outcomes, bool is_stopped, const Sweep_truth& truth) {
    const bool edge_is_free = outcomes.may_be_free();
    EXPECT_EQ(truth.is_free, edge_is_free && !is_stopped);
    if (truth.is_free) return;
    const oracle::Share& end = edge_is_free ? outcomes.end : outcomes.blocks.back();
    EXPECT_TRUE(end == oracle::Share({truth.end.numerator, truth.end.denominator}))
        << truth.end.numerator << "/" << truth.end.denominator << " instead of " << end.numerator << "/"
        << end.denominator;
    if (edge_is_free) {
      EXPECT_TRUE(truth.by_vertex);
    }
  }

  void refuse(const Edge_sites<D>& way, const Sweep_truth& truth, const Sweep_result<D>& result, Seen& seen) {
    const auto expect_refused = [&](const Sweep_result<D>& changed) {
      const Sweep_fault fault = fault_of(world_, truth, way, q_, changed);
      EXPECT_NE(fault, Sweep_fault::none);
      ++seen.faults[static_cast<std::size_t>(fault)];
    };
    Sweep_result<D> changed = result;
    if (result.contact) {
      for (const double towards : {-1.0, 2.0}) {
        changed.contact->time = std::nextafter(result.contact->time, towards);
        expect_refused(changed);
      }
      changed = result;
      changed.contact->body =
          result.contact->body == Body_feature::vertex ? Body_feature::edge : Body_feature::vertex;
      if (!truth.may_be_by_vertex) expect_refused(changed);
      changed = result;
      changed.contact->facet = Half_facet::none;
      expect_refused(changed);
      changed.contact.reset();
      expect_refused(changed);
      return;
    }
    changed.contact = Contact<D>{};
    changed.contact->time = draw_.real();
    expect_refused(changed);
    changed = result;
    changed.p.position[0] = std::nextafter(changed.p.position[0], 1e300);
    expect_refused(changed);
    if (result.chain.empty()) return;
    changed = result;
    changed.chain.pop_back();
    expect_refused(changed);
  }

  Draw draw_;
  const int bits_;
  const World<D> world_;
  const oracle::Chain_oracle<D> oracle_;
  Sweep_judge<D> judge_;
  Membrane_judge<D> membranes_;
  Sites<D> sites_;
  Site<D> p_at_{}, q_at_{};
  Particle<D> p_{}, q_{};
  Chain chain_;
};

template <Walls walls>
void compare_all() {
  Seen seen;
  const std::size_t worlds = oracle::scaled_count(5);
  for (const Population& population : populations())
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
      SCOPED_TRACE(population.name() + ", seed " + std::to_string(seed));
      if (population.dimension == 2)
        Comparison<2, walls>(population, seed).compare(36 * population.share(), seen);
      else
        Comparison<3, walls>(population, seed).compare(36 * population.share(), seen);
    }
  std::cout << seen.moves << " moves, " << seen.degenerate << " degenerate, " << seen.blocked << " blocked, "
            << seen.by_edge << " before the end, " << seen.choices << " with a choice of the end\n";
  EXPECT_GT(seen.degenerate, seen.moves / 2);
  EXPECT_GT(seen.blocked, seen.moves / 5);
  EXPECT_GT(seen.by_edge, seen.moves / 100);
  for (std::size_t f = 1; f < seen.faults.size(); ++f) EXPECT_GT(seen.faults[f], 20u) << sweep_fault_names[f];
}

TEST(SweepJudge, AgreesWithTheOracleOfChainsAndRefusesWrongAnswers) { compare_all<Walls::solid>(); }
TEST(MembraneJudge, AgreesWithTheOracleOfChainsAndRefusesWrongAnswers) { compare_all<Walls::any>(); }

}  // namespace
}  // namespace cellwalk::endurance
