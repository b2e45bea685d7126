// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains in place, and chains led round ridges: what is found free must be free for the oracle that follows
// the definition of chains, with a chain that it accepts, and for the exact sweep, with an equal one.
#include <cellwalk/internal/edge/edge_contact.h>
#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/walk/signs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "edge/edge_worlds.h"
#include "edge/sweep_judge.h"
#include "edge/thin_worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

using detail::Facet_corners;
using detail::Relink_answer;

struct Relinks_seen {
  int moves = 0;           ///< in which the edge crosses facets
  int in_place = 0;        ///< it passes its word
  int relinked = 0;        ///< its word led round ridges
  int through_p = 0;       ///< p crossed facets of which some were exchanged
  int long_runs = 0;       ///< more than one facet was exchanged at a ridge
  int several_ridges = 0;  ///< facets at more than one ridge were exchanged
  int from_plane = 0;      ///< p started in the plane of a facet that was exchanged
  int blocked = 0;         ///< it meets a wall at a ridge
  int located = 0;         ///< q being inside of its cell, so that this is the only contact
  int stopped = 0;         ///< it is free until p is stopped at a wall
  int wrong = 0;           ///< for the oracle
  int not_free = 0, not_blocked = 0, unequal = 0, other_chains = 0;  ///< by the exact sweep
  std::string first;

  void note(int& count, const std::string& what) {
    ++count;
    if (std::ranges::count(first, '\n') < 5) (first += "\n  ") += what;
  }
  int all_wrong() const { return wrong + not_free + not_blocked + unequal; }
};

/// The facets that p crossed, seen from where it is, and the chain, reduced where they meet.
template <int D>
Chain word_of(const Snapshot<D>& snapshot, std::span<const Half_facet> crossed, const Chain& chain) {
  std::size_t undone = 0;
  while (undone < std::min(crossed.size(), chain.size()) && crossed[undone] == chain[undone]) ++undone;
  Chain word;
  for (std::size_t i = crossed.size(); i-- > undone;) word.push_back(snapshot.opposite(crossed[i]));
  word.insert(word.end(), chain.begin() + static_cast<std::ptrdiff_t>(undone), chain.end());
  return word;
}

template <int D>
std::vector<Facet_corners<D>> corners_of(const Snapshot<D>& snapshot, std::span<const Half_facet> facets) {
  std::vector<Facet_corners<D>> corners;
  for (const Half_facet f : facets) detail::append_corners<D>(snapshot, f, corners);
  return corners;
}

template <int D>
bool are_same(const std::vector<Facet_corners<D>>& a, const std::vector<Facet_corners<D>>& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return std::memcmp(&x.lanes, &y.lanes, sizeof(x.lanes)) == 0 && x.ignored == y.ignored &&
           x.continues == y.continues;
  });
}

/// What relinking says of an edge.
/// \param chain set to that of a free edge, as it is seen from p
template <int D>
Relink_answer relink(const Snapshot<D>& snapshot, const Moved_end<D>& moved, const Particle<D>& other,
                     const Chain& before, bool is_reversed, bool is_from_behind,
                     detail::Relink_scratch<D>& scratch, Chain& chain) {
  const Point<D>&p = moved.from.position, &t = moved.to.position, &q = other.position;
  const bool has_inner_end = (!moved.contact && moved.to.dimension == D) || other.dimension == D;
  const Half_facet wall = moved.contact ? moved.contact->facet : Half_facet::none;
  Float_point<D> mapped;
  if (!snapshot.frame().map(t, mapped)) return Relink_answer::open;
  detail::Certain_line<D> to(snapshot.frame(), t, mapped);
  to.lead_to(q, is_reversed);
  const Chain word = is_reversed ? reversed(snapshot, before) : before;
  // Bodies keep corners that were read from behind, too.
  const Chain back = reversed(snapshot, word);
  std::vector<Facet_corners<D>> its_corners;
  if (is_from_behind)
    detail::append_from_behind<D>(corners_of(snapshot, {back.data(), back.size()}), its_corners);
  else
    its_corners = corners_of(snapshot, {word.data(), word.size()});
  std::vector<Facet_corners<D>> corners;
  const Relink_answer answer = detail::relink_at_ridges<D>(snapshot,
                                                           {p,
                                                            q,
                                                            to,
                                                            is_reversed,
                                                            has_inner_end,
                                                            moved.crossed,
                                                            false,
                                                            wall,
                                                            {word.data(), word.size()},
                                                            its_corners},
                                                           scratch, chain, corners);
  if (answer == Relink_answer::free && !is_from_behind) {
    EXPECT_TRUE(are_same(corners, corners_of(snapshot, {chain.data(), chain.size()})));
  }
  if (is_reversed) chain = reversed(snapshot, chain);
  return answer;
}

