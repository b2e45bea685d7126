// SPDX-License-Identifier: LGPL-3.0-or-later
// The first oracle of moving walls: knows walls only. Each wall at a vertex is held against every particle,
// edge and face of the world, in rational numbers.
#ifndef CELLWALK_TESTS_RESHAPE_WALL_JUDGE_H
#define CELLWALK_TESTS_RESHAPE_WALL_JUDGE_H

#include <cellwalk/internal/kernel/box.h>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "kernel/rational_meeting.h"
#include "reshape/face_sides.h"
#include "reshape/fate_judge.h"
#include "reshape/reshape_world.h"

namespace cellwalk::test {

/// What is known of a move before it is made.
template <int D>
struct Expected {
  bool inverts_cell = false;
  bool is_passed_at_once = false;  ///< a wall that starts in a vertex moves to its side
  bool is_met = false;             ///< by some wall, touched at least
  std::optional<Fraction> first;   ///< time of the first hit
  std::optional<Fraction> first_of_faces;
  std::vector<std::vector<Point<D>>> swept;  ///< by walls: start, end, then the corners that stand still
};

template <int D, class World = Reshape_world<D>>
class Wall_judge {
 public:
  struct Tally {
    int moves = 0, reached = 0, contacts = 0, touches = 0, cells = 0, boundaries = 0;
    int landed = 0;         ///< moves of walls whose side of a face is known from then on
    int free_touching = 0;  ///< reached, although a wall touched something
    int missed = 0, false_blocks = 0, wrong_times = 0, wrong_sides = 0, wrong_ends = 0;
    int tunnels = 0;  ///< of the boundary through itself
    Fate_tally fates;
    int wrong() const {
      return missed + false_blocks + wrong_times + wrong_sides + wrong_ends + tunnels + fates.wrong();
    }
  };

  Wall_judge(World& world, Tally& tally) : world_(world), tally_(tally) {}

  /// Makes a move by At_contact::hold, or asks about it, and judges the answer, which is returned.
  Vertex_result<D> judge(Reshaping<D>& reshaping, std::uint32_t v, const Point<D>& target,
                         bool asks = false) {
    const Expected<D> expected = expect(v, target);
    const bool tunnels = !expected.inverts_cell && runs_into_boundary(v, target);
    const Point<D> from = world_.snapshot.point(v);
    const std::vector<Particle<D>> before = world_.particles;
    const auto standing = standing_walls(v);
    bool passes_face = false;
    if constexpr (D == 3) passes_face = !expected.inverts_cell && faces_.is_passed(v, target);
    fates_.remember([&](std::span<const Point<D>> set) {
      return std::ranges::any_of(expected.swept, [&](const auto& simplex) {
        return may_meet(simplex, set) && relation_by_clipping<D>(simplex, set) != Relation::apart;
      });
    });
    const Vertex_result<D> result = asks ? reshaping.test_move(v, target) : reshaping.move(v, target);
    ++tally_.moves;
    if (!asks && !expected.inverts_cell && target != from && result.end != Move_end::boundary)
      fates_.judge({world_.snapshot, v, from, target}, result, expected.first_of_faces, tally_.fates);
    if constexpr (D == 3)
      if (!asks && result.end == Move_end::reached) {
        const std::size_t before_move = faces_.size();
        faces_.note(v, from);
        tally_.landed += faces_.size() > before_move;
      }
    tally_.wrong_ends += world_.snapshot.point(v) != (asks ? from : result.position);
    tally_.wrong_ends +=
        result.end != Move_end::boundary && expected.inverts_cell != (result.end == Move_end::cell);
    switch (result.end) {
      case Move_end::reached:
        ++tally_.reached;
        tally_.missed += expected.first.has_value() || expected.is_passed_at_once || passes_face;
        tally_.free_touching += expected.is_met;
        tally_.tunnels += tunnels;
        tally_.wrong_ends += result.position != target;
        break;
      case Move_end::contact:
        ++tally_.contacts;
        tally_.false_blocks += !expected.is_met;
        tally_.wrong_times +=
            expected.first && to_fraction(to_rational(result.hit->exact_time())) > *expected.first;
        break;
      case Move_end::touch:
        ++tally_.touches;
        tally_.false_blocks += !expected.is_met;
        tally_.missed += expected.first.has_value();
        break;
      case Move_end::cell:
        ++tally_.cells;
        break;
      case Move_end::boundary:
        ++tally_.boundaries;
        break;
    }
    if (result.end != Move_end::reached) tally_.wrong_ends += result.position != from;
    judge_sides(before, standing);
    return result;
  }

 private:
  struct Wall {
    std::vector<Point<D>> corners;
  };

