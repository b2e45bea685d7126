// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions whose sides of walls are not given are free if they are on some: judged by all combinations of
// sides of their ends, of walls in the line of the edge, and of walls on the way.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "edge/membrane_lattice.h"
#include "edge/sides_oracle.h"
#include "oracle/seed.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Query_sides_seen {
  int sweeps = 0, free = 0, blocked = 0, outside = 0;
  int several = 0, some_free = 0;  ///< ways; free ones among others
  int moves = 0, moves_blocked = 0, moves_either = 0;
};

template <int D>
class Query_trial {
 public:
  Query_trial(std::uint64_t seed, Query_sides_seen& seen)
      : seen_(seen),
        random_(seed),
        soup_(Membrane_lattice<D>::soup(random_)),
        table_(oracle::make_facet_table(soup_)),
        snapshot_(Snapshot<D>::compile(soup_, glue(soup_))),
        locator_(snapshot_),
        oracle_(soup_),
        chains_(soup_) {}

  void try_motion() {
    const Point<D> p = Membrane_lattice<D>::point(random_), t = Membrane_lattice<D>::near(p, random_),
                   q = Membrane_lattice<D>::near(random_.chance(0.5) ? p : t, random_);
    std::string text = "sweep p";
    for (const auto& x : {p, t, q})
      for (const double c : x) text += ' ' + std::to_string(c);
    SCOPED_TRACE(text);
    if (p == t) return;
    try_move(p, t);
    try_sweep(p, t, q);
  }

 private:
  void try_move(const Point<D>& a, const Point<D>& b) {
    const oracle::Trace trace = oracle_.trace(a, b);
    bool is_free = false, is_either = false;
    int latest = 0;
    for (const auto& visit : trace.visits) {
      if (visit.first != 0 || visit.solid) continue;
      const oracle::Truth truth = oracle::judge(trace, visit.cell);
      is_free |= !truth.arrivals.empty();
      is_either |= !truth.arrivals.empty() && !truth.stops.empty();
      if (!truth.stops.empty()) latest = std::max(latest, truth.stops.back().event);
    }
    const Answer<D> answer = answer_move(snapshot_, locator_, a, b, {}, counts_);
    ASSERT_EQ(answer.status == Motion_status::free, is_free);
    if (answer.contact) {
      ASSERT_TRUE(oracle::is_within_4_ulp(answer.contact->time, trace.events[latest]));
    }
    ++seen_.moves;
    seen_.moves_blocked += !is_free;
    seen_.moves_either += is_either;
  }

  void try_sweep(const Point<D>& p, const Point<D>& t, const Point<D>& q) {
    const auto truth = oracle::judge_edge<D>(oracle_, chains_, table_, p, t, q);
    const Answer<D> answer = answer_sweep<D>(snapshot_, locator_, {p, t, q}, {}, counts_);
    ++seen_.sweeps;
    if (!truth) {
      ++seen_.outside;
      ASSERT_EQ(answer.status, Motion_status::outside);
      return;
    }
    const auto expected = truth->is_free() ? Motion_status::free : Motion_status::contact;
    ASSERT_EQ(answer.status, expected) << "ways " << truth->ways << ", free " << truth->free_ways;
    if (answer.contact) {
      ASSERT_TRUE(truth->is_time(answer.contact->time)) << answer.contact->time;
    }
    ++(truth->is_free() ? seen_.free : seen_.blocked);
    seen_.several += truth->ways > 1;
    seen_.some_free += truth->is_free() && truth->free_ways < truth->ways;
    // What checks less is not blocked by more.
    if (truth->is_free()) {
      const Answer<D> segments =
          answer_sweep<D>(snapshot_, locator_, {p, t, q}, {.sweep = Sweep::three_segments}, counts_);
      ASSERT_EQ(segments.status, Motion_status::free) << "three segments";
    }
    for (const Contact_search method : {Contact_search::dichotomic, Contact_search::exhaustive}) {
      const Search_options search{method};
      const Answer<D> other = answer_sweep<D>(snapshot_, locator_, {p, t, q}, {.search = &search}, counts_);
      ASSERT_EQ(other.status, expected) << "search " << static_cast<int>(method);
    }
  }

  Query_sides_seen& seen_;
  Random random_;
  const Cell_soup<D> soup_;
  const oracle::Facet_table table_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const oracle::Oracle<D> oracle_;
  const oracle::Chain_oracle<D> chains_;
  Edge_counts counts_;
};

template <int D>
void test_queries() {
  Query_sides_seen seen;
  const std::size_t worlds = oracle::scaled_count(D == 2 ? 100 : 40);
  for (std::uint64_t i = 0; i < worlds; ++i) {
    SCOPED_TRACE("world " + std::to_string(i));
    Query_trial<D> trial(oracle::reseeded(i), seen);
    for (int n = 0; n < 40; ++n) {
      trial.try_motion();
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  std::cout << D << "D: sweeps " << seen.sweeps << ", free " << seen.free << ", blocked " << seen.blocked
            << ", outside " << seen.outside << ", several ways " << seen.several << ", some of them free "
            << seen.some_free << "; moves " << seen.moves << ", blocked " << seen.moves_blocked << ", either "
            << seen.moves_either << "\n";
  if (worlds < (D == 2 ? 100 : 40)) return;  // too few to meet everything
  EXPECT_GT(seen.free, 300);
  EXPECT_GT(seen.blocked, 100);
  EXPECT_GT(seen.some_free, 50);
  EXPECT_GT(seen.moves_either, D == 2 ? 5 : 0);
}

TEST(QuerySides, AreThoseOnWhichTheMotionGetsFurthest2) { test_queries<2>(); }
TEST(QuerySides, AreThoseOnWhichTheMotionGetsFurthest3) { test_queries<3>(); }

}  // namespace
}  // namespace cellwalk::test
