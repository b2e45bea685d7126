// SPDX-License-Identifier: LGPL-3.0-or-later
// Calls that are refused change nothing: targets that are not finite, too few or too many of them, vertices
// that are not there. A twin that was not called goes on with the same bytes.
#include <cellwalk/body/body.h>
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "body/rooms.h"

namespace cellwalk::test {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double not_finite_numbers[] = {not_a_number, -not_a_number, unbounded, -unbounded};

template <int D>
using Refused_call = std::function<void(Body<D>&, Step_report<D>&, Body_counts&)>;

template <int D>
std::vector<Point<D>> shifted_targets(const Body<D>& body, const Vector<D>& by) {
  std::vector<Point<D>> targets;
  for (const Point<D>& x : body.positions()) targets.push_back(x + by);
  return targets;
}

/// How a body may be stepped.
std::vector<Body_options> ways_to_step() {
  std::vector<Body_options> ways(6);
  ways[1].clearance = false;
  ways[2].sweep.sweep = Sweep::three_segments;
  ways[3].sweep.sweep = Sweep::faces;
  ways[4].rule = Step_rule::reject_at_target;
  ways[5] = ways[4];
  ways[5].reports_blocked = true;
  ways[5].sweep.touch = Touch::stop;
  return ways;
}

template <int D>
class RefusedCalls : public ::testing::Test {
 protected:
  RefusedCalls() : snapshot_(rooms<D>(cells(), {5})), locator_(snapshot_) {}

  static std::array<std::uint32_t, D> cells() {
    std::array<std::uint32_t, D> result;
    result.fill(4);
    return result;
  }
  static Vector<D> along(double x) {
    Vector<D> v{};
    v[0] = x;
    v[D - 1] = 0.25 * x;
    return v;
  }

  Body<D> body_of(Body_soup<D> soup) const {
    Body_placement<D> placement;
    placement.position.fill(2.5);
    return Body<D>(snapshot_, locator_, transformed(std::move(soup), placement));
  }
  Body<D> box(double side = 0.375) const {
    if constexpr (D == 2)
      return body_of(quad_body(side));
    else
      return body_of(hexahedron_body(side, true));
  }
  /// Where it starts; in a region free of walls; at a wall.
  static void bring_to(int state, Body<D>& body, const Body_options& options) {
    Step_report<D> report;
    Body_counts counts;
    for (int k = 0; k < (state == 0 ? 0 : state == 1 ? 3 : 12); ++k)
      body.step(shifted_targets<D>(body, along(state == 1 ? 0.015625 : 0.25)), options, report, counts);
  }

