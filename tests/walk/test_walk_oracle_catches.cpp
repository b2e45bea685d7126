// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle must catch walks that are wrong: rounded signs, and an exact rule broken on purpose.
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/walk_impl.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "walk/oracle_trial.h"

namespace cellwalk::oracle {
namespace {

constexpr std::size_t motions = 12'000;

/// Exact signs, but where the line meets a ridge exactly, it counts as inside the facet: the exit rule
/// without its second half. The policy knows a test of the line by its first two points.
template <int D>
struct Zero_counts_as_inside {
  static constexpr bool is_exact = false;  // so that endless walks are cut off
  static constexpr bool uses_certificates = false;
  static constexpr const char* name = "zero counts as inside";

  static inline Point<D> from, to;

  template <class... P>
  static int orientation(Predicate_counts& counts, const Point<D>& p, const Point<D>& q, const P&... points) {
    const int sign = Exact::orientation(counts, p, q, points...);
    return sign == 0 && p == from && q == to ? 1 : sign;
  }
};

std::size_t count(const Tally& tally, Verdict verdict) { return tally.verdicts[static_cast<int>(verdict)]; }

template <int D>
Tally trial(const Walker_under_test<D>& walker, std::function<void(Cell_soup<D>&)> tamper = {}) {
  const Tally tally = run_trial<D>({walker}, {.motions = motions, .seed = 5'000'000, .tamper = tamper});
  std::cout << walker.name << ", " << D << "D: " << tally.wrong() << " of " << tally.walks()
            << " walks wrong\n"
            << tally.summary() << '\n';
  return tally;
}

template <int D>
void expect_rounded_signs_are_caught() {
  for (const Walk_strategy strategy : {Walk_strategy::exit_rule, Walk_strategy::predictive_simplex}) {
    const Tally in_double = trial<D>(walker<Double, D>(
        strategy, strategy == Walk_strategy::exit_rule ? "exit rule" : "predictive simplex"));
    EXPECT_GT(in_double.wrong(), motions / 1000);
    EXPECT_GT(count(in_double, Verdict::missed_wall), 0u);
    const Tally in_float = trial<D>(walker<Float, D>(
        strategy, strategy == Walk_strategy::exit_rule ? "exit rule" : "predictive simplex"));
    EXPECT_GT(in_float.wrong(), motions / 100);
    EXPECT_GT(count(in_float, Verdict::missed_wall), 0u);
    EXPECT_GT(count(in_float, Verdict::false_contact), 0u);
    EXPECT_GT(count(in_float, Verdict::lost), 0u);
  }
}

TEST(WalkOracleCatches, RoundedSigns2) { expect_rounded_signs_are_caught<2>(); }
TEST(WalkOracleCatches, RoundedSigns3) { expect_rounded_signs_are_caught<3>(); }

template <int D>
Tally walk_by_broken_rule() {
  using Broken = Zero_counts_as_inside<D>;
  Walker_under_test<D> walker = oracle::walker<Broken, D>(Walk_strategy::exit_rule, "broken");
  return trial<D>({walker.name, [walker](const Snapshot<D>& snapshot, const Particle<D>& particle,
                                         const Point<D>& target, std::vector<Cell>& visited) {
                     Broken::from = particle.position;
                     Broken::to = target;
                     return walker.walk(snapshot, particle, target, visited);
                   }});
}

TEST(WalkOracleCatches, ZeroCountedAsInside2) {
  // In the plane the two ends of an edge have opposite signs, so that a zero counts as inside at one of them
  // only.
  const Tally tally = walk_by_broken_rule<2>();
  EXPECT_GT(tally.wrong(), motions / 100);
  EXPECT_GT(count(tally, Verdict::false_contact), 0u);
  EXPECT_GT(count(tally, Verdict::lost), 0u);
}

TEST(WalkOracleCatches, ZeroCountedAsInside3) {
  const Tally tally = walk_by_broken_rule<3>();
  EXPECT_GT(tally.wrong(), motions / 100);
  EXPECT_GT(count(tally, Verdict::false_contact), motions / 1000);
  EXPECT_GT(count(tally, Verdict::wrong_cell), motions / 1000);
  EXPECT_GT(count(tally, Verdict::illegal_way), motions / 1000);
}

template <int D>
void expect_wrong_walls_are_caught() {
  const auto exact = walker<Exact, D>(Walk_strategy::certified, "in a world with walls forgotten or made up");
  const Tally forgotten = trial<D>(
      exact, [](Cell_soup<D>& soup) { std::fill(soup.impassable.begin(), soup.impassable.end(), 0); });
  EXPECT_GT(count(forgotten, Verdict::missed_wall), motions / 1000);
  const Tally made_up = trial<D>(exact, [](Cell_soup<D>& soup) {
    for (std::size_t f = 0; f < soup.facet_count(); f += 10) soup.impassable[f] = 1;
  });
  EXPECT_GT(count(made_up, Verdict::false_contact), motions / 1000);
  EXPECT_EQ(count(made_up, Verdict::missed_wall), 0u);
}

TEST(WalkOracleCatches, WrongWalls2) { expect_wrong_walls_are_caught<2>(); }
TEST(WalkOracleCatches, WrongWalls3) { expect_wrong_walls_are_caught<3>(); }

}  // namespace
}  // namespace cellwalk::oracle
