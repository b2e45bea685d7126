// SPDX-License-Identifier: LGPL-3.0-or-later
// What a body was asked before must not show in what it answers now: sweeps, policies, regions free of walls,
// registering and checking in any order, and edits of the environment between, against the same moves without
// regions, registered after each, and against a body made anew where it stands.
#include <cellwalk/environment/environment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>

#include "body/random_bodies.h"
#include "body/random_edits.h"
#include "body/with_regions.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Interleaved_seen {
  int bodies = 0, calls = 0, threw = 0, made_anew = 0, different = 0, invalid = 0;
  int by_segments = 0, by_faces = 0, by_rule = 0, single = 0, stopping = 0;
  int edits = 0, taken_back = 0;
  std::size_t contacts = 0, blocked = 0, most_vertices = 0;
  std::string first;
  Body_counts counts, plain_counts;

  void note(const std::string& what) {
    if (++different <= 5) (first += "\n  ") += what;
  }
};

template <int D>
class Interleaving {
 public:
  Interleaving(std::uint64_t number, bool generic, Body_kind kind, Interleaved_seen& seen)
      : world_(oracle::make_world<D>(number)),
        environment_(Environment<D>::build(world_.soup, {Duplicate_vertices::keep, false})),
        snapshot_(environment_.snapshot()),
        locator_(snapshot_),
        random_bodies_(world_, snapshot_, number, generic),
        kind_(kind),
        seen_(seen) {}

  void run(int bodies, int calls) {
    for (int k = 0; k < bodies; ++k) {
      const Body_soup<D> soup = random_bodies_.make(kind_, locator_);
      std::optional<Body<D>> body;
      try {
        body.emplace(snapshot_, locator_, soup);
      } catch (const Error&) {  // no room there
        continue;
      }
      have_regions(*body);
      ++seen_.bodies;
      seen_.most_vertices = std::max(seen_.most_vertices, soup.points.size());
      follow(*body, calls);
    }
  }

 private:
  Random& random() { return random_bodies_.random(); }

  void follow(Body<D>& body, int calls) {
    Body<D> plain = body;
    for (int k = 0; k < calls; ++k) {
      const Call<D> call = random_bodies_.call(body.positions(), static_cast<std::size_t>(seen_.calls));
      Body_options without = call.options, here = call.options;
      without.clearance = false;
      here.clearance = random().below(4) > 0;
      ++seen_.calls;
      const Sweep_options& sweep = call.options.sweep;
      seen_.by_segments += sweep.sweep == Sweep::three_segments;
      seen_.by_faces += D == 3 && sweep.sweep == Sweep::faces;
      seen_.by_rule += call.kind == Call<D>::Kind::step_at_target;
      seen_.single += call.kind == Call<D>::Kind::move_vertex;
      seen_.stopping += sweep.touch == Touch::stop;
      std::optional<Body<D>> anew = made_anew(body);
      const Answer<D> answer = call.ask(body, here, seen_.counts);
      const Answer<D> expected = call.ask(plain, without, seen_.plain_counts);
      seen_.contacts += expected.report.contacts.size();
      seen_.blocked += expected.report.blocked.size();
      seen_.threw += expected.error.has_value();
      const std::string name = world_.name + ", call " + std::to_string(k) + ": ";
      std::string what = difference(answer, expected);
      if (what.empty() && !std::ranges::equal(body.positions(), plain.positions())) what = "where it stands";
      if (!what.empty()) return seen_.note(name + what);
      if (anew && sweep.sweep != Sweep::faces) {
        ++seen_.made_anew;
        what = difference(call.ask(*anew, here, seen_.counts), expected);
        if (what.empty() && !std::ranges::equal(anew->positions(), plain.positions()))
          what = "where it stands";
        if (!what.empty()) return seen_.note(name + what + ", made anew");
      }
      if (expected.error) return;
      if (!disturb(body, name) || !check(plain, name) || !edit(body, plain, name)) return;
    }
  }

  /// What must change nothing.
  bool disturb(Body<D>& body, const std::string& name) {
    switch (random().below(6)) {
      case 0:
        body.refresh(seen_.counts);
        break;
      case 1:
        body.leave_region(seen_.counts);
        break;
      case 2:
        return check(body, name);
      case 3: {
        const Body<D> copy = body;
        body = copy;
        break;
      }
      default:
        break;
    }
    return true;
  }

  bool check(Body<D>& body, const std::string& name) {
    body.refresh(seen_.counts);
    try {
      body.validate();
    } catch (const Error& error) {
      ++seen_.invalid;
      seen_.note(name + error.what());
      return false;
    }
    return true;
  }

