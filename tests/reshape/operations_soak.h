// SPDX-License-Identifier: LGPL-3.0-or-later
// Random changes of an environment of all kinds, one after the other, among bodies and particles. What may be
// refused is judged by oracles; after each change all is certified, and all registrations are looked at.
#ifndef CELLWALK_TESTS_RESHAPE_OPERATIONS_SOAK_H
#define CELLWALK_TESTS_RESHAPE_OPERATIONS_SOAK_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/exact.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "reshape/judged_replacements.h"
#include "reshape/toggle_world.h"
#include "reshape/toggling.h"
#include "reshape/wall_judge.h"

namespace cellwalk::test {

struct Operation_tally {
  Replacement_tally replacements;
  Closing_tally closings;
  Growth_tally growths;
  std::uint64_t operations = 0, undecided = 0;
  std::uint64_t relaxations = 0, improvements = 0;
  std::uint64_t peels = 0, peeled = 0;
  std::uint64_t merges = 0, merged = 0, merges_held = 0;
  std::uint64_t cuts = 0, split = 0, opened = 0, held = 0, slit = 0;
  std::uint64_t moves = 0, moved = 0, contacts = 0;

  void print(const char* world) const {
    const auto number = [](auto n) { return static_cast<unsigned long long>(n); };
    std::printf("%s: %llu operations, %llu undecided\n  ", world, number(operations), number(undecided));
    for (std::size_t k = 0; k < replacements.names.size(); ++k)
      std::printf("%s %llu/%llu, ", replacements.names[k], number(replacements.made[k]),
                  number(replacements.tried[k]));
    std::printf(
        "relax %llu/%llu, close and fill %d/%d, open %d, excavate %d, split_vertex %llu/%llu, merge "
        "%llu/%llu (%llu "
        "held), cut %llu (%llu edges "
        "split, %llu vertices parted, %llu held, %llu facets slit), move %llu/%llu (%llu contacts)\n",
        number(improvements), number(relaxations), closings.made, closings.changes, growths.opened,
        growths.excavated, number(peeled), number(peels), number(merged), number(merges), number(merges_held),
        number(cuts), number(split), number(opened), number(held), number(slit), number(moved), number(moves),
        number(contacts));
    std::fflush(stdout);
  }
};

/// A grid in which much is solid.
template <int D>
class Operations_world : public Toggle_world<D> {
 public:
  using Base = Toggle_world<D>;
  using Base::environment, Base::snapshot, Base::random;

  Operations_world(std::uint64_t number, bool generic) : Base(number, generic), is_generic(generic) {
    const double solid = random.chance(0.5) ? random.real(0, 0.4) : random.real(0.6, 0.9);
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      if (random.chance(solid)) environment.fill(snapshot.cell(i));
    this->populate(5, 5);
  }

  const bool is_generic;
};

template <int D>
class Operations {
 public:
  using World = Operations_world<D>;

  Operations(World& world, Operation_tally& tally)
      : world_(world), snapshot_(world.snapshot), random_(world.random), tally_(tally) {}

  /// Some changes in one Reshaping; then bodies may move.
  void run_phase() {
    Body_counts uncounted;
    for (const auto& body : world_.bodies) body->leave_region(uncounted);
    const std::size_t count = 1 + random_.below(8);
    Reshaping<D> reshaping(world_.environment, world_.residents(), {.at_contact = At_contact::hold});
    before_ = world_.environment.certify();
    for (std::size_t k = 0; k < count; ++k) {
      may_move_boundary_ = false;
      ++tally_.operations;
      const char* const kind = operate(reshaping);
      SCOPED_TRACE(kind);
      ASSERT_FALSE(testing::Test::HasFatalFailure());
      expect_sound();
      if (testing::Test::HasFailure()) return;
    }
    reshaping.finish();
    for (const auto& body : world_.bodies) ASSERT_NO_THROW(body->validate());
    if (random_.chance(0.5)) world_.step_bodies();
  }

