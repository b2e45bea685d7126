// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies by the rule of traces among closed walls: a vertex stays if one meets its way or one of its edges
// where it goes. Where nothing touches a wall, what may not pass it is what meets it, so the same judge tells
// of either Touch.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "body/closed_walls.h"
#include "body/rejecting.h"
#include "body/rooms.h"
#include "body/with_regions.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Rejected_seen {
  int bodies = 0, steps = 0, moves = 0, by_vertex = 0, by_edges = 0, gone_round = 0, large = 0, starry = 0;
  int with_faces = 0, only_touch = 0, along_walls = 0;
  Body_counts counts;

  std::string summary() const {
    const Edge_counts& e = counts.edges;
    std::string text;
    const auto add = [&text](const char* name, auto count) {
      text += std::string(text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    };
    add("bodies", bodies), add("with more than 8 vertices", large),
        add("with more than 8 edges a vertex", starry);
    add("with faces", with_faces), add("steps", steps), add("moves", moves),
        add("in a region", counts.in_region);
    add("blocked vertices", by_vertex), add("by edges", by_edges), add("edges gone round", gone_round);
    add("by touch alone", only_touch), add("starts on walls", along_walls);
    add("in one cell", e.same_cell), add("of the same chain", e.same_chain);
    add("relinked", e.relinked), add("by events", e.event_sweeps);
    return text;
  }
};

/// Bodies of all sorts among solid cells and membranes, all on one lattice: coarse, so that much touches, or
/// so fine that nothing does.
template <int D>
class Rejection {
 public:
  Rejection(std::uint64_t seed, Touch touch, bool is_coarse, Rejected_seen& seen)
      : random_(seed),
        touch_(touch),
        unit_(is_coarse ? 0.25 : 0x1p-20),
        snapshot_(make_rooms()),
        locator_(snapshot_),
        walls_(snapshot_),
        seen_(seen) {}