/// The facets of one chain that are not in another.
Chain without(const Chain& chain, const Chain& others) {
  Chain rest;
  std::ranges::copy_if(chain, std::back_inserter(rest),
                       [&](Half_facet f) { return std::ranges::find(others, f) == others.end(); });
  return rest;
}

/// How many points all of the facets share.
template <int D>
int shared_points(const Snapshot<D>& snapshot, const Chain& facets) {
  std::vector<std::uint32_t> shared;
  for (const std::uint32_t v : snapshot.loop(facets.front())) shared.push_back(v);
  for (const Half_facet f : facets)
    std::erase_if(shared, [&](std::uint32_t v) {
      const auto loop = snapshot.loop(f);
      return std::ranges::find(loop, v) == loop.end();
    });
  return static_cast<int>(shared.size());
}

/// An edge that was moved, on which relinking is tried and judged.
template <int D>
class Relink_trial {
 public:
  Relink_trial(const Edge_world<D>& w, Relinks_seen& seen) : w_(w), oracle_(w.world.soup), seen_(seen) {}

  /// The chain after the move, if it is found so.
  std::optional<Chain> try_to_relink(const Moved_end<D>& moved, const Particle<D>& q, const Chain& before) {
    const Chain word = word_of<D>(w_.snapshot, moved.crossed, before);
    ++seen_.moves;
    Chain chain;
    const Relink_answer answer =
        relink<D>(w_.snapshot, moved, q, before, seen_.moves % 2 == 0, seen_.moves % 4 < 2, scratch_, chain);
    if (answer == Relink_answer::blocked) {
      ++seen_.blocked;
      judge_blocked(moved, q, before);
    }
    if (answer != Relink_answer::free) return {};
    if (moved.contact) {
      ++seen_.stopped;
      judge_stopped(moved, q, before);
      return {};
    }
    if (chain == word) {
      if (++seen_.in_place % judged_in_place == 0) judge(moved, q, before, chain);
      return chain;
    }
    ++seen_.relinked;
    count(moved, word, chain);
    judge(moved, q, before, chain);
    return chain;
  }

 private:
  static constexpr int judged_in_place = 16;  ///< one in so many

  void count(const Moved_end<D>& moved, const Chain& word, const Chain& chain) {
    const Chain exchanged = without(word, chain);
    if (exchanged.empty()) return;
    const bool at_one_ridge = shared_points<D>(w_.snapshot, exchanged) >= D - 1;
    seen_.long_runs += at_one_ridge && exchanged.size() > 1;
    seen_.several_ridges += !at_one_ridge;
    seen_.through_p += std::ranges::any_of(moved.crossed, [&](Half_facet f) {
      return std::ranges::find(exchanged, w_.snapshot.opposite(f)) != exchanged.end();
    });
    seen_.from_plane +=
        std::ranges::any_of(exchanged, [&](Half_facet f) { return starts_in_plane(f, moved); });
  }

  /// True if p started in the plane of a facet.
  bool starts_in_plane(Half_facet f, const Moved_end<D>& moved) const {
    Walk_counts counts;
    return detail::side<Exact>(w_.snapshot.view(w_.snapshot.cell_of(f)), w_.snapshot.facet_of(f),
                               moved.from.position, counts) == 0;
  }

  void judge(const Moved_end<D>& moved, const Particle<D>& q, const Chain& before, const Chain& chain) {
    const Vertex_path<D> path = moved.path();
    const auto motion = motion_of(w_.world.soup, w_.snapshot, path, q, before);
    const Sweep_fault fault =
        fault_of<D>(oracle_, motion, oracle_.judge(motion), w_.snapshot, Sweep_result<D>{{}, chain});
    const std::string name = w_.world.name + ": ";
    if (fault != Sweep_fault::none)
      seen_.note(seen_.wrong, name + fault_names[static_cast<std::size_t>(fault)]);
    Edge_counts counts;
    const Sweep_result<D> swept = sweep_triangle<D>(w_.snapshot, path, q, before, counts, false);
    if (swept.contact) return seen_.note(seen_.not_free, name + "the exact sweep meets a wall");
    if (swept.chain == chain) return;
    ++seen_.other_chains;
    const auto placed = [&](const Chain& x) {
      return oracle::Placed_chain{w_.snapshot.index(moved.to.cell), w_.snapshot.index(q.cell),
                                  soup_chain(w_.world.soup, w_.snapshot, x)};
    };
    if (!oracle_.are_equal(moved.to.position, q.position, placed(swept.chain), placed(chain)))
      seen_.note(seen_.unequal, name + "the exact sweep finds another chain");
  }