  /// Edits the environment near the body now and then. An edit that puts a wall into it is taken back. False
  /// if the body cannot go on.
  bool edit(Body<D>& body, Body<D>& plain, const std::string& name) {
    if (random().below(5) > 0) return true;
    const auto vertex = static_cast<std::uint32_t>(random().below(body.vertex_count()));
    const Cell near = body.cell_of(vertex);
    const auto undo = edit_near(environment_, near, random(), random_bodies_.is_generic());
    if (!undo) return true;
    ++seen_.edits;
    const bool has_room = register_again(body);
    // Where a vertex lies between cells, they may have it in different ones.
    if (random_bodies_.is_generic() && register_again(plain) != has_room) {
      seen_.note(name + "one body is registered after an edit, the other is not");
      return false;
    }
    if (!has_room) {
      ++seen_.taken_back;
      (*undo)();
      // It stands where it stood; but walls that it did not sweep with its faces may pierce them.
      if (!register_again(body)) {
        if (body.faces().empty()) seen_.note(name + "it has no room where it stood");
        return false;
      }
    }
    plain = body;
    return true;
  }

  bool register_again(Body<D>& body) {
    locator_ = Locator<D>(snapshot_);
    try {
      body.register_again(locator_);
    } catch (const Error&) {
      return false;
    }
    return true;
  }

  /// A body without faces that is registered where this one stands; in general position only, where there is
  /// one way to do it.
  std::optional<Body<D>> made_anew(const Body<D>& body) {
    if (!random_bodies_.is_generic() || random().below(3) > 0) return {};
    Body_soup<D> soup;
    soup.points.assign(body.positions().begin(), body.positions().end());
    soup.edges.assign(body.edges().begin(), body.edges().end());
    for (const Point<D>& x : soup.points)
      if (locator_.locate(x).dimension != D) return {};  // it stopped at a wall
    Body<D> anew(snapshot_, locator_, soup);
    have_regions(anew);
    return anew;
  }

  const oracle::World<D> world_;
  Environment<D> environment_;
  const Snapshot<D>& snapshot_;
  Locator<D> locator_;
  Random_bodies<D> random_bodies_;
  const Body_kind kind_;
  Interleaved_seen& seen_;
};

/// Worlds that no other test has.
constexpr std::uint64_t first_interleaved_world = 3'000'000 * oracle::world_kinds;

template <int D>
void test_interleaved(Body_kind kind) {
  const std::size_t worlds = oracle::scaled_count(4 * oracle::world_kinds);
  const bool is_simplex = kind == Body_kind::simplex;
  for (const bool generic : {true, false}) {
    Interleaved_seen seen;
    for (std::uint64_t number = 0; number < worlds; ++number)
      Interleaving<D>(first_interleaved_world + number, generic, kind, seen).run(is_simplex ? 14 : 2, 16);
    std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.bodies << " bodies, "
              << seen.calls << " calls (" << seen.by_segments << " by three segments, " << seen.by_faces
              << " by faces, " << seen.by_rule << " with edges at their targets, " << seen.single
              << " of one vertex, " << seen.stopping << " that stop at touches), " << seen.contacts
              << " contacts, " << seen.blocked << " blocked; in regions " << seen.counts.in_region << " of "
              << seen.counts.moves << " moves, caught up " << seen.counts.catch_ups << "; made anew "
              << seen.made_anew << ", refused " << seen.threw << "; edits " << seen.edits << ", taken back "
              << seen.taken_back << "; different " << seen.different << ", invalid " << seen.invalid << "\n";
    EXPECT_EQ(seen.different, 0) << seen.first;
    if (worlds < 4 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.bodies, is_simplex ? 100 : 30);
    EXPECT_GT(seen.contacts, 1'000u);
    EXPECT_GT(seen.blocked, 300u);
    EXPECT_GT(seen.stopping, 100);
    EXPECT_GT(seen.edits, 50);
    EXPECT_GT(seen.counts.in_region, 200u);
    EXPECT_GT(seen.counts.catch_ups, 100u);
    EXPECT_EQ(seen.most_vertices > 32, !is_simplex);
    if (generic && is_simplex) {
      EXPECT_GT(seen.made_anew, 100);
    }
  }
}

TEST(BodyInterleaved, NothingAskedBeforeShows2) { test_interleaved<2>(Body_kind::simplex); }
TEST(BodyInterleaved, NothingAskedBeforeShows3) { test_interleaved<3>(Body_kind::simplex); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfManyParts2) { test_interleaved<2>(Body_kind::simplices); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfManyParts3) { test_interleaved<3>(Body_kind::simplices); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfRods2) { test_interleaved<2>(Body_kind::rod); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfRods3) { test_interleaved<3>(Body_kind::rod); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfBlocks2) { test_interleaved<2>(Body_kind::block); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfBlocks3) { test_interleaved<3>(Body_kind::block); }

}  // namespace
}  // namespace cellwalk::test
