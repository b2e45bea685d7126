// SPDX-License-Identifier: LGPL-3.0-or-later
// Each certificate of a body alone, and all together, against none: the same moves, of bodies of all kinds,
// in worlds of all kinds.
#include <cellwalk/internal/environment/gluing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "body/certificate_sets.h"
#include "body/random_bodies.h"
#include "edge/thin_worlds.h"
#include "oracle/squares_and_cubes.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Certificates_seen {
  int bodies = 0, calls = 0, different = 0, invalid = 0;
  std::size_t contacts = 0, blocked = 0, refused = 0;
  std::vector<Body_counts> counts;     ///< of each set
  std::vector<std::uint64_t> decided;  ///< by each set, what is not without
  std::string first;

  void note(const std::string& what) {
    if (++different <= 5) (first += "\n  ") += what;
  }
};

/// Bodies that stand in one place, each with a set of certificates of its own.
template <int D>
class Bodies_by_sets {
 public:
  Bodies_by_sets(const std::vector<Certificate_set>& sets, const std::string& world, const Body<D>& body,
                 Certificates_seen& seen)
      : sets_(sets), world_(world), bodies_(sets.size(), body), seen_(seen) {
    for (std::size_t i = 0; i < sets.size(); ++i)
      detail::use_certificates(bodies_[i], sets[i].of_body, seen.counts[i]);
  }

  void follow(Random_bodies<D>& random, std::size_t calls) {
    for (std::size_t k = 0; k < calls; ++k) {
      const Call<D> call = random.call(bodies_[0].positions(), k);
      ++seen_.calls;
      const Answer<D> expected = ask(call, 0);
      seen_.contacts += expected.report.contacts.size();
      seen_.blocked += expected.report.blocked.size();
      seen_.refused += expected.error.has_value();
      for (std::size_t i = 1; i < sets_.size(); ++i) {
        std::string what = difference(ask(call, i), expected);
        if (what.empty() && !std::ranges::equal(bodies_[i].positions(), bodies_[0].positions()))
          what = "where it stands";
        if (!what.empty())
          return seen_.note(world_ + ", call " + std::to_string(k) + ", " + sets_[i].name + ": " + what);
      }
      if (expected.error) return;
    }
    validate();
  }

 private:
  Answer<D> ask(const Call<D>& call, std::size_t i) {
    const Certificate_set& set = sets_[i];
    Body_counts counts;
    const Answer<D> answer = call.ask(bodies_[i], set.chosen(call.options), counts);
    seen_.counts[i] += counts;
    if (i == 0) of_none_ = counts;
    const auto more = static_cast<std::int64_t>(set.counted(counts) - set.counted(of_none_));
    seen_.decided[i] += static_cast<std::uint64_t>(std::max<std::int64_t>(0, more));
    return answer;
  }

  void validate() {
    for (std::size_t i = 0; i < sets_.size(); ++i) try {
        bodies_[i].refresh(seen_.counts[i]);
        bodies_[i].validate();
      } catch (const Error& error) {
        ++seen_.invalid;
        seen_.note(world_ + ", " + sets_[i].name + ": " + error.what());
      }
  }

  const std::vector<Certificate_set>& sets_;
  const std::string world_;
  std::vector<Body<D>> bodies_;
  Body_counts of_none_;  ///< in the last call
  Certificates_seen& seen_;
};

/// Worlds that no other test has.
constexpr std::uint64_t first_world = 5'000'000 * oracle::world_kinds;
/// So that every kind comes in turn, small and large.
constexpr std::uint64_t world_stride = oracle::world_kinds + 1;

template <int D>
void run_world(std::uint64_t number, bool generic, const std::vector<Certificate_set>& sets,
               Certificates_seen& seen) {
  const oracle::World<D> world = oracle::make_world<D>(number);
  const Snapshot<D> snapshot = Snapshot<D>::compile(world.soup, glue(world.soup));
  const Locator<D> locator(snapshot);
  Random_bodies<D> random(world, snapshot, number, generic);
  constexpr std::array kinds{Body_kind::simplex,   Body_kind::simplex, Body_kind::rod,  Body_kind::simplex,
                             Body_kind::simplices, Body_kind::simplex, Body_kind::block};
  for (const Body_kind kind : kinds) {
    const Body_soup<D> soup = random.make(kind, locator);
    std::optional<Body<D>> body;
    try {
      body.emplace(snapshot, locator, soup);
    } catch (const Error&) {  // no room there
      continue;
    }
    ++seen.bodies;
    Bodies_by_sets<D>(sets, world.name, *body, seen).follow(random, 8);
  }
}