  Expected<D> expect(std::uint32_t v, const Point<D>& target) {
    Expected<D> result;
    const Snapshot<D>& snapshot = world_.snapshot;
    const Point<D>& from = snapshot.point(v);
    std::vector<std::vector<Point<D>>>& swept = result.swept;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none) continue;
      const Cell_view<D> view = snapshot.view(c);
      bool has_v = false;
      std::vector<Point<D>> before, after;
      for (const std::uint32_t p : view.vertices) {
        has_v |= p == v;
        before.push_back(snapshot.point(p));
        after.push_back(p == v ? target : snapshot.point(p));
      }
      if (!has_v) continue;
      result.inverts_cell |= volume_sign<D>(before) != volume_sign<D>(after);
      if (snapshot.is_solid(c)) continue;
      for (std::size_t f = 0; f < view.facet_count(); ++f) {
        const Half_facet wall = Snapshot<D>::half_facet(c, f);
        if (!snapshot.is_impassable(wall)) continue;
        std::vector<Point<D>> simplex{from, target};
        for (const std::uint32_t p : snapshot.loop(wall))
          if (p != v) simplex.push_back(snapshot.point(p));
        if (simplex.size() == D + 1) swept.push_back(simplex);
      }
    }
    if (target == from || result.inverts_cell) return result;
    const auto note = [&](const Fraction& time, bool is_face) {
      if (!result.first || time < *result.first) result.first = time;
      if (is_face && (!result.first_of_faces || time < *result.first_of_faces)) result.first_of_faces = time;
    };
    const auto hold_against = [&](std::span<const Point<D>> set) {
      // Walls that all move in their own planes pass a face with the vertex.
      if constexpr (D == 3)
        if (set.size() == 3 && !swept.empty())
          if (const auto time = passing_time(from, target, set)) note(*time, true);
      for (const auto& simplex : swept) {
        const Relation met = relation_by_clipping<D>(simplex, set);
        result.is_met |= met != Relation::apart;
        if (met != Relation::hit) continue;
        note(*first_time<D>(simplex, set), set.size() == 3);
      }
    };
    // A wall that starts in a vertex, and moves to the side on which that is.
    const auto passes_at_once = [&](const Particle<D>& p) {
      for (const auto& simplex : swept) {
        std::vector<Point<D>> wall{from};
        wall.insert(wall.end(), simplex.begin() + 2, simplex.end());
        if (!lies_inside<D>(wall, p.position)) continue;
        const int side = side_of_cell(wall, p.cell);
        wall.push_back(target);
        if (volume_sign<D>(wall) == side) return true;
      }
      return false;
    };
    for (const Particle<D>& p : world_.particles) result.is_passed_at_once |= passes_at_once(p);
    for (const auto& body : world_.bodies)
      for (const Particle<D>& p : body->particles()) result.is_passed_at_once |= passes_at_once(p);
    for (const Particle<D>& p : world_.particles) hold_against(std::span(&p.position, 1));
    for (const auto& body : world_.bodies) {
      const auto x = body->positions();
      for (const auto& [p, q] : body->edges()) hold_against(std::array{x[p], x[q]});
      for (const auto& [p, q, r] : body->faces()) hold_against(std::array{x[p], x[q], x[r]});
    }
    return result;
  }

  /// True if a boundary facet at a vertex passes a point of another one that stands still.
  bool runs_into_boundary(std::uint32_t v, const Point<D>& target) const {
    const Snapshot<D>& snapshot = world_.snapshot;
    std::vector<std::vector<Point<D>>> swept, standing;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none) continue;
      for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
        const Half_facet f = Snapshot<D>::half_facet(c, k);
        if (snapshot.opposite(f) != Half_facet::none) continue;
        std::vector<Point<D>> corners;
        bool has_v = false;
        for (const std::uint32_t p : snapshot.loop(f)) {
          has_v |= p == v;
          if (p != v) corners.push_back(snapshot.point(p));
        }
        if (has_v) corners.insert(corners.begin(), {snapshot.point(v), target});
        (has_v ? swept : standing).push_back(corners);
      }
    }
    return std::ranges::any_of(swept, [&](const auto& simplex) {
      return volume_sign<D>(simplex) != 0 && std::ranges::any_of(standing, [&](const auto& facet) {
               return may_meet(simplex, facet) && meets_off_start<D>(simplex, facet);
             });
    });
  }

  static bool may_meet(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
    detail::Box<D> a, b;
    for (const Point<D>& x : simplex) a.extend(x);
    for (const Point<D>& x : set) b.extend(x);
    return a.meets(b);
  }

  /// Walls that do not have the vertex and hold a particle inside them, and the side on which that is: the
  /// cell on that side has a vertex there.
  struct Standing {
    std::size_t particle;
    std::vector<Point<D>> wall;
    int side;
  };

  int side_of_cell(const std::vector<Point<D>>& wall, Cell c) const {
    const Cell_view<D> view = world_.snapshot.view(c);
    for (std::size_t k = 0; k < view.vertex_count(); ++k) {
      std::vector<Point<D>> simplex = wall;
      simplex.push_back(view.point(k));
      if (const int side = volume_sign<D>(simplex); side != 0) return side;
    }
    return 0;
  }

  std::vector<Standing> standing_walls(std::uint32_t v) const {
    std::vector<Standing> result;
    const Snapshot<D>& snapshot = world_.snapshot;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none) continue;
      for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
        const Half_facet wall = Snapshot<D>::half_facet(c, f);
        if (!snapshot.is_impassable(wall)) continue;
        std::vector<Point<D>> corners;
        bool has_v = false;
        for (const std::uint32_t p : snapshot.loop(wall)) {
          has_v |= p == v;
          corners.push_back(snapshot.point(p));
        }
        if (has_v) continue;
        for (std::size_t k = 0; k < world_.particles.size(); ++k) {
          const Particle<D>& p = world_.particles[k];
          if (lies_inside<D>(corners, p.position))
            result.push_back({k, corners, side_of_cell(corners, p.cell)});
        }
      }
    }
    return result;
  }

  void judge_sides(const std::vector<Particle<D>>& before, const std::vector<Standing>& standing) {
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Particle<D>& p = world_.particles[k];
      tally_.wrong_sides += p.position != before[k].position || world_.snapshot.is_solid(p.cell) ||
                            !in_closure(world_.snapshot, p.cell, p.position);
    }
    for (const Standing& s : standing)
      tally_.wrong_sides += side_of_cell(s.wall, world_.particles[s.particle].cell) != s.side;
  }

  struct No_faces {
    explicit No_faces(const World&) {}
  };

  World& world_;
  Tally& tally_;
  Fate_judge<D, World> fates_{world_};
  std::conditional_t<D == 3, Face_sides<World>, No_faces> faces_{world_};
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_WALL_JUDGE_H