 private:
  const char* operate(Reshaping<D>& reshaping) {
    switch (random_.below(14)) {
      case 0:
      case 1:
      case 2:
      case 3:
        return toggle(reshaping), "open, close, excavate or fill";
      case 4:
      case 5:
      case 6:
        return replace_somewhere(reshaping), "a replacement";
      case 7:
        return relax(reshaping), "relax";
      case 8:
        return split_vertex(reshaping), "split_vertex";
      case 9:
        return cut(reshaping), "cut";
      case 10:
      case 11:
        return merge(reshaping), "merge";
      default:
        return move(reshaping), "move";
    }
  }

  void toggle(Reshaping<D>& reshaping) {
    toggle_somewhere<D>(world_, reshaping, tally_.closings, tally_.growths);
    EXPECT_EQ(tally_.closings.wrong(), 0) << tally_.closings.last;
  }

  void replace_somewhere(Reshaping<D>& reshaping) {
    auto request =
        some_replacement<D>(snapshot_, world_.cell(), random_, snapshot_.cell_count() < most_cells);
    if (request.kind == 4 && snapshot_.is_point(inserted_) && random_.chance(0.7)) {
      const std::vector<Cell> star = world_.environment.cells_around(inserted_);
      const auto others = snapshot_.view(star[random_.below(star.size())]).vertices;
      request.u = inserted_;
      request.v = others[random_.below(others.size())];
      if (request.u == request.v) return;
    }
    const std::optional<bool> expected = Replacement_judge<D>(snapshot_).may_be_made(request);
    ++tally_.replacements.tried[request.kind];
    const Replacement result = replace(reshaping, request);
    tally_.replacements.made[request.kind] += result.is_made;
    EXPECT_EQ(result.reason.empty(), result.is_made);
    if (expected)
      EXPECT_EQ(result.is_made, *expected) << Replacement_tally::names[request.kind] << ": " << result.reason;
    else
      ++tally_.undecided;
    if (result.is_made && request.kind < 2) inserted_ = result.point;
    expects_same_volumes_ = true;
  }

  void relax(Reshaping<D>& reshaping) {
    const auto vertices = snapshot_.view(world_.cell()).vertices;
    const std::vector<std::uint32_t> points(vertices.begin(), vertices.end());
    Relax_options options;
    options.good_enough = random_.real(0.2, 0.9);
    options.most_operations = 4;
    const Relax_report report = reshaping.relax(points, options);
    ++tally_.relaxations;
    tally_.improvements += report.operations();
    EXPECT_LE(report.operations(), options.most_operations);
    expects_same_volumes_ = true;
  }

  /// Solid cells at a vertex, in front of it along some direction or all.
  void split_vertex(Reshaping<D>& reshaping) {
    std::vector<Cell> solid;
    for (int tries = 0; tries < 50 && solid.empty(); ++tries)
      if (const Cell c = world_.cell(); snapshot_.is_solid(c)) solid = {c};
    if (solid.empty()) return;
    const std::uint32_t vertex = snapshot_.view(solid[0]).point_index(random_.below(D + 1));
    const Point<D> from = snapshot_.point(vertex);
    const bool takes_all = random_.chance(0.3);
    for (std::size_t i = 0; i < solid.size(); ++i)
      for (std::size_t k = 0; k <= D; ++k) {
        const Half_facet f = Snapshot<D>::half_facet(solid[i], k);
        const Cell other = snapshot_.neighbour(f);
        const auto loop = snapshot_.loop(f);
        if (other != Cell::none && snapshot_.is_solid(other) &&
            std::ranges::find(loop, vertex) != loop.end() && std::ranges::find(solid, other) == solid.end() &&
            (takes_all || random_.chance(0.4)))
          solid.push_back(other);
      }
    Vector<D> into{};
    for (const Cell c : solid) into = into + (middle_of(snapshot_, c) - from);
    Point<D> target = from + (random_.real(0, 1) / static_cast<double>(solid.size())) * into;
    if (random_.chance(0.1)) target = from;
    const bool expected = Replacement_judge<D>(snapshot_).may_be_taken_back(vertex, solid, target);
    const Replacement result = reshaping.split_vertex(vertex, solid, target);
    ++tally_.peels;
    tally_.peeled += result.is_made;
    EXPECT_EQ(result.is_made, expected) << result.reason;
    EXPECT_EQ(result.reason.empty(), result.is_made);
  }

