// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that are pinched at a vertex, which moves along ridges of random walls, judged by an oracle: walls
// never come between their parts. What stands by hand in test_pinched_bodies.cpp is varied here.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/walk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "body/pinched/ridge_oracle.h"
#include "body/pinched/ridge_world.h"
#include "oracle/seed.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test::ridge {
namespace {

struct Ridges_seen {
  int bodies = 0, landed = 0, moves = 0, along = 0, free_along = 0, blocked = 0, by_wedges = 0;
};

Point<3> to_point(const Xyz<int>& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}

/// Bodies in one world, with faces between the walls of its narrow slab and other parts around them.
class Ridge_trial {
 public:
  Ridge_trial(std::uint64_t seed, Ridges_seen& seen)
      : seen_(seen),
        random_(seed),
        world_(random_),
        environment_(world_.build()),
        locator_(environment_.snapshot()) {
    options_.sweep.sweep = Sweep::faces;
  }

  void try_body() {
    make_star();
    x_ = beside_narrow_slab(random_.chance(0.5));
    const std::vector<Place> ends = star_.ends;
    for (Place& end : star_.ends)
      if (end.is_in_half_plane() && random_.chance(0.75)) end = off_half_plane(end);
    try {
      body_.emplace(environment_.snapshot(), locator_, soup());
    } catch (const Error&) {
      return;  // walls are in its way
    }
    ++seen_.bodies;
    for (std::size_t e = 0; e < ends.size(); ++e)
      if (ends[e].alpha != star_.ends[e].alpha || ends[e].beta != star_.ends[e].beta)
        seen_.landed += move_end(e, ends[e]);
    bool was_free = true;  // what is blocked mostly stays so
    for (int n = 0; n < 6 && (was_free || random_.chance(0.4)); ++n)
      was_free = random_.chance(0.2) ? move_an_end() : move_pinch();
  }

 private:
  int below(int n) { return static_cast<int>(random_.below(static_cast<std::uint64_t>(n))); }
  int any_x() { return 10 + 10 * below(4 * world_.slabs - 1); }
  int any_level() { return 1 + below(14); }
  int narrow_start() const { return world_.narrow_slab * Ridge_world::slab_length; }
  int beside_narrow_slab(bool is_before) {
    const int away = random_.chance(0.75) ? 20 : 10 * below(4);
    return is_before ? narrow_start() - away : narrow_start() + Ridge_world::slab_length + away;
  }

  /// Above the inner walls of the narrow slab, so that edges to there pass these while p is beside it.
  Place high_end(int half_plane) { return {narrow_start() + 10 + 10 * below(3), half_plane, 10 + below(5)}; }
  Place any_end(int half_plane) {
    switch (below(16)) {
      case 0:
        return {any_x(), 0};
      case 1:
        return {any_x(), half_plane, 1 + below(7), 1 + below(7)};
      default:
        return random_.chance(0.3) ? high_end(half_plane) : Place{any_x(), half_plane, any_level()};
    }
  }
  Place off_half_plane(const Place& end) {
    if (random_.chance(0.5)) return {end.x, end.half_plane, end.alpha, 1};
    return {end.x, world_.before(end.half_plane), 1, end.alpha};
  }
  void make_star() {
    const int k = world_.narrow_sector;
    star_ = {{high_end(k), high_end(world_.next(k))}, {{0, 1}}};
    star_.ends.push_back(any_end(random_.chance(0.5) ? k : world_.next(k)));
    if (random_.chance(0.5)) add_part(below(world_.sectors()));
    std::erase_if(star_.faces, [this](const auto& face) { return is_across_axis(face); });
  }
  /// An edge, or a face with it: in its half-plane, between that and the next, or joined to the first face.
  void add_part(int half_plane) {
    const std::size_t e = star_.ends.size();
    star_.ends.push_back(any_end(half_plane));
    const int kind = below(6);
    if (kind < 3) {
      star_.ends.push_back({any_x(), kind == 0 ? world_.next(half_plane) : half_plane, any_level()});
      star_.faces.push_back({e, e + 1});
    } else if (kind == 3 && star_.ends[e].is_in_half_plane()) {
      star_.faces.push_back({random_.below(2), e});
    }
  }
  bool is_across_axis(const std::array<std::size_t, 2>& face) const {
    const auto a = world_.point(star_.ends[face[0]]), b = world_.point(star_.ends[face[1]]);
    return a[1] * b[2] == a[2] * b[1] && a[1] * b[1] + a[2] * b[2] < 0;
  }
  Body_soup<3> soup() const {
    Body_soup<3> soup;
    soup.points.push_back({1.0 * x_, 0, 0});
    for (std::uint32_t e = 1; e <= star_.ends.size(); ++e) {
      soup.points.push_back(to_point(world_.point(star_.ends[e - 1])));
      soup.edges.push_back({0, e});
    }
    for (const auto& face : star_.faces) {
      const auto u = static_cast<std::uint32_t>(face[0]) + 1, v = static_cast<std::uint32_t>(face[1]) + 1;
      soup.edges.push_back({u, v});
      soup.faces.push_back({0, u, v});
    }
    return soup;
  }

