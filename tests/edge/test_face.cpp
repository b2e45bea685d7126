// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweep of faces against brute force over all walls in rationals.
#include <cellwalk/edge/face.h>
#include <cellwalk/environment/generate/grid.h>
#include <cellwalk/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "edge/edge_worlds.h"
#include "edge/face_body.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

/// All walls of a world, each once.
struct Walls {
  std::vector<Half_facet> facets;
  std::vector<std::vector<Point<3>>> polygons;

  explicit Walls(const Snapshot<3>& snapshot) {
    for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
      const Cell c = snapshot.cell(i);
      for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
        const Half_facet facet = Snapshot<3>::half_facet(c, f), other = snapshot.opposite(facet);
        if (!snapshot.is_impassable(facet) || (other != Half_facet::none && other < facet)) continue;
        facets.push_back(facet);
        polygons.push_back(polygon(snapshot, facet));
      }
    }
  }
};

struct Seen {
  int registered = 0, pierced = 0, pierced_together = 0;
  int sweeps = 0, hits = 0, face_only = 0, through_vertex = 0, at_once = 0, inside_hits = 0;
  int landed = 0, leaves_through = 0, sides_checked = 0, flat = 0, chosen = 0;
  int misses = 0, false_blocks = 0, wrong_times = 0, wrong_rests = 0;
  int blocked = 0, before_blocked = 0, astray = 0;
  Face_counts counts;
};

/// What the oracle knows of the walls in the plane of the face: the side of each wall, by the turn of its vertices, on which the
/// face came to lie; 0 if it cannot tell.
using Sides = std::map<std::size_t, int>;

class Judge {
 public:
  Judge(const Snapshot<3>& snapshot, std::string name, const Walls& walls, Face_body& body, bool generic,
        Seen& seen)
      : snapshot_(snapshot),
        name_(std::move(name)),
        walls_(walls),
        body_(body),
        generic_(generic),
        seen_(seen) {
    for (std::size_t w = 0; w < walls.facets.size(); ++w)
      if (overlaps_in_plane(body.triangle(), walls.polygons[w])) sides_[w] = 0;
    check_rests();
  }

  void move(std::size_t k, const Point<3>& target) {
    const Triangle before = body_.triangle();
    const auto outcome = body_.move_corner(k, target);
    const bool is_flat = orientation_of(before[0], before[1], before[2], target) == 0;
    if (outcome.face.contact && outcome.face.contact->is_edge_astray) {
      ++seen_.astray;
      EXPECT_FALSE(generic_);
      EXPECT_FALSE(!is_flat && first_hit(before, k, target)) << name_;
      return;
    }
    if (is_flat) {
      ++seen_.flat;
      EXPECT_FALSE(outcome.face.contact) << name_;
    } else {
      judge(before, k, target, outcome);
    }
    if (!outcome.is_made()) return;
    follow(before[k], is_flat);
    check_rests();
    const Face_registration again = body_.registered();
    EXPECT_EQ(again.rests, body_.rests()) << name_;
    EXPECT_EQ(again.piercing, Half_facet::none) << name_;
  }

 private:
  /// When a wall comes through the face first, walls in its plane at 0 aside.
  std::optional<Fraction> first_hit(const Triangle& before, std::size_t k, const Point<3>& target) const {
    std::optional<Fraction> hit;
    for (const auto& wall : walls_.polygons) {
      const auto time = first_piercing(before, k, target, wall);
      if (time && (!hit || *time < *hit)) hit = time;
    }
    return hit;
  }

  void judge(const Triangle& before, std::size_t k, const Point<3>& target,
             const Face_body::Outcome& outcome) {
    const auto& contact = outcome.face.contact;
    std::optional<Fraction> hit = first_hit(before, k, target);
    bool may_be_at_once = false;
    for (const auto& [w, side] : sides_) {
      may_be_at_once |= side == 0;
      if (side == 0 || side_of_plane(walls_.polygons[w], target) == side) continue;
      hit = Fraction(0);
      ++seen_.leaves_through;
    }
    if (outcome.vertex) {
      ++seen_.blocked;
      constexpr double rounding = 0x1p-50;  // of both times
      const double end = outcome.vertex->time;
      seen_.before_blocked += contact.has_value();
      if (contact) {
        EXPECT_LE(contact->time, end + rounding);
        if (!may_be_at_once) {
          EXPECT_TRUE(hit && text(*hit) == text(contact->exact_time)) << name_;
        }
      } else if (hit) {
        EXPECT_GE(static_cast<double>(*hit), end - rounding) << name_ << ": missed before its end";
      }
      return;
    }
    ++seen_.sweeps;
    seen_.hits += hit.has_value();
    if (hit && !contact) {
      ++seen_.misses;
      ADD_FAILURE() << name_ << ": missed at " << *hit << (outcome.edge ? ", edge blocked" : "");
    }
    if (!hit && contact && !(may_be_at_once && contact->exact_time == 0)) {
      ++seen_.false_blocks;
      ADD_FAILURE() << name_ << ": false block at " << contact->exact_time;
    }
    if (!hit || !contact) return;
    if (!(may_be_at_once && contact->exact_time == 0) && text(*hit) != text(contact->exact_time)) {
      ++seen_.wrong_times;
      ADD_FAILURE() << name_ << ": at " << contact->exact_time << ", not " << *hit;
    }
    EXPECT_LE(Rational(contact->time), contact->exact_time);
    EXPECT_NEAR(length(contact->normal), 1, 1e-14);
    seen_.face_only += outcome.is_face_only();
    seen_.through_vertex += contact->kind == Contact_kind::vertex;
    seen_.inside_hits += contact->body == Contact_kind::facet;
    seen_.at_once += contact->exact_time == 0;
    if (contact->kind == Contact_kind::vertex) {
      const auto points = polygon(snapshot_, contact->facet);
      EXPECT_NE(std::find(points.begin(), points.end(), contact->point), points.end());
    }
  }