template <int D>
void test_certificates() {
  const std::vector<Certificate_set> sets = certificate_sets();
  const std::size_t worlds = oracle::scaled_count(oracle::world_kinds);
  for (const bool generic : {true, false}) {
    Certificates_seen seen;
    seen.counts.resize(sets.size());
    seen.decided.resize(sets.size());
    for (std::uint64_t number = 0; number < worlds; ++number)
      run_world<D>(first_world + world_stride * number, generic, sets, seen);
    std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.bodies << " bodies, "
              << seen.calls << " calls, " << seen.contacts << " contacts, " << seen.blocked << " blocked, "
              << seen.refused << " refused; different " << seen.different << ", invalid " << seen.invalid
              << "; decided by";
    for (std::size_t i = 1; i < sets.size(); ++i)
      std::cout << (i > 1 ? ", " : " ") << sets[i].name << " " << seen.decided[i];
    std::cout << "\n";
    EXPECT_EQ(seen.different, 0) << seen.first;
    if (worlds < oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.contacts, 1'000u);
    EXPECT_GT(seen.blocked, 100u);
    for (std::size_t i = 1; i < sets.size(); ++i) {
      SCOPED_TRACE(sets[i].name);
      const Body_counts& counts = seen.counts[i];
      EXPECT_EQ(counts.regions + counts.no_region > 0, sets[i].clearance) << "searches of regions";
      // By the rules for bodies of all kinds, few of these have regions about stars.
      if (sets[i].of_body.least_edges_a_vertex == 0 || !sets[i].of_body.clusters) {
        EXPECT_EQ(counts.region_walls > 0, sets[i].clearance && sets[i].of_body.clusters) << "clusters";
      }
      EXPECT_GT(seen.decided[i], 5u);
    }
    const Body_counts& none = seen.counts[0];
    EXPECT_EQ(none.in_region + none.edges.same_cell + none.edges.relinked, 0u);
  }
}

TEST(BodyCertificates, DecideAlikeEachAlone2) { test_certificates<2>(); }
TEST(BodyCertificates, DecideAlikeEachAlone3) { test_certificates<3>(); }

/// An edge lies along a membrane, which ends between its ends, on one side of it. A step by the paper's three
/// segments to where it stands must not put it on the other side, from which it could not leave as it came.
TEST(BodyCertificates, LeaveAnEdgeThatStandsOnItsSide2) {
  Cell_soup<2> squares = oracle::make_squares(2, 3);
  oracle::set_wall(squares, 2, 3);
  const Snapshot<2> snapshot = Snapshot<2>::compile(squares, glue(squares));
  const Locator<2> locator(snapshot);
  for (const Certificate_set& set : certificate_sets())
    for (const double beside : {0.75, 1.25}) {
      const std::vector<Point<2>> there{{1, 0.5}, {1, 2.5}}, back{{beside, 0.5}, {beside, 2.5}};
      Body<2> body(snapshot, locator, {back, {{0, 1}}, {}});
      Body_counts counts;
      detail::use_certificates(body, set.of_body, counts);
      Body_options swept = set.chosen({}), standing = swept;
      standing.rule = Step_rule::reject_at_target;
      standing.sweep.sweep = Sweep::three_segments;
      Step_report<2> report;
      body.step(there, swept, report, counts);
      body.step(there, standing, report, counts);
      body.step(back, swept, report, counts);
      EXPECT_TRUE(report.contacts.empty()) << set.name << ", beside " << beside;
    }
}

/// A wall among windows is the ceiling of a wide cell. An edge comes to windows from below. One end slides on
/// from window to window, so that the edge comes to lie on the wall: on the side that it prefers, while its
/// ends never leave their cell.
TEST(BodyCertificates, NoEdgeIsInPlaceWhereItSlidesOntoAWall3) {
  Cell_soup<3> soup = oracle::make_cubes(3, 2, 2);
  oracle::set_wall(soup, 1, 7);
  soup = merged<3>(soup, {0, 0, 0, 0, 0, 0, 6, 7, 8, 9, 10, 11});
  const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
  const Locator<3> locator(snapshot);
  std::vector<Chain> chains;
  for (const Certificate_set& set : certificate_sets()) {
    Body<3> body(snapshot, locator, {{{2.5, 1.5, 0.5}, {0.5, 1.5, 0.5}}, {{0, 1}}, {}});
    Body_counts counts;
    detail::use_certificates(body, set.of_body, counts);
    Step_report<3> report;
    for (const double y : {1.5, 0.25})
      body.step(std::vector<Point<3>>{{2.5, y, 1}, {0.5, 1.5, 1}}, set.chosen({}), report, counts);
    body.refresh(counts);
    EXPECT_TRUE(report.contacts.empty()) << set.name;
    chains.push_back(body.chain(0));
    EXPECT_EQ(chains.back(), chains.front()) << set.name;
  }
  EXPECT_FALSE(chains.front().empty());
}

/// An edge comes to the rims of a membrane from below, and slides into its plane with both ends on rims. All
/// the while its ends lie in one cell. By events it goes to the upper side, which it prefers; certificates
/// of edges, the same cell and the same chain, leave it on the lower one.
TEST(BodyCertificates, TakeTheSideThatIsPreferred3) {
  Cell_soup<3> cubes = oracle::make_cubes(3, 3, 2);
  oracle::set_wall(cubes, 4, 13);
  const Snapshot<3> snapshot = Snapshot<3>::compile(cubes, glue(cubes));
  const Locator<3> locator(snapshot);
  std::vector<Chain> chains;
  for (const Certificate_set& set : certificate_sets()) {
    Body<3> body(snapshot, locator, {{{1.25, 1.75, 0.5}, {1.25, 1.25, 0.5}}, {{0, 1}}, {}});
    Body_counts counts;
    detail::use_certificates(body, set.of_body, counts);
    Step_report<3> report;
    for (const double x : {1.0, 1.5})
      body.step(std::vector<Point<3>>{{x, 2, 1}, {1, 1.25, 1}}, set.chosen({}), report, counts);
    ASSERT_TRUE(report.contacts.empty());
    ASSERT_EQ(snapshot.index(body.cell_of(0)), 4u);
    chains.push_back(body.chain(0));
    EXPECT_EQ(chains.back(), chains.front()) << set.name;
  }
  EXPECT_FALSE(chains.front().empty());
}

}  // namespace
}  // namespace cellwalk::test