  std::optional<Contact<3>> move(std::size_t vertex, const Xyz<int>& target) {
    const auto contact =
        body_->move_vertex(static_cast<std::uint32_t>(vertex), to_point(target), options_, counts_);
    if (!contact) {
      EXPECT_NO_THROW(body_->validate());
    }
    return contact;
  }
  bool move_end(std::size_t e, const Place& to) {
    const std::array<Place, 2> places{star_.ends[e], to};
    const bool is_free = !move(e + 1, world_.point(to));
    star_.ends[e] = places[is_free];
    return is_free;
  }
  /// In its half-plane, or off it.
  bool move_an_end() {
    const std::size_t e = random_.below(star_.ends.size());
    Place to = star_.ends[e];
    if (!to.is_in_half_plane() || random_.chance(0.5))
      to.x = any_x();
    else
      to = off_half_plane(to);
    return move_end(e, to);
  }
  bool move_pinch() {
    int to = last_x_;
    if (random_.chance(0.6)) to = beside_narrow_slab(x_ > narrow_start());
    if (random_.chance(0.1)) to = any_x();
    if (random_.chance(0.1)) to = narrow_start() + 10 * below(5);
    if (to == x_) return true;
    SCOPED_TRACE(testing::Message() << "from " << x_ << " to " << to);
    const Star_state before = state();
    const auto contact = move(0, {to, 0, 0});
    ++seen_.moves;
    const bool is_along = passes_ridge(x_, to);
    seen_.along += is_along;
    if (contact) {
      judge_contact(*contact, before, to);
      return false;
    }
    seen_.free_along += is_along;
    Ridge_oracle oracle = asked(before, to);
    oracle.heed_faces(before);
    EXPECT_EQ(oracle.verdict(), Verdict::possible) << "a move is free";
    last_x_ = std::exchange(x_, to);
    const Star_state after = state();
    oracle.heed(after);
    oracle.heed_faces(after);
    EXPECT_EQ(oracle.verdict(), Verdict::possible) << "at its end";
    return true;
  }
  Ridge_oracle asked(const Star_state& before, int to) const {
    Ridge_oracle oracle(world_, star_, x_, to);
    oracle.heed(before);
    return oracle;
  }
  void judge_contact(const Contact<3>& contact, const Star_state& before, int to) {
    ++seen_.blocked;
    const int on = to > x_ ? 1 : -1;
    const int earlier = static_cast<int>(on * std::ceil(on * contact.point[0])) - on;
    if (contact.body != Body_feature::vertex) return;
    // Sides that disagree from the start are compared only if no other contact is met.
    if (on * (earlier - x_) > 0) {
      EXPECT_NE(asked(before, earlier).verdict(), Verdict::no_wedge) << "a contact is late";
    }
    Ridge_oracle oracle = asked(before, earlier + 2 * on);
    oracle.heed_faces(before);
    if (oracle.verdict() != Verdict::possible) {
      ++seen_.by_wedges;
      return;
    }
    ADD_FAILURE() << "a contact is early";
  }
  bool passes_ridge(int from, int to) const {
    for (int slab = 0; slab < world_.slabs; ++slab) {
      const int low = slab * Ridge_world::slab_length, high = low + Ridge_world::slab_length;
      int walls = 0;
      for (int k = 0; k < world_.sectors(); ++k) walls += world_.has_wall(slab, k, 0);
      if (walls > 1 && std::max(std::min(from, to), low) < std::min(std::max(from, to), high)) return true;
    }
    return false;
  }
  /// How the body is registered now.
  Star_state state() {
    body_->refresh(counts_);
    const Snapshot<3>& snapshot = environment_.snapshot();
    const auto cell_of = [&](std::size_t v) { return snapshot.index(body_->particles()[v].cell); };
    Star_state state{x_, cell_of(0), {}, {}};
    for (std::size_t e = 0; e < star_.ends.size(); ++e) {
      Edge_chain chain;
      for (const Half_facet f : body_->chain(e)) {
        const auto [cell, side] = world_.side_of(snapshot, f);
        chain.cells.push_back(cell);
        chain.passed.push_back(side);
      }
      chain.cells.push_back(chain.passed.empty() ? common_cell(state.cell, cell_of(e + 1), star_.ends[e])
                                                 : world_.neighbour(chain.cells.back(), chain.passed.back()));
      state.chains.push_back(chain);
    }
    const detail::Body_access<3> access(*body_);
    for (std::uint32_t n = 0; n < star_.faces.size(); ++n) {
      state.resting.emplace_back();
      for (const Half_facet f : access.supporting_walls(n))
        state.resting.back().push_back(world_.side_of(snapshot, f));
    }
    return state;
  }
  /// One that is linked with that of p, and with that of the end: if possible one of these themselves, since
  /// others may be linked with both around a wall on which the edge lies.
  std::size_t common_cell(std::size_t of_p, std::size_t of_end, const Place& end) const {
    const auto at_p = world_.linked(of_p, Xyz<int>{x_, 0, 0}),
               at_end = world_.linked(of_end, world_.point(end));
    if (at_end[of_p]) return of_p;
    if (at_p[of_end]) return of_end;
    for (std::size_t c = 0; c < at_p.size(); ++c)
      if (at_p[c] && at_end[c]) return c;
    ADD_FAILURE() << "an edge without a chain passes through several cells";
    return of_p;
  }

