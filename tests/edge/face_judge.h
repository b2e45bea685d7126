// SPDX-License-Identifier: LGPL-3.0-or-later
// Judges the moves of a face by brute force over all walls in rationals.
#ifndef CELLWALK_TESTS_EDGE_FACE_JUDGE_H
#define CELLWALK_TESTS_EDGE_FACE_JUDGE_H

#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/kernel/fraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "edge/edge_worlds.h"
#include "edge/face_body.h"

namespace cellwalk::test {

struct Face_seen {
  int registered = 0, pierced = 0, pierced_together = 0;
  int sweeps = 0, hits = 0, face_only = 0, through_vertex = 0, at_once = 0, inside_hits = 0;
  int landed = 0, on_one_sided = 0, leaves_through = 0, sides_checked = 0, flat = 0, chosen = 0;
  int misses = 0, unjudged = 0, false_blocks = 0, wrong_times = 0, wrong_supporting_walls = 0;
  int blocked = 0, before_blocked = 0, edge_on_other_side = 0;
  Face_counts counts;
};

/// What the oracle knows of the walls in the plane of the face: the side of each wall, by the turn of its
/// vertices, on which the face came to lie; 0 if it cannot tell.
using Sides = std::map<std::size_t, int>;

class Judge {
 public:
  Judge(const Snapshot<3>& snapshot, std::string name, const Wall_list<3>& walls, Face_body& body,
        bool generic, Face_seen& seen)
      : snapshot_(snapshot),
        name_(std::move(name)),
        walls_(walls),
        body_(body),
        generic_(generic),
        seen_(seen) {
    for (std::size_t w = 0; w < walls.facets.size(); ++w)
      if (overlaps_in_plane(body.triangle(), walls.polygons[w])) sides_[w] = 0;
    check_supporting_walls();
  }

  void move(std::size_t k, const Point<3>& target) {
    const Triangle before = body_.triangle();
    const auto outcome = body_.move_corner(k, target);
    const bool is_flat = orientation_of(before[0], before[1], before[2], target) == 0;
    if (outcome.face.contact && outcome.face.is_edge_on_other_side) {
      ++seen_.edge_on_other_side;
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
    check_supporting_walls();
    const Face_registration again = body_.registered();
    EXPECT_EQ(again.supporting_walls, body_.supporting_walls()) << name_;
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
          EXPECT_TRUE(hit && text(*hit) == text(to_rational(contact->exact_time()))) << name_;
        }
      } else if (hit) {
        EXPECT_GE(static_cast<double>(*hit), end - rounding) << name_ << ": missed before its end";
      }
      return;
    }
    ++seen_.sweeps;
    seen_.hits += hit.has_value();
    const bool is_unjudged = contact && may_be_at_once && contact->exact_time() == Exact_time();
    seen_.unjudged += is_unjudged && !(hit && *hit == 0);
    if (hit && !contact) {
      ++seen_.misses;
      ADD_FAILURE() << name_ << ": missed at " << *hit << (outcome.edge ? ", edge blocked" : "");
    }
    if (!hit && contact && !is_unjudged) {
      ++seen_.false_blocks;
      ADD_FAILURE() << name_ << ": false block at " << to_rational(contact->exact_time());
    }
    if (!hit || !contact) return;
    if (!is_unjudged && text(*hit) != text(to_rational(contact->exact_time()))) {
      ++seen_.wrong_times;
      ADD_FAILURE() << name_ << ": at " << to_rational(contact->exact_time()) << ", not " << *hit;
    }
    EXPECT_LE(Rational(contact->time), to_rational(contact->exact_time()));
    EXPECT_NEAR(length(contact->normal), 1, 1e-14);
    EXPECT_LE(dot(contact->normal, target - before[k]), 1e-13 * length(target - before[k])) << name_;
    seen_.face_only += outcome.is_face_only();
    seen_.through_vertex += contact->kind == Contact_kind::vertex;
    seen_.inside_hits += contact->body == Body_feature::face;
    seen_.at_once += contact->exact_time() == Exact_time();
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

  bool supporting_walls(Half_facet f) const {
    return std::find(body_.supporting_walls().begin(), body_.supporting_walls().end(), f) !=
           body_.supporting_walls().end();
  }

  /// The rests are the walls in the plane, on the sides known. Of walls of one side each that coincide, one
  /// is a rest.
  void check_supporting_walls() {
    bool is_right = true;
    std::size_t found = 0;
    for (const auto& [w, side] : sides_) {
      const Half_facet front = walls_.facets[w], back = snapshot_.opposite(front);
      const bool is_one_sided = back == Half_facet::none, is_front = supporting_walls(front),
                 is_back = !is_one_sided && supporting_walls(back);
      found += std::size_t{is_front} + std::size_t{is_back};
      // A facet turns counterclockwise seen from outside its cell, so its cell lies on the negative side.
      is_right &= is_front ? side <= 0 : side >= 0;
      is_right &= is_one_sided ? agrees_behind(w) : is_front != is_back;
      for (const Half_facet f : {front, back})
        is_right &=
            f == Half_facet::none || !supporting_walls(f) || !snapshot_.is_solid(snapshot_.cell_of(f));
      seen_.sides_checked += side != 0;
      seen_.chosen += side == 0;
      seen_.on_one_sided += is_one_sided && is_front;
    }
    is_right &= found == body_.supporting_walls().size();
    seen_.wrong_supporting_walls += !is_right;
    EXPECT_TRUE(is_right) << name_;
    if (generic_) {
      EXPECT_TRUE(sides_.empty());
    }
  }

  /// A wall of one side is a rest, or what coincides with it under the face is: free space on one side there
  /// must be.
  bool agrees_behind(std::size_t w) const {
    const bool is_front = supporting_walls(walls_.facets[w]);
    bool is_any = false, is_all = true;
    for (const auto& [other, side] : sides_) {
      if (other == w || !overlap_in_plane(body_.triangle(), walls_.polygons[w], walls_.polygons[other]))
        continue;
      is_any |= supporting_walls(walls_.facets[other]);
      is_all &= supporting_walls(walls_.facets[other]);
    }
    return is_front ? !is_any : is_any && is_all;
  }

  template <class Number>
  static std::string text(const Number& x) {
    std::ostringstream out;
    out << x;
    return out.str();
  }

  const Snapshot<3>& snapshot_;
  const std::string name_;
  const Wall_list<3>& walls_;
  Face_body& body_;
  bool generic_;
  Face_seen& seen_;
  Sides sides_;
};

/// Registering says that a face is pierced if a wall pierces it; and else only where two walls meet in its
/// plane.
inline void check_piercing(const Wall_list<3>& walls, Face_body& body, bool is_valid, bool generic,
                           Face_seen& seen) {
  bool is_pierced = false;
  for (const auto& wall : walls.polygons) is_pierced |= pierces(body.triangle(), wall);
  ++seen.registered;
  seen.pierced += is_pierced;
  EXPECT_FALSE(is_pierced && is_valid);
  const bool is_together = !is_pierced && !is_valid;
  seen.pierced_together += is_together;
  EXPECT_FALSE(is_together && generic);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_FACE_JUDGE_H