  /// A point that was taken back and the one that it was taken from, or any two of a cell.
  void merge(Reshaping<D>& reshaping) {
    const auto vertices = snapshot_.view(world_.cell()).vertices;
    std::array<std::uint32_t, 2> pair{vertices[random_.below(D + 1)], vertices[random_.below(D + 1)]};
    if (!stitches_.empty() && random_.chance(0.6)) {
      pair = stitches_.back();
      stitches_.pop_back();
      if (!snapshot_.is_point(pair[0]) || !snapshot_.is_point(pair[1])) return;
    }
    if (pair[0] == pair[1]) return;
    const std::vector<Cell> star = world_.environment.cells_around(pair[0]);
    const bool may_be = Replacement_judge<D>(snapshot_).may_be_merged(pair[0], pair[1]);
    const bool is_empty = !has_any(star, false), has_inside = has_any(star, true);
    const Replacement result = reshaping.merge_vertices(pair[0], pair[1]);
    ++tally_.merges;
    tally_.merged += result.is_made;
    tally_.merges_held += !result.held_by.empty();
    EXPECT_EQ(result.reason.empty(), result.is_made);
    EXPECT_LE(result.is_made + !result.held_by.empty(), 1);
    EXPECT_EQ(result.is_made || !result.held_by.empty(), may_be) << result.reason;
    if (is_empty) {
      EXPECT_TRUE(result.held_by.empty()) << "nothing lies there";
    }
    if (has_inside) {
      EXPECT_FALSE(result.is_made) << "something lies in a free cell";
    }
  }

  /// Whether a vertex lies in one of some free cells, strictly; or else, whether anything may touch one.
  bool has_any(const std::vector<Cell>& cells, bool strictly) const {
    for (const Cell c : cells) {
      if (snapshot_.is_solid(c)) continue;
      const detail::Box<D> box = detail::box_of<D>(snapshot_, std::vector<Cell>{c});
      const auto meets = [&](const std::vector<Point<D>>& points) {
        detail::Box<D> own;
        for (const Point<D>& x : points) own.extend(x);
        return !strictly && own.meets(box);
      };
      const auto lies_in = [&](const Point<D>& x) {
        if (!strictly) return meets({x});
        Walk_counts uncounted;
        for (std::size_t k = 0; k < snapshot_.facet_count(c); ++k)
          if (detail::side<Exact>(snapshot_.view(c), k, x, uncounted) >= 0) return false;
        return true;
      };
      for (const auto& p : world_.particles)
        if (lies_in(p.position)) return true;
      for (const auto& body : world_.bodies) {
        for (const Point<D>& x : body->positions())
          if (lies_in(x)) return true;
        for (const auto& [u, v] : body->edges())
          if (meets({body->positions()[u], body->positions()[v]})) return true;
        for (const auto& [u, v, w] : body->faces())
          if (meets({body->positions()[u], body->positions()[v], body->positions()[w]})) return true;
      }
    }
    return false;
  }

  /// A line, a triangle, or two triangles that bend.
  static Blade<D> blade_of(const std::vector<Point<D>>& points) {
    if constexpr (D == 3)
      if (points.size() == 4) return {points, {{0, 1, 2}, {0, 2, 3}}};
    return blade_along<D>(points);
  }

  void cut(Reshaping<D>& reshaping) {
    if (snapshot_.cell_count() > most_cells) return;
    const Point<D> middle = middle_of(snapshot_, world_.cell());
    std::vector<Point<D>> points(D + random_.below(2), middle);
    for (Point<D>& x : points)
      for (double& c : x) {
        c += random_.real(-1.5, 1.5);
        if (!world_.is_generic || random_.chance(0.2)) c = std::round(2 * c) / 2;
      }
    Cut_report report;
    try {
      report = reshaping.cut(blade_of(points),
                             {.opening = std::ldexp(0.02, 4 * static_cast<int>(random_.below(3)))});
    } catch (const Error& e) {
      ASSERT_EQ(e.code(), Error_code::input) << e.what();  // the points lie in line
      return;
    }
    ++tally_.cuts;
    tally_.split += report.split;
    tally_.opened += report.opened;
    tally_.held += report.held;
    tally_.slit += report.slit;
    for (const Cut_point& made : report.points)
      if (made.between[0] == made.between[1]) stitches_.push_back({made.point, made.between[0]});
    expects_more_vertices_ = report.points.size();
  }

