// SPDX-License-Identifier: LGPL-3.0-or-later
// Regions of bodies of many vertices, with any history: nothing shows them.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "body/rooms.h"
#include "body/with_regions.h"

namespace cellwalk::test {
namespace {

/// A cloth of so many vertices a side, level above the solid cells.
Body_soup<3> cloth(std::uint32_t side, double spacing) {
  Body_soup<3> soup;
  const auto at = [side](std::uint32_t i, std::uint32_t j) { return i * side + j; };
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      soup.points.push_back({0.3 + spacing * i, 0.3 + spacing * j, 2.2});
      if (i > 0) soup.edges.push_back({at(i - 1, j), at(i, j)});
      if (j > 0) soup.edges.push_back({at(i, j - 1), at(i, j)});
      if (i == 0 || j == 0) continue;
      soup.edges.push_back({at(i - 1, j - 1), at(i, j)});
      soup.faces.push_back({at(i - 1, j - 1), at(i - 1, j), at(i, j)});
      soup.faces.push_back({at(i - 1, j - 1), at(i, j - 1), at(i, j)});
    }
  std::ranges::sort(soup.edges);
  return soup;
}

struct Motion {
  std::string name;
  Body_options options;
  double fall = 0, ripple = 0;  ///< a step
  int steps = 0, falling_steps = 50;
};

/// What a motion leaves behind.
struct Outcome {
  std::vector<Point<3>> positions;
  std::vector<std::array<std::uint64_t, 4>> contacts;  ///< vertex, time, feature, kinds
  std::vector<std::array<std::uint64_t, 4>> blocked;
  Body_counts counts;
};

Outcome outcome_of(const Body<3>& start, const Motion& motion) {
  Body<3> body = start;
  Outcome result;
  Step_report<3> report;
  Random random(7);
  for (int k = 0; k < motion.steps; ++k) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    const double fall = k < motion.falling_steps ? motion.fall : 0.001;
    // Waves push neighbours apart, so that some go where others wait.
    for (std::size_t v = 0; v < targets.size(); ++v) {
      const double wave = std::sin(0.4 * static_cast<double>(v) + 0.3 * k);
      targets[v] = targets[v] + Vector<3>{motion.ripple * random.real(-1, 1), motion.ripple * wave,
                                          motion.ripple * random.real(-1, 1) - fall};
    }
    report.clear();
    body.step(targets, motion.options, report, result.counts);
    for (const Contact<3>& met : report.contacts)
      result.contacts.push_back(
          {met.vertex, std::bit_cast<std::uint64_t>(met.time), met.feature,
           static_cast<std::uint64_t>(met.body) << 8 | static_cast<std::uint64_t>(met.kind)});
    for (const Rejected_move<3>& move : report.blocked)
      result.blocked.push_back({move.vertex, move.is_vertex_blocked, move.edges, move.swept_edges});
  }
  result.positions.assign(body.positions().begin(), body.positions().end());
  body.refresh(result.counts);
  EXPECT_NO_THROW(body.validate());
  return result;
}

Body_options at_target(Sweep sweep, Touch touch, bool reports_blocked) {
  Body_options options;
  options.sweep = {.sweep = sweep, .touch = touch};
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = reports_blocked;
  return options;
}

std::vector<Motion> motions() {
  Body_options slides, rejects, with_faces;
  rejects.rule = Step_rule::reject;
  with_faces.sweep.sweep = Sweep::faces;
  return {{"falls and slides", slides, 0.03, 0.02, 50},
          {"comes to rest", slides, 0.05, 0.002, 60, 25},
          {"with faces", with_faces, 0.05, 0.01, 25},
          {"rejects", rejects, 0.03, 0.02, 40},
          {"by the rule of traces", at_target(Sweep::triangle, Touch::pass, true), 0.03, 0.02, 50},
          {"by segments", at_target(Sweep::three_segments, Touch::stop, false), 0.03, 0.02, 50}};
}

/// Obstacles of a cell each, which the cloth falls upon, on a floor.
Snapshot<3> obstacle_course() { return rooms<3>({4, 4, 3}, {5, 10, 3, 28}); }

void expect_nothing_shows(std::uint32_t side, double spacing) {
  const Snapshot<3> snapshot = obstacle_course();
  const Body<3> start(snapshot, Locator<3>(snapshot), cloth(side, spacing));
  for (const Motion& motion : motions()) {
    SCOPED_TRACE(motion.name);
    Motion plain = motion;
    plain.options.clearance = false;
    const Outcome expected = outcome_of(start, plain);
    const Outcome one = outcome_of(start, motion);
    EXPECT_EQ(one.positions, expected.positions);
    EXPECT_EQ(one.contacts, expected.contacts);
    EXPECT_EQ(one.blocked, expected.blocked);
    EXPECT_GT(2 * one.counts.in_region, one.counts.moves);
    EXPECT_GT(one.counts.contacts, one.counts.moves / 200);
  }
}

TEST(LargeBodies, NothingShows) { expect_nothing_shows(46, 0.065); }
TEST(LargeBodies, NothingShowsOfLongEdges) { expect_nothing_shows(14, 0.23); }