  /// A corner moved here from a: which walls lie in the plane now, and on which side of them the face came.
  void follow(const Point<3>& a, bool is_flat) {
    Sides sides;
    for (std::size_t w = 0; w < walls_.facets.size(); ++w) {
      if (!overlaps_in_plane(body_.triangle(), walls_.polygons[w])) continue;
      if (is_flat) {
        const auto known = sides_.find(w);
        sides[w] = known == sides_.end() ? 0 : known->second;
      } else {
        sides[w] = side_of_plane(walls_.polygons[w], a);
        ++seen_.landed;
      }
    }
    sides_ = sides;
  }

  /// The rests are the walls in the plane, on the sides known.
  void check_rests() {
    bool is_right = body_.rests().size() == sides_.size();
    for (const auto& [w, side] : sides_) {
      const Half_facet front = walls_.facets[w], back = snapshot_.opposite(front);
      const auto rests = [&](Half_facet f) {
        return std::find(body_.rests().begin(), body_.rests().end(), f) != body_.rests().end();
      };
      // A facet turns counterclockwise seen from outside its cell, so its cell lies on the negative side.
      is_right &= side < 0 ? rests(front) : side > 0 ? rests(back) : rests(front) != rests(back);
      seen_.sides_checked += side != 0;
      seen_.chosen += side == 0;
    }
    seen_.wrong_rests += !is_right;
    EXPECT_TRUE(is_right) << name_;
    if (generic_) {
      EXPECT_TRUE(sides_.empty());
    }
  }

  template <class Number>
  static std::string text(const Number& x) {
    std::ostringstream out;
    out << x;
    return out.str();
  }

  const Snapshot<3>& snapshot_;
  const std::string name_;
  const Walls& walls_;
  Face_body& body_;
  bool generic_;
  Seen& seen_;
  Sides sides_;
};

/// Registering says that a face is pierced if a wall pierces it; and else only where two walls meet in its plane.
void check_piercing(const Walls& walls, Face_body& body, bool is_valid, bool generic, Seen& seen) {
  bool is_pierced = false;
  for (const auto& wall : walls.polygons) is_pierced |= pierces(body.triangle(), wall);
  ++seen.registered;
  seen.pierced += is_pierced;
  EXPECT_FALSE(is_pierced && is_valid);
  const bool is_together = !is_pierced && !is_valid;
  seen.pierced_together += is_together;
  EXPECT_FALSE(is_together && generic);
}

std::size_t worlds(bool generic) { return oracle::scaled_count((generic ? 1 : 2) * oracle::world_kinds); }

void report(const char* what, const Seen& seen) {
  const Face_counts& c = seen.counts;
  std::cout << what << ": " << seen.sweeps << " sweeps, " << seen.hits << " met by a wall (" << seen.face_only
            << " by no edge, " << seen.through_vertex << " at a vertex, " << seen.inside_hits
            << " inside the face, " << seen.at_once << " at 0); " << seen.flat << " flat, " << seen.landed
            << " walls landed on, " << seen.leaves_through << " times left through one, " << seen.chosen
            << " sides chosen; " << seen.registered << " registered, " << seen.pierced << " pierced, "
            << seen.pierced_together << " by walls together; p blocked " << seen.blocked
            << ", the face before " << seen.before_blocked << ", an edge astray " << seen.astray << "; clear "
            << c.clear << " of " << c.faces << ", walls " << c.walls << ", clipped " << c.clipped
            << "; missed " << seen.misses << ", false blocks " << seen.false_blocks << ", wrong times "
            << seen.wrong_times << ", wrong rests " << seen.wrong_rests << "\n";
}