  Ridges_seen& seen_;
  Random random_;
  Ridge_world world_;
  Environment<3> environment_;
  Locator<3> locator_;
  Body_options options_;
  Body_counts counts_;
  Star star_;
  int x_ = 0, last_x_ = 10;
  std::optional<Body<3>> body_;
};

TEST(PinchedOracle, WallsDoNotComeBetweenTheParts) {
  Ridges_seen seen;
  const std::size_t worlds = oracle::scaled_count(40);
  for (std::uint64_t i = 0; i < worlds; ++i) {
    SCOPED_TRACE(testing::Message() << "world " << i);
    Ridge_trial trial(oracle::reseeded(i), seen);
    for (int n = 0; n < 8; ++n) trial.try_body();
  }
  std::cout << seen.bodies << " bodies, " << seen.landed << " ends landed on half-planes, " << seen.moves
            << " moves, " << seen.along << " along ridges, of which " << seen.free_along << " free, "
            << seen.blocked << " contacts, " << seen.by_wedges << " of wedges\n";
  const auto at_least = [](std::size_t count_in_ci) {
    return static_cast<int>(oracle::scaled_count(count_in_ci));
  };
  EXPECT_GE(seen.landed, at_least(400));
  EXPECT_GE(seen.along, at_least(300));
  EXPECT_GE(seen.free_along, at_least(50));
  EXPECT_GE(seen.by_wedges, at_least(100));
}

}  // namespace
}  // namespace cellwalk::test::ridge