  /// An edge that is free until its end is stopped at a wall.
  void judge_stopped(const Moved_end<D>& moved, const Particle<D>& q, const Chain& before) {
    Edge_counts counts;
    if (sweep_triangle<D>(w_.snapshot, moved.path(), q, before, counts, false).contact)
      seen_.note(seen_.not_free, w_.world.name + ": the exact sweep meets a wall before the end is stopped");
  }

  void judge_blocked(const Moved_end<D>& moved, const Particle<D>& q, const Chain& before) {
    const Vertex_path<D> path = moved.path();
    Edge_counts counts;
    const Sweep_result<D> swept = sweep_triangle<D>(w_.snapshot, path, q, before, counts, false);
    if (!swept.contact) return seen_.note(seen_.not_blocked, w_.world.name + ": the exact sweep is free");
    if (seen_.blocked % judged_in_place == 0) judge_by_oracle(moved, q, before, swept);
    compare_contacts(moved, q, *swept.contact);
  }

  void compare_contacts(const Moved_end<D>& moved, const Particle<D>& q, const Contact<D>& by_events) {
    // From the border of a cell, the edge may meet other walls at the same time.
    if (q.dimension != D) return;
    ++seen_.located;
    const Contact<D> contact = detail::contact_at_ridge<D>(
        w_.snapshot, {moved.from.position, moved.to.position, q.position}, scratch_);
    if (is_before(contact, by_events) || is_before(by_events, contact) || contact.cell != by_events.cell ||
        contact.corner != by_events.corner)
      seen_.note(seen_.wrong, w_.world.name + ": the exact sweep finds another contact");
  }

  void judge_by_oracle(const Moved_end<D>& moved, const Particle<D>& q, const Chain& before,
                       const Sweep_result<D>& swept) {
    const auto motion = motion_of(w_.world.soup, w_.snapshot, moved.path(), q, before);
    const Sweep_fault fault = fault_of<D>(oracle_, motion, oracle_.judge(motion), w_.snapshot, swept);
    if (fault != Sweep_fault::none)
      seen_.note(seen_.wrong, w_.world.name + ": blocked, " + fault_names[static_cast<std::size_t>(fault)]);
  }

  const Edge_world<D>& w_;
  const oracle::Chain_oracle<D> oracle_;
  detail::Relink_scratch<D> scratch_;
  Relinks_seen& seen_;
};

template <int D>
void move_edges(Edge_world<D>& w, int edges, Relinks_seen& seen) {
  Relink_trial<D> trial(w, seen);
  Edge_counts counts;
  for_each_sweep(
      w, edges, counts.walk, [&](const Moved_end<D>& moved, const Particle<D>& q, const Chain& before) {
        if (moved.contact && moved.contact->kind != Contact_kind::facet) return std::optional<Chain>();
        auto chain = trial.try_to_relink(moved, q, before);
        if (chain || moved.contact) return chain;
        const Sweep_result<D> swept = sweep_triangle<D>(w.snapshot, moved.path(), q, before, counts);
        return swept.contact ? std::nullopt : std::optional<Chain>(swept.chain);
      });
}

void report(const std::string& name, const Relinks_seen& seen) {
  std::cout << name << ": " << seen.moves << " moves, in place " << seen.in_place << ", relinked "
            << seen.relinked << "; facets crossed by p exchanged " << seen.through_p << ", long runs "
            << seen.long_runs << ", several ridges " << seen.several_ridges << ", from the plane of a facet "
            << seen.from_plane << ", blocked " << seen.blocked << ", free until p is stopped " << seen.stopped
            << ", written otherwise " << seen.other_chains << "; wrong " << seen.wrong << ", not free "
            << seen.not_free << ", not blocked " << seen.not_blocked << ", unequal " << seen.unequal << "\n";
}