Seen sweep(bool generic) {
  Seen seen;
  for (std::uint64_t number = 0; number < worlds(generic); ++number) {
    Edge_world<3> w(number, generic);
    const Walls walls(w.snapshot);
    for (int k = 0; k < 40; ++k) {
      const Particle<3> p = w.start();
      if (p.cell == Cell::none) continue;
      const Particle<3> q = w.end(p), r = w.end(p);
      if (q.cell == Cell::none || r.cell == Cell::none) continue;
      Face_body body(w.snapshot);
      const bool is_valid = body.place({p, q, r});
      if (body.counts.faces == 0) continue;  // an edge crosses a wall
      check_piercing(walls, body, is_valid, generic, seen);
      if (is_valid) {
        Judge judge(w.snapshot, w.world.name, walls, body, generic, seen);
        for (std::size_t step = 0; step < 9; ++step) {
          w.choose_kind();
          judge.move(step % 3, w.target(body.corner(step % 3)));
        }
      }
      seen.counts += body.counts;
    }
  }
  return seen;
}

/// Few and small walls, large faces: walls come through their insides.
Seen sweep_among_spikes() {
  Seen seen;
  const std::size_t count = oracle::scaled_count(8);
  for (std::uint64_t number = 0; number < count; ++number) {
    Random random(number);
    Simplex_grid_options<3> grid;
    grid.cells = {4, 4, 4};
    grid.seed = number;
    grid.jitter = 0.15;
    Cell_soup<3> soup = tetrahedral_grid(grid);
    for (auto& wall : soup.impassable) wall = random.below(100) == 0;
    for (std::size_t c = 0; c < soup.cell_count(); ++c) {
      if (random.below(60) != 0) continue;
      soup.solid[c] = 1;
      for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) soup.impassable[f] = 1;
    }
    const Snapshot<3> snapshot = Snapshot<3>::compile(soup, glue(soup));
    const Walls walls(snapshot);
    const Locator<3> locator(snapshot);
    const auto anywhere = [&] {
      return Point<3>{random.real(0.3, 3.7), random.real(0.3, 3.7), random.real(0.3, 3.7)};
    };
    for (int k = 0; k < 60; ++k) {
      const Particle<3> p = locator.particle_at(anywhere()), q = locator.particle_at(anywhere()),
                        r = locator.particle_at(anywhere());
      if (p.cell == Cell::none || q.cell == Cell::none || r.cell == Cell::none) continue;
      Face_body body(snapshot);
      const bool is_valid = body.place({p, q, r});
      if (body.counts.faces == 0) continue;  // an edge crosses a wall
      check_piercing(walls, body, is_valid, true, seen);
      if (is_valid) {
        Judge judge(snapshot, "spikes, world " + std::to_string(number), walls, body, true, seen);
        for (std::size_t step = 0; step < 9; ++step) {
          Point<3> target = body.corner(step % 3).position;
          for (double& x : target) x = std::clamp(x + random.real(-0.7, 0.7), 0.2, 3.8);
          judge.move(step % 3, target);
        }
      }
      seen.counts += body.counts;
    }
  }
  report("spikes", seen);
  return seen;
}

void expect_no_fault(const Seen& seen) {
  EXPECT_EQ(seen.misses + seen.false_blocks + seen.wrong_times + seen.wrong_rests, 0);
}

TEST(Face, NeverMissesASpike) {
  const Seen seen = sweep_among_spikes();
  expect_no_fault(seen);
  if (oracle::scaled_count(10) < 10) return;  // too few to meet everything
  EXPECT_GT(seen.registered, 50);
  EXPECT_GT(seen.pierced, 3) << "without a crossed edge";
  EXPECT_GT(seen.face_only, 8) << "the paper's figure 6";
  EXPECT_GT(seen.before_blocked, 3);
}

TEST(Face, NeverMissesAWallInGeneralPosition) {
  const Seen seen = sweep(true);
  report("generic", seen);
  expect_no_fault(seen);
  if (worlds(true) < oracle::world_kinds) return;
  EXPECT_GT(seen.sweeps, 200);
  EXPECT_GT(seen.hits, 20);
  EXPECT_GT(seen.before_blocked, 20);
}

TEST(Face, NeverMissesAWallInDegeneratePositions) {
  const Seen seen = sweep(false);
  report("degenerate", seen);
  expect_no_fault(seen);
  if (worlds(false) < 2 * oracle::world_kinds) return;
  EXPECT_GT(seen.sweeps, 500);
  EXPECT_GT(seen.hits, 150);
  EXPECT_GT(seen.through_vertex, 40);
  EXPECT_GT(seen.inside_hits, 5);
  EXPECT_GT(seen.at_once, 30);
  EXPECT_GT(seen.face_only, 0);
  EXPECT_GT(seen.flat, 500);
  EXPECT_GT(seen.landed, 5);
  EXPECT_GT(seen.leaves_through, 2);
  EXPECT_GT(seen.chosen, 50);
  EXPECT_GT(seen.pierced, 3);
}

}  // namespace
}  // namespace cellwalk::test