  /// Makes a call that is to be refused, and lets body and twin go on.
  void expect_refused(Body<D>& body, Error_code code, const std::string& said, const Refused_call<D>& call) {
    Body<D> twin = body;
    Step_report<D> report;
    Body_counts counts;
    const auto counted = [](const Body_counts& c) { return std::bit_cast<Count_array<Body_counts>>(c); };
    ++calls_;
    try {
      call(body, report, counts);
      ADD_FAILURE() << "accepted: " << said;
      return;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
    EXPECT_TRUE(report.contacts.empty() && report.blocked.empty());
    EXPECT_EQ(counted(counts), counted({}));
    ASSERT_EQ(save(body), save(twin)) << said;
    // A motion that leaves the environment: what a wall was lost on would pass it.
    Body_counts of_body, of_twin;
    Step_report<D> met, met_by_twin;
    const auto targets = shifted_targets<D>(body, along(4));
    body.step(targets, {}, met, of_body);
    twin.step(targets, {}, met_by_twin, of_twin);
    EXPECT_FALSE(met.contacts.empty());
    EXPECT_EQ(counted(of_body), counted(of_twin));
    EXPECT_EQ(save(body), save(twin));
    body.refresh(of_body);
    EXPECT_NO_THROW(body.validate());
  }

  Snapshot<D> snapshot_;
  Locator<D> locator_;
  int calls_ = 0;
};

template <class Dimension>
class RefusedCallsOf : public RefusedCalls<Dimension::value> {};
using Refused_call_dimensions =
    ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RefusedCallsOf, Refused_call_dimensions);

TYPED_TEST(RefusedCallsOf, TargetsThatAreNotFinite) {
  constexpr int D = TypeParam::value;
  for (const Body_options& way : ways_to_step())
    for (const int state : {0, 1, 2}) {
      Body<D> start = this->box();
      this->bring_to(state, start, way);
      for (std::size_t v = 0; v < start.vertex_count(); ++v)
        for (std::size_t k = 0; k < D; ++k) {
          const double bad = not_finite_numbers[(v + k + static_cast<std::size_t>(state)) % 4];
          Body<D> body = start;
          auto targets = shifted_targets<D>(body, this->along(0.015625));
          targets[v][k] = bad;
          this->expect_refused(
              body, Error_code::input,
              "the target of vertex " + std::to_string(v) + " of a body is not finite",
              [&](auto& b, auto& report, auto& counts) { b.step(targets, way, report, counts); });
        }
    }
  EXPECT_GE(this->calls_, 100);
}

TYPED_TEST(RefusedCallsOf, AnyOfManyTargetsThatAreNotFinite) {
  constexpr int D = TypeParam::value;
  for (const std::uint32_t count : {1u, 2u, 3u, 5u, 8u, 2400u})
    for (const double bad : not_finite_numbers)
      for (const std::uint32_t v : {0u, 1u, count / 2, count - 1}) {
        if (v >= count) continue;
        Body<D> body = this->body_of(catheter_body<D>(0.75, std::max(2u, count)));
        auto targets = shifted_targets<D>(body, this->along(0.015625));
        targets[v][v % D] = bad;
        Body_options options;
        this->expect_refused(
            body, Error_code::input, "the target of vertex " + std::to_string(v),
            [&](auto& b, auto& report, auto& counts) { b.step(targets, options, report, counts); });
      }
  EXPECT_GE(this->calls_, 80);
}

TYPED_TEST(RefusedCallsOf, MovesOfAVertex) {
  constexpr int D = TypeParam::value;
  Body<D> start = this->box();
  this->bring_to(1, start, {});
  const auto count = static_cast<std::uint32_t>(start.vertex_count());
  for (const double bad : not_finite_numbers)
    for (std::uint32_t v = 0; v < count; ++v) {
      Body<D> body = start;
      Point<D> target = body.positions()[v];
      target[v % D] = bad;
      this->expect_refused(body, Error_code::input, "the target of a vertex is not finite",
                           [&](auto& b, auto&, auto& counts) { b.move_vertex(v, target, {}, counts); });
    }
  for (const std::uint32_t v : {count, count + 1, 0x7fffffffu, 0xffffffffu}) {
    Body<D> body = start;
    this->expect_refused(body, Error_code::usage, "there is no vertex",
                         [&](auto& b, auto&, auto& counts) { b.move_vertex(v, Point<D>{}, {}, counts); });
    EXPECT_THROW(start.neighbours(v), Error);
    EXPECT_THROW(start.cell_of(v), Error);
    EXPECT_THROW(start.chain(v + start.edges().size() - count), Error);
  }
}

TYPED_TEST(RefusedCallsOf, TooFewOrTooManyTargets) {
  constexpr int D = TypeParam::value;
  Body<D> start = this->box();
  this->bring_to(1, start, {});
  for (std::size_t count = 0; count < 64; ++count) {
    if (count == start.vertex_count()) continue;
    Body<D> body = start;
    const std::vector<Point<D>> targets(count, body.positions()[0]);
    for (const Body_options& way : ways_to_step())
      this->expect_refused(
          body, Error_code::usage, std::to_string(count) + " targets are given",
          [&](auto& b, auto& report, auto& counts) { b.step(targets, way, report, counts); });
  }
}

TYPED_TEST(RefusedCallsOf, SearchesThatNeedNotEnd) {
  constexpr int D = TypeParam::value;
  for (const double bad : {not_a_number, 0.0, -1.0, 1.5, unbounded})
    for (const auto method : {Contact_search::dichotomic, Contact_search::dichotomic_segment}) {
      Body<D> body = this->box();
      Body_options options;
      const Search_options search{method, bad};
      options.sweep.search = &search;
      const auto targets = shifted_targets<D>(body, this->along(4));
      this->expect_refused(body, Error_code::usage, "tolerance", [&](auto& b, auto& report, auto& counts) {
        b.step(targets, options, report, counts);
      });
      this->expect_refused(body, Error_code::usage, "tolerance", [&](auto& b, auto&, auto& counts) {
        b.move_vertex(0, targets[0], options, counts);
      });
    }
}

TYPED_TEST(RefusedCallsOf, StartsThatAreNotFinite) {
  constexpr int D = TypeParam::value;
  int refused = 0;
  const Body<D> box = this->box();
  const Body_soup<D> good{{box.positions().begin(), box.positions().end()},
                          {box.edges().begin(), box.edges().end()},
                          {box.faces().begin(), box.faces().end()}};
  for (const double bad : not_finite_numbers)
    for (std::size_t v = 0; v < good.points.size(); ++v)
      for (std::size_t k = 0; k < D; ++k) {
        Body_soup<D> soup = good;
        soup.points[v][k] = bad;
        try {
          const Body<D> body(this->snapshot_, this->locator_, soup);
          ADD_FAILURE() << v;
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), Error_code::input);
          EXPECT_EQ(std::string(error.what()),
                    "vertex " + std::to_string(v) + " of the body is not finite: correct its coordinates");
          ++refused;
        }
      }
  EXPECT_EQ(refused, 4 * D * static_cast<int>(good.points.size()));
}

TYPED_TEST(RefusedCallsOf, ValidationOfWhatIsNotRegisteredYet) {
  constexpr int D = TypeParam::value;
  Body<D> body = this->box();
  this->bring_to(1, body, {});
  try {
    body.validate();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::usage);
    EXPECT_NE(std::string(error.what()).find("Body::refresh()"), std::string::npos);
  }
  Body_counts counts;
  body.refresh(counts);
  EXPECT_NO_THROW(body.validate());
}

// Bodies, locators and worlds refer to a snapshot: one that ends with the statement does not compile.
static_assert(std::is_constructible_v<Locator<3>, Snapshot<3>&>);
static_assert(!std::is_constructible_v<Locator<3>, Snapshot<3>>);
static_assert(std::is_constructible_v<Body<3>, Snapshot<3>&, Locator<3>&, Body_soup<3>>);
static_assert(!std::is_constructible_v<Body<3>, Snapshot<3>, Locator<3>&, Body_soup<3>>);

}  // namespace
}  // namespace cellwalk::test