/// Worlds that no other test has.
constexpr std::uint64_t first_relink_world = 9'000'000 * oracle::world_kinds;

/// Lattices, oblique ones, simplices, with membranes, solid cells and slits, of sizes from 2^-20 to 2^20.
template <int D>
void test_worlds() {
  const std::size_t worlds = oracle::scaled_count(8 * oracle::world_kinds);
  for (const bool generic : {true, false}) {
    Relinks_seen seen;
    for (std::uint64_t number = 0; number < worlds; ++number) {
      Edge_world<D> w(first_relink_world + number, generic);
      move_edges(w, D == 2 ? 400 : 260, seen);
    }
    report(std::to_string(D) + (generic ? "D, generic" : "D, degenerate"), seen);
    EXPECT_EQ(seen.all_wrong(), 0) << seen.first;
    if (worlds < 8 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.relinked, 200);
    EXPECT_GT(seen.through_p, 100);
    EXPECT_GT(seen.long_runs, 100);
    EXPECT_GT(seen.several_ridges, 20);
    EXPECT_GT(seen.blocked, 50);
    EXPECT_GT(seen.stopped, 50);
    EXPECT_GT(seen.located, 50);
    EXPECT_EQ(seen.from_plane > 0, !generic);
  }
}

TEST(RidgeRelink, IsRight2) { test_worlds<2>(); }
TEST(RidgeRelink, IsRight3) { test_worlds<3>(); }

/// A lattice with few walls, so that edges are long and turn over many ridges.
template <int D>
oracle::World<D> open_world(std::uint64_t seed) {
  Lattice_world_options<D> options;
  options.cells.fill(D == 2 ? 10 : 5);
  options.seed = seed;
  options.simplex_share = seed % 3 == 0 ? 0.7 : 0.3;
  options.prism_share = D == 2 ? 0 : 0.15;
  options.star_share = 0.1;
  options.membrane_share = options.solid_share = 0.02;
  options.slit_share = seed % 2 == 0 ? 0.02 : 0;
  const std::array maps{scaled<D>(1), rotated<D>(), sheared<D>(), scaled<D>(0x1p-300), scaled<D>(0x1p300)};
  options.map = maps[seed % maps.size()];
  oracle::World<D> world;
  world.name = "open, world " + std::to_string(seed);
  world.soup = lattice_world(options);
  return world;
}

template <int D>
void test_open_worlds() {
  const std::size_t worlds = oracle::scaled_count(30);
  Relinks_seen seen;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(open_world<D>(number), number, number / 2 % 2 == 0);
    move_edges(w, 200, seen);
  }
  report(std::to_string(D) + "D, open", seen);
  EXPECT_EQ(seen.all_wrong(), 0) << seen.first;
  if (worlds < 30) return;
  EXPECT_GT(seen.relinked, D == 2 ? 800 : 150);
  EXPECT_GT(seen.long_runs, D == 2 ? 600 : 100);
  EXPECT_GT(seen.several_ridges, D == 2 ? 100 : 15);
}

TEST(RidgeRelink, IsRightInTheOpen2) { test_open_worlds<2>(); }
TEST(RidgeRelink, IsRightInTheOpen3) { test_open_worlds<3>(); }

/// Long edges among spikes, and edges about sheets of membranes and slits with windows.
template <int D>
void test_thin_worlds() {
  const std::size_t worlds = oracle::scaled_count(48);
  Relinks_seen seen;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    const auto kind = number % 3;
    const std::uint64_t seed = 1000 + number;
    Edge_world<D> w(kind == 0   ? spikes<D>(seed)
                    : kind == 1 ? sheets<D>(seed)
                                : slit_world<D>(seed),
                    seed, number % 4 == 3);
    move_edges(w, 100, seen);
  }
  report(std::to_string(D) + "D, thin", seen);
  EXPECT_EQ(seen.all_wrong(), 0) << seen.first;
  if (worlds < 48) return;
  EXPECT_GT(seen.relinked, 200);
  EXPECT_GT(seen.several_ridges, 20);
}

TEST(RidgeRelink, IsRightAmongThinWalls2) { test_thin_worlds<2>(); }
TEST(RidgeRelink, IsRightAmongThinWalls3) { test_thin_worlds<3>(); }

}  // namespace
}  // namespace cellwalk::test