  void move(Reshaping<D>& reshaping) {
    const auto vertices = snapshot_.view(world_.cell()).vertices;
    const std::uint32_t v = vertices[random_.below(vertices.size())];
    const Point<D> from = snapshot_.point(v);
    Point<D> target = from;
    const std::vector<Cell> star = world_.environment.cells_around(v);
    for (int i = 0; i < 2; ++i) {
      const auto others = snapshot_.view(star[random_.below(star.size())]).vertices;
      const double share =
          world_.is_generic ? random_.real(-0.4, 0.6) : static_cast<double>(random_.below(9)) / 8 - 0.5;
      target = target + share * (snapshot_.point(others[random_.below(others.size())]) - from);
    }
    if (!world_.is_generic)
      for (double& c : target) c = std::round(64 * c) / 64;
    typename Wall_judge<D, World>::Tally tally;
    Wall_judge<D, World> judge(world_, tally);
    const Vertex_result<D> result = judge.judge(reshaping, v, target, random_.chance(0.1));
    EXPECT_EQ(tally.wrong(), 0) << "missed " << tally.missed << ", false blocks " << tally.false_blocks
                                << ", times " << tally.wrong_times << ", sides " << tally.wrong_sides
                                << ", ends " << tally.wrong_ends << ", tunnels " << tally.tunnels
                                << ", fates " << tally.fates.wrong();
    ++tally_.moves;
    tally_.moved += result.end == Move_end::reached && snapshot_.point(v) != from;
    tally_.contacts += result.end == Move_end::contact;
    may_move_boundary_ = true;
  }

  /// All cells, counts and registrations.
  void expect_sound() {
    Certificate now;
    ASSERT_NO_THROW(now = world_.environment.certify());
    const std::size_t euler =
        D == 2 ? now.vertices + now.cells - now.facets : now.vertices + now.facets - now.ridges - now.cells;
    EXPECT_EQ(euler, 1u);
    if (!may_move_boundary_) {
      EXPECT_NEAR(now.volume, before_.volume, 1e-9 * before_.volume);
    }
    if (expects_same_volumes_) {
      EXPECT_NEAR(now.free_volume, before_.free_volume, 1e-9 * before_.volume);
      expects_same_volumes_ = false;
    }
    if (expects_more_vertices_) {
      EXPECT_EQ(now.vertices, before_.vertices + *expects_more_vertices_);
      EXPECT_GE(now.free_volume, before_.free_volume - 1e-9 * before_.volume);
      expects_more_vertices_.reset();
    }
    before_ = now;
    Walk_counts uncounted;
    for (const auto& p : world_.particles)
      ASSERT_TRUE(in_closure(snapshot_, p.cell, p.position) && !snapshot_.is_solid(p.cell));
    for (const auto& body : world_.bodies) {
      const auto particles = body->particles();
      for (std::size_t v = 0; v < particles.size(); ++v) {
        ASSERT_EQ(particles[v].position, body->positions()[v]);
        ASSERT_TRUE(in_closure(snapshot_, particles[v].cell, particles[v].position));
        ASSERT_FALSE(snapshot_.is_solid(particles[v].cell));
      }
      for (std::size_t e = 0; e < body->edges().size(); ++e) {
        const auto [u, v] = body->edges()[e];
        ASSERT_TRUE(is_chain(snapshot_, particles[u], particles[v], body->chain(e), uncounted));
      }
    }
  }

  static constexpr std::size_t most_cells = D == 2 ? 120 : 420;
  World& world_;
  const Snapshot<D>& snapshot_;
  Random& random_;
  Operation_tally& tally_;
  Certificate before_;
  std::uint32_t inserted_ = Replacement::none;
  std::vector<std::array<std::uint32_t, 2>> stitches_;  ///< of cuts, not sewn yet
  bool may_move_boundary_ = false, expects_same_volumes_ = false;
  std::optional<std::size_t> expects_more_vertices_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_OPERATIONS_SOAK_H