/// Chains of three vertices, each about a corner of a solid cell. Again and again, some vertices go to one of
/// few places of theirs, so that regions hold most ways, while the corners are in the way of others.
template <int D>
class Chains_about_corners {
 public:
  Chains_about_corners(const Snapshot<D>& snapshot, std::uint64_t seed) : snapshot_(snapshot), random_(seed) {
    const Locator<D> locator(snapshot);
    for (std::uint32_t number = 0; number < 60; ++number) {
      Point<D> corner;
      for (double& x : corner) x = static_cast<double>(1 + random_.below(8));
      for (std::uint32_t k = 0; k < 3; ++k) {
        places_.emplace_back();
        while (places_.back().size() < 3)
          if (const Point<D> x = near(corner); locator.particle_at(x)) places_.back().push_back(x);
        soup_.points.push_back(places_.back().front());
      }
      // Some chains come in order, of others the vertex in the middle is the first or the last.
      const std::uint32_t first = 3 * number, middle = first + (number % 4 < 3 ? number % 4 : 1);
      for (std::uint32_t v = first; v < first + 3; ++v)
        if (v != middle) soup_.edges.push_back({std::min(v, middle), std::max(v, middle)});
    }
    std::ranges::sort(soup_.edges);
    place(locator);
  }

  /// Compares with a body that has no regions. Returns what was counted.
  Body_counts run(const Body_options& options, int steps) {
    Body<D> body = *start_, plain = *start_;
    Body_options without = options;
    without.clearance = false;
    Body_counts counts, of_plain;
    for (int k = 0; k < steps; ++k) {
      std::vector<Point<D>> targets(body.positions().begin(), body.positions().end());
      for (std::size_t v = 0; v < targets.size(); ++v)
        if (random_.below(2) == 0) targets[v] = places_[v][random_.below(3)];
      Step_report<D> report, expected;
      body.step(targets, options, report, counts);
      plain.step(targets, without, expected, of_plain);
      EXPECT_TRUE(std::ranges::equal(body.positions(), plain.positions())) << "step " << k;
      EXPECT_EQ(report.contacts.size(), expected.contacts.size()) << "step " << k;
      for (std::size_t i = 0; i < std::min(report.contacts.size(), expected.contacts.size()); ++i) {
        EXPECT_EQ(report.contacts[i].vertex, expected.contacts[i].vertex) << "step " << k;
        EXPECT_EQ(report.contacts[i].exact_time(), expected.contacts[i].exact_time()) << "step " << k;
      }
      if (!std::ranges::equal(body.positions(), plain.positions())) break;
    }
    body.refresh(counts);
    EXPECT_NO_THROW(body.validate());
    return counts;
  }

 private:
  Point<D> near(const Point<D>& corner) {
    Point<D> x = corner;
    for (double& c : x) c += random_.real(-0.6, 0.6);
    return x;
  }

  /// Chains through a solid cell are pulled together.
  void place(const Locator<D>& locator) {
    for (std::uint32_t v = 0; v < soup_.points.size(); v += 3)
      for (;;) {
        Body_soup<D> chain{
            {soup_.points.begin() + v, soup_.points.begin() + v + 3}, {{0, 1}, {0, 2}, {1, 2}}, {}};
        try {
          Body<D>(snapshot_, locator, chain);
          break;
        } catch (const Error&) {
          for (std::uint32_t u = v + 1; u < v + 3; ++u)
            soup_.points[u] = soup_.points[v] + 0.5 * (soup_.points[u] - soup_.points[v]);
        }
      }
    start_.emplace(snapshot_, locator, soup_);
    have_regions(*start_);
  }

  const Snapshot<D>& snapshot_;
  Random random_;
  Body_soup<D> soup_;
  std::vector<std::vector<Point<D>>> places_;  ///< of each vertex
  std::optional<Body<D>> start_;
};

template <int D>
void expect_nothing_shows_at_corners(const Snapshot<D>& snapshot) {
  Body_options slides, rejects;
  rejects.rule = Step_rule::reject;
  for (const Body_options& options : {slides, rejects, at_target(Sweep::triangle, Touch::pass, false),
                                      at_target(Sweep::three_segments, Touch::stop, false)}) {
    SCOPED_TRACE(static_cast<int>(options.rule) + 3 * static_cast<int>(options.sweep.sweep));
    const Body_counts counts = Chains_about_corners<D>(snapshot, 5).run(options, 1500);
    EXPECT_GT(6 * counts.in_region, counts.moves);
    EXPECT_GT(20 * counts.contacts, counts.moves);
  }
}

TEST(LargeBodies, NothingShowsAtCorners2) {
  std::vector<std::uint32_t> solid;
  for (std::uint32_t i = 1; i < 9; i += 2)
    for (std::uint32_t j = 1; j < 9; j += 2) solid.push_back(9 * i + j);
  expect_nothing_shows_at_corners(rooms<2>({9, 9}, solid));
}
TEST(LargeBodies, NothingShowsAtCorners3) {
  std::vector<std::uint32_t> solid;
  for (std::uint32_t i = 1; i < 9; i += 2)
    for (std::uint32_t j = 1; j < 9; j += 2)
      for (std::uint32_t k = 1; k < 9; k += 2) solid.push_back(81 * i + 9 * j + k);
  expect_nothing_shows_at_corners(rooms<3>({9, 9, 9}, solid));
}

}  // namespace
}  // namespace cellwalk::test