  void run(int bodies, int steps) {
    for (int k = 0; k < bodies; ++k) {
      const Body_soup<D> soup = make_body();
      try {
        Body<D> body(snapshot_, locator_, soup);
        have_regions(body);
        ++seen_.bodies;
        seen_.large += soup.points.size() > 8;
        seen_.starry += body.neighbours(0).size() > 8;
        seen_.with_faces += !soup.faces.empty();
        follow(body, steps);
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), Error_code::outside) << error.what();  // no room there
      }
    }
  }

 private:
  static constexpr std::uint32_t cells = 4;

  Snapshot<D> make_rooms() {
    std::array<std::uint32_t, D> size;
    size.fill(cells);
    std::vector<std::uint32_t> solid;
    for (std::uint32_t c = 0; c < (D == 2 ? 16u : 64u); ++c)
      if (random_.chance(0.1)) solid.push_back(c);
    Snapshot<D> snapshot = rooms<D>(size, solid);
    for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
      for (std::size_t k = 0; k < 2 * D; ++k)
        if (random_.chance(D == 2 ? 0.1 : 0.04))
          snapshot.set_impassable(snapshot.half_facet(snapshot.cell(i), k), true);
    return snapshot;
  }

  double on_lattice(double x) const { return unit_ * std::round(x / unit_); }

  Body_soup<D> make_body() {
    Body_soup<D> soup;
    Point<D> middle;
    for (double& x : middle) x = random_.real(0, cells);
    const double size = random_.chance(0.5) ? 0.4 : 1;
    const auto vertices = static_cast<std::uint32_t>(1 + random_.below(14));
    const bool is_star = random_.chance(0.4);
    for (std::uint32_t v = 0; v < vertices; ++v) {
      Point<D>& x = soup.points.emplace_back();
      for (int i = 0; i < D; ++i) x[i] = on_lattice(middle[i] + random_.real(-size, size));
    }
    const auto joins = [&](std::uint32_t u, std::uint32_t v) {
      return is_star ? u == 0 : v < u + 3 && random_.chance(0.7);
    };
    for (std::uint32_t u = 0; u < vertices; ++u)
      for (std::uint32_t v = u + 1; v < vertices; ++v)
        if (joins(u, v)) soup.edges.push_back({u, v});
    if (D == 3 && random_.chance(0.5)) add_face(soup);
    return soup;
  }

  void add_face(Body_soup<D>& soup) {
    const auto& edges = soup.edges;
    for (const auto& [u, v] : edges)
      for (std::uint32_t w = v + 1; w < soup.points.size(); ++w)
        if (std::ranges::count(edges, std::array{u, w}) + std::ranges::count(edges, std::array{v, w}) == 2) {
          soup.faces.push_back({u, v, w});
          return;
        }
  }

  std::vector<Point<D>> targets(const std::vector<Point<D>>& positions) {
    Vector<D> drift;
    const double speed = random_.chance(0.5)   ? 0.1
                         : random_.chance(0.7) ? 0.5
                                               : 2,
                 tremble = random_.chance(0.5) ? 0.05 : 0.3;
    for (double& x : drift) x = random_.real(-speed, speed);
    std::vector<Point<D>> result = positions;
    for (Point<D>& x : result)
      for (int i = 0; i < D; ++i) x[i] = on_lattice(x[i] + drift[i] + random_.real(-tremble, tremble));
    return result;
  }

  /// The move of a vertex by definition.
  Rejected_move<D> expected(const Body<D>& body, const std::vector<Point<D>>& positions, std::uint32_t vertex,
                            const Point<D>& target, Sweep sweep) const {
    Rejected_move<D> answer;
    answer.vertex = vertex;
    answer.is_vertex_blocked = walls_.meet_segment(positions[vertex], target);
    if (answer.is_vertex_blocked) return answer;
    std::uint64_t bit = 1;
    for (const std::uint32_t other : body.neighbours(vertex)) {
      const Point<D>& q = positions[other];
      if (walls_.meet_segment(target, q)) answer.edges |= bit;
      if (sweep != Sweep::three_segments && walls_.meet_triangle(positions[vertex], target, q))
        answer.swept_edges |= bit;
      bit <<= 1;
    }
    return answer;
  }

  /// A contact names a wall and its point lies there: on the way of the vertex, or on an edge of it at that
  /// time.
  bool is_contact(const Contact<D>& c, const std::vector<Point<D>>& positions, const Point<D>& target) const {
    const Point<D>& from = positions[c.vertex];
    const Point<D> there = from + c.time * (target - from);
    bool is_there = false;
    if (c.body == Body_feature::vertex) {
      is_there = length(c.point - there) < 1e-6;
    } else if (c.body == Body_feature::edge) {
      const auto& [u, v] = edges_[c.feature];
      const Vector<D> along = positions[u == c.vertex ? v : u] - there;
      const double share =
          std::clamp(dot(c.point - there, along) / std::max(1e-300, dot(along, along)), 0.0, 1.0);
      is_there = (u == c.vertex || v == c.vertex) && length(there + share * along - c.point) < 1e-6;
    }
    return is_there && snapshot_.is_impassable(c.facet) && std::abs(length(c.normal) - 1) < 1e-9;
  }

  void follow(Body<D>& body, int steps) {
    std::vector<Point<D>> positions(body.positions().begin(), body.positions().end());
    edges_.assign(body.edges().begin(), body.edges().end());
    const Sweep sweeps[]{Sweep::three_segments, Sweep::triangle, Sweep::faces};
    const std::uint64_t sweep_of_all = random_.below(4);
    for (int step = 0; step < steps; ++step) {
      ++seen_.steps;
      const Sweep sweep = sweeps[sweep_of_all < 3 ? sweep_of_all : random_.below(3)];
      const bool clearance = random_.chance(0.5);
      const std::vector<Point<D>> to = targets(positions);
      seen_.along_walls +=
          std::ranges::any_of(positions, [&](const auto& x) { return walls_.meet_segment(x, x); });
      Body<D> passing = body;
      const auto [contacts, blocked] = reject<D>(body, to, rejecting(sweep, touch_, clearance), seen_.counts);
      auto contact = contacts.begin();
      auto given = blocked.begin();
      for (std::uint32_t v = 0; v < to.size(); ++v) {
        ++seen_.moves;
        const Rejected_move<D> truth = expected(body, positions, v, to[v], sweep);
        if (!truth.stays()) positions[v] = to[v];
        if (!truth.is_vertex_blocked && (truth.edges | truth.swept_edges) == 0) continue;
        ASSERT_TRUE(given != blocked.end() && given->vertex == v) << step << ": nothing blocks " << v;
        ASSERT_EQ(given->is_vertex_blocked, truth.is_vertex_blocked) << step << ": " << v;
        ASSERT_EQ(given->edges, truth.edges) << step << ": " << v;
        ASSERT_EQ(given->swept_edges, truth.swept_edges) << step << ": " << v;
        ASSERT_EQ(given->contact.has_value(), truth.stays());
        if (truth.stays()) {
          ASSERT_TRUE(snapshot_.is_impassable(given->contact->facet));
          ASSERT_TRUE(contact != contacts.end() && contact->vertex == v) << step << ": " << v;
          ASSERT_TRUE(is_contact(*contact, positions, to[v])) << step << ": " << v;
          ++contact;
        }
        seen_.by_vertex += truth.is_vertex_blocked;
        seen_.by_edges += truth.edges != 0;
        seen_.gone_round += (truth.swept_edges & ~truth.edges) != 0;
        ++given;
      }
      ASSERT_TRUE(given == blocked.end()) << step << ": " << given->vertex << " is blocked";
      ASSERT_TRUE(contact == contacts.end()) << step << ": " << contact->vertex << " meets something";
      ASSERT_TRUE(std::ranges::equal(body.positions(), positions)) << step;
      if (touch_ == Touch::stop) {
        Body_counts counts;
        seen_.only_touch +=
            reject<D>(passing, to, rejecting(sweep, Touch::pass, clearance), counts).blocked.size() !=
            blocked.size();
      }
      if (!random_.chance(0.2)) continue;
      body.refresh(seen_.counts);
      // Faces are left alone, and may be pierced; they are not asked about then.
      ASSERT_NO_THROW(body.validate()) << step;
    }
  }

  Random random_;
  const Touch touch_;
  const double unit_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const Closed_walls<D> walls_;
  std::vector<std::array<std::uint32_t, 2>> edges_;  ///< of the body
  Rejected_seen& seen_;
};

