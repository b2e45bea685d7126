// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of edges with a radius against the oracle in rationals, and against answers that were made wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "edge/thick_oracle.h"
#include "thick_judge.h"
#include "trial.h"
#include "walk/oracle_trial.h"

namespace cellwalk::endurance {
namespace {

struct Seen {
  std::size_t moves = 0, tied = 0, blocked = 0, close = 0;
  std::array<std::size_t, 8> faults{};
};

template <int D>
class Comparison {
 public:
  Comparison(const Population& population, std::uint64_t seed)
      : draw_(seed),
        bits_(bits_of(population.grid, thick_bits)),
        world_(random_lattice<D>(population.cut, Walls::few, draw_),
               random_placement<D>(Placing::similarity, bits_, reach_in_cells, draw_), bits_),
        oracle_(world_.snapshot()),
        judge_(world_.lattice, bits_),
        sites_(world_.lattice, population.grid, bits_) {}

  void compare(std::size_t moves, Seen& seen) {
    while (moves > 0) {
      Edge_sites<D> way;
      way.a = sites_.begin(draw_);
      if (!world_.locator.particle_at(world_.place(way.a))) continue;
      way.q = sites_.next(way.a, draw_);
      const Whole radius = std::max(Whole{1}, (Whole{1} << bits_) * draw_.whole(Whole{1}, Whole{4}) / 8);
      const test::Thick_motion<D> still = motion(way.a, way.a, way.q, radius);
      const bool is_free = test::root_is_at_least(oracle_.square_to_walls(test::swept(still)), still.radius);
      EXPECT_EQ(judge_.starts_free({way.a, way.a, way.q}, radius), is_free);
      seen.close += !is_free;
      if (!is_free) continue;
      for (int k = 0; k < 4 && moves > 0; ++k, --moves) {
        way.b = sites_.next(way.a, draw_);
        if (sweep(way, radius, seen)) way.a = way.b;
      }
    }
  }

 private:
  test::Thick_motion<D> motion(const Site<D>& a, const Site<D>& b, const Site<D>& q, Whole radius) const {
    return {world_.place(a), world_.place(b), world_.place(q), world_.place(radius)};
  }

  bool sweep(const Edge_sites<D>& way, Whole radius, Seen& seen) {
    const test::Thick_motion<D> m = motion(way.a, way.b, way.q, radius);
    Edge_counts counts;
    const Answer<D> answer =
        answer_sweep(world_.snapshot(), world_.locator, {m.p, m.target, m.q, m.radius}, {}, counts);
    const Thick_fault fault = judge_.fault_of(world_, way, radius, answer);
    EXPECT_EQ(fault, Thick_fault::none) << thick_fault_names[static_cast<std::size_t>(fault)];
    ++seen.moves;
    seen.tied += judge_.was_tied();
    const auto near = oracle_.nearer_than(m.radius, test::swept(m));
    EXPECT_EQ(answer.status, near.empty() ? Motion_status::free : Motion_status::contact);
    const auto expect_refused = [&](const Answer<D>& changed) {
      const Thick_fault found = judge_.fault_of(world_, way, radius, changed);
      EXPECT_NE(found, Thick_fault::none);
      ++seen.faults[static_cast<std::size_t>(found)];
    };
    Answer<D> changed = answer;
    changed.status = Motion_status::close;
    expect_refused(changed);
    changed = answer;
    if (!answer.contact) {
      changed.status = Motion_status::contact;
      changed.contact = Contact<D>{};
      for (const Half_facet half : walls()) {
        changed.contact->facet = half;
        changed.contact->time = draw_.real();
        expect_refused(changed);
      }
      return true;
    }
    ++seen.blocked;
    const double time = answer.contact->time, after = std::nextafter(time, 2.0);
    const auto is_free_until = [&](double t) {
      return test::Thick_oracle<D>::is_free_until(test::Fraction(t), m, near);
    };
    EXPECT_TRUE(is_free_until(time));
    EXPECT_FALSE(is_free_until(after));
    changed.contact->time = after;
    expect_refused(changed);
    if (time > 0) {
      changed.contact->time = std::nextafter(time, 0.0);
      expect_refused(changed);
    }
    changed = answer;
    changed.status = Motion_status::free;
    expect_refused(changed);
    changed = answer;
    changed.contact->point = changed.contact->point + m.radius / 64 * answer.contact->normal;
    expect_refused(changed);
    return false;
  }

  /// The walls of some cell.
  std::vector<Half_facet> walls() {
    std::vector<Half_facet> found;
    const Cell cell =
        world_.snapshot().cell(draw_.whole(static_cast<std::uint32_t>(world_.lattice.cell_count())));
    for (std::size_t i = 0; i < world_.lattice.sides_of_cell(); ++i)
      if (const Half_facet f = Snapshot<D>::half_facet(cell, i); world_.snapshot().is_impassable(f))
        found.push_back(f);
    return found;
  }

  Draw draw_;
  const int bits_;
  const World<D> world_;
  const test::Thick_oracle<D> oracle_;
  Thick_judge<D> judge_;
  Sites<D> sites_;
};

TEST(ThickJudge, AgreesWithTheOracleAndRefusesWrongAnswers) {
  Seen seen;
  const std::size_t worlds = oracle::scaled_count(3);
  for (const Population& population : populations())
    for (std::uint64_t seed = 0; seed < worlds; ++seed) {
      SCOPED_TRACE(population.name() + ", seed " + std::to_string(seed));
      if (population.dimension == 2)
        Comparison<2>(population, seed).compare(12 * population.share(), seen);
      else
        Comparison<3>(population, seed).compare(12 * population.share(), seen);
    }
  std::cout << seen.moves << " moves, " << seen.tied << " at the radius, " << seen.blocked << " blocked, "
            << seen.close << " starts refused\n";
  EXPECT_GT(seen.tied, seen.moves / 8);
  EXPECT_GT(seen.blocked, seen.moves / 8);
  for (std::size_t f = 1; f < seen.faults.size(); ++f) EXPECT_GT(seen.faults[f], 3u) << thick_fault_names[f];
}

}  // namespace
}  // namespace cellwalk::endurance