template <int D>
void expect_rejections(Touch touch, bool is_coarse) {
  Rejected_seen seen;
  const std::size_t worlds = oracle::scaled_count(20);
  for (std::uint64_t number = 0; number < worlds; ++number)
    Rejection<D>(1000 * D + number, touch, is_coarse, seen).run(80, 8);
  std::cout << seen.summary() << "\n";
  if (worlds < 20) return;  // too few to meet everything
  const Edge_counts& edges = seen.counts.edges;
  EXPECT_GT(seen.large, 100);
  EXPECT_GT(seen.starry, 40);
  EXPECT_GT(seen.by_vertex, 2000);
  EXPECT_GT(seen.by_edges, 300);
  EXPECT_GT(seen.gone_round, D == 2 ? 4 : 30);
  EXPECT_GT(seen.counts.in_region, 2000u);
  EXPECT_GT(edges.same_cell, 4000u);
  EXPECT_GT(edges.same_chain, 2000u);
  EXPECT_GT(edges.changed, 200u);
  EXPECT_GT(seen.with_faces, D == 3 ? 50 : -1);
  if (is_coarse) {
    EXPECT_GT(edges.relinked, 200u);
    EXPECT_GT(seen.only_touch, 2000);
    EXPECT_GT(seen.along_walls, 1000);
    EXPECT_GT(edges.event_sweeps, 50u);
  }
}

TEST(BodyReject, AmongWallsThatNothingTouches2) { expect_rejections<2>(Touch::pass, false); }
TEST(BodyReject, AmongWallsThatNothingTouches3) { expect_rejections<3>(Touch::pass, false); }
TEST(BodyReject, WhatPassesNothingTouchesNothing2) { expect_rejections<2>(Touch::stop, false); }
TEST(BodyReject, WhatPassesNothingTouchesNothing3) { expect_rejections<3>(Touch::stop, false); }
TEST(BodyReject, TouchesAreInTheWay2) { expect_rejections<2>(Touch::stop, true); }
TEST(BodyReject, TouchesAreInTheWay3) { expect_rejections<3>(Touch::stop, true); }

}  // namespace
}  // namespace cellwalk::test
