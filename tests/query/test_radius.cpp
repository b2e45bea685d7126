// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions with a radius in rooms in which their answers are known by heart.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "edge/relisted.h"
#include "edge/thick_rooms.h"
#include "query/refusal.h"
#include "query/thick_cases.h"
#include "query/thick_judge.h"

namespace cellwalk::test {
namespace {

template <int D>
class Room_under_test {
 public:
  explicit Room_under_test(Environment<D> environment)
      : environment_(std::move(environment)),
        locator_(environment_.snapshot()),
        judge_(environment_.snapshot()) {}

  Answer<D> answer(const Thick_motion<D>& motion, bool is_particle = false) const {
    Edge_counts counts;
    if (is_particle)
      return answer_move<D>(environment_.snapshot(), locator_, motion.p, motion.target, {}, counts,
                            motion.radius);
    return answer_sweep<D>(environment_.snapshot(), locator_,
                           {motion.p, motion.target, motion.q, motion.radius}, {}, counts);
  }

  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }
  const Locator<D>& locator() const { return locator_; }
  const Thick_judge<D>& judge() const { return judge_; }

 private:
  Environment<D> environment_;
  Locator<D> locator_;
  Thick_judge<D> judge_;
};

/// The first dimensions of what is given in three.
template <int D>
Point<D> cut(const std::array<double, 3>& x) {
  Point<D> y;
  std::copy_n(x.begin(), D, y.begin());
  return y;
}

Exact_time quotient(double numerator, double denominator) {
  return to_time(cellwalk::Fraction(Ring(numerator), Ring(denominator)));
}

/// \param has_whole_walls no wall of the case is parted into several facets
template <int D>
void expect_case(const Room_under_test<D>& room, const Thick_case& c, bool has_whole_walls) {
  SCOPED_TRACE(c.name);
  const bool is_particle = !c.q;
  const Thick_motion<D> motion{cut<D>(c.p), cut<D>(c.target), cut<D>(c.q.value_or(c.p)), c.radius};
  const Thick_truth<D> truth = room.judge().truth_of(motion);
  const Thick_answer& expected = c.answer;
  // The judge itself has to find what is known.
  ASSERT_EQ(truth.status(), expected.status);
  if (expected.status == Motion_status::free) {
    const Fraction square =
        room.judge().oracle().square_to_walls(std::array{motion.p, motion.target, motion.q});
    EXPECT_EQ(square == Fraction(c.radius) * Fraction(c.radius), expected.touches);
  }
  const Answer<D> answer = room.answer(motion, is_particle);
  ASSERT_EQ(room.judge().fault_of(answer, motion, truth), "");
  if (expected.status == Motion_status::free) return;
  const Contact<D>& contact = *answer.contact;
  if (expected.status == Motion_status::close) {
    EXPECT_GE(contact.distance, std::nextafter(expected.distance, 0.));
    EXPECT_LE(contact.distance, expected.distance);
    return;
  }
  EXPECT_EQ(contact.time, expected.time);
  const auto [numerator, denominator] = expected.exact;
  if (denominator != 0) {
    EXPECT_TRUE(contact.exact_time() == quotient(numerator, denominator));
  }
  EXPECT_EQ(static_cast<int>(contact.body), static_cast<int>(expected.body));
  if (has_whole_walls) {
    EXPECT_EQ(static_cast<int>(contact.kind), static_cast<int>(expected.kind));
  }
  double least = 3;
  for (const auto& normal : expected.normals)
    least = std::min(least, length(contact.normal - cut<D>(normal)));
  EXPECT_LT(least, 1e-6);
  EXPECT_EQ(contact.distance, 0);
}

template <int D>
void expect_cases(Room name, const Room_under_test<D>& room, bool has_whole_walls, int count) {
  for (const Thick_case& c : thick_cases()) {
    if (c.room != name) continue;
    expect_case<D>(room, c, has_whole_walls);
    --count;
  }
  EXPECT_EQ(count, 0) << "cases";
}

TEST(Radius, MembraneOfOneFacet) {
  const Room_under_test<3> room(room_of(membranes_in_box({0, 0, 0}, {8, 8, 8}, {4})));
  expect_cases(Room::membrane, room, true, 27);
}

TEST(Radius, MembraneOfSeveralFacets) {
  for (const std::uint64_t seed : {0, 1, 2, 3}) {
    Cell_soup<3> soup = membrane_in_cubes();
    if (seed > 0) soup = relisted(soup, seed).soup;
    expect_cases(Room::membrane, Room_under_test<3>(room_of(std::move(soup))), false, 27);
  }
}

TEST(Radius, MembraneInThePlane) {
  expect_cases(Room::plane, Room_under_test<2>(room_of(membrane_in_square())), true, 5);
  for (const std::uint64_t seed : {0, 1, 2, 3}) {
    Cell_soup<2> soup = membrane_in_squares();
    if (seed > 0) soup = relisted(soup, seed).soup;
    expect_cases(Room::plane, Room_under_test<2>(room_of(std::move(soup))), false, 5);
  }
}

TEST(Radius, Step) { expect_cases(Room::step, Room_under_test<3>(room_of(step_in_box())), true, 6); }

TEST(Radius, Channel) {
  const Room_under_test<3> room(room_of(stretched<3>(oracle::make_cubes(1, 1, 1), {8, 8, 2})));
  expect_cases(Room::channel, room, true, 3);
  // The same channel through many cells.
  const Room_under_test<3> cells(room_of(stretched<3>(oracle::make_cubes(8, 8, 3), {1, 1, 2. / 4})));
  const Thick_motion<3> along{{2, 4, 0.75}, {6, 4, 0.75}, {1, 4, 0.75}, 0.75};
  EXPECT_EQ(cells.judge().fault_of(cells.answer(along), along, cells.judge().truth_of(along)), "");
}

TEST(Radius, Wedge) { expect_cases(Room::wedge, Room_under_test<3>(room_of(wedge())), true, 2); }

TEST(Radius, Spike) {
  const std::vector<Point<3>> inside{{2, 2, 6}, {6, 6, 6}};
  expect_cases(Room::spike,
               Room_under_test<3>(membrane_environment({{{4, 3, 0}, {4, 5, 0}, {4, 4, 4}}}, inside)), true,
               1);
}

TEST(Radius, ObliqueFacet) {
  expect_cases(Room::oblique, Room_under_test<3>(room_of(oblique_facet())), true, 1);
}

// The square of this radius is no double, and rounded it is too large.
TEST(Radius, SquaresThatAreNoDoubles) {
  const double x = 1 - 3 * 0x1p-51;
  const Point<3> p{2 * x, 2 * x, x};
  const std::vector<Point<3>> inside{p};
  const Room_under_test<3> room(membrane_environment({{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}}, inside));
  const Thick_motion<3> rests{p, p, p, 3 - 9 * 0x1p-51};
  EXPECT_EQ(room.answer(rests, true).status, Motion_status::free);
  EXPECT_EQ(room.answer(rests).status, Motion_status::free);
  const Thick_motion<3> thicker{p, p, p, std::nextafter(rests.radius, 4)};
  for (const bool is_particle : {true, false}) {
    const Answer<3> answer = room.answer(thicker, is_particle);
    ASSERT_EQ(answer.status, Motion_status::close);
    EXPECT_EQ(answer.contact->distance, rests.radius);
  }
}

// Two membranes are met at times that round to the same double: the first of them counts, in any order of
// cells.
TEST(Radius, TimesWithinAnUlp) {
  const double first = 4, second = 4 + 0x1p-50;
  const Cell_soup<3> soup = membranes_in_box({-200, -100, -100}, {200, 108, 108}, {first, second});
  const Thick_motion<3> motion{{-61, 4, 4}, {64, 4, 4}, {-61, 5, 4}, 1};
  for (const std::uint64_t seed : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const Room_under_test<3> room(room_of(seed == 0 ? soup : relisted(soup, seed).soup));
    const Answer<3> answer = room.answer(motion);
    ASSERT_EQ(room.judge().fault_of(answer, motion, room.judge().truth_of(motion)), "") << seed;
    EXPECT_TRUE(answer.contact->exact_time() == quotient(64, 125)) << seed;
    for (const std::uint32_t v : room.snapshot().loop(answer.contact->facet))
      EXPECT_EQ(room.snapshot().point(v)[0], first) << seed;
  }
}

TEST(Radius, WrongAnswersAreFound) {
  const Room_under_test<3> room(room_of(membranes_in_box({0, 0, 0}, {8, 8, 8}, {4})));
  const Thick_motion<3> motion{{2, 4, 4}, {6, 7, 5}, {2, 7.5, 4}, 0.25};
  const Thick_truth<3> truth = room.judge().truth_of(motion);
  const Answer<3> answer = room.answer(motion);
  ASSERT_EQ(answer.status, Motion_status::contact);
  const auto fault_of = [&](const Answer<3>& a) { return room.judge().fault_of(a, motion, truth); };
  EXPECT_EQ(fault_of(answer), "");
  const Contact<3> right = answer.contact.value();
  const auto fault_if = [&](const auto& change) {
    Answer<3> spoilt;
    spoilt.status = Motion_status::contact;
    change(spoilt.contact.emplace(right));
    return fault_of(spoilt);
  };
  for (const double to : {0., 1.})
    EXPECT_NE(fault_if([&](Contact<3>& c) { c.set_time(Exact_time(std::nextafter(c.time, to))); }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.time = std::nextafter(c.time, 0.); }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.point[2] += 1e-5; }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.point[0] += 1e-5; }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.normal = -1. * c.normal; }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.normal = normalized(c.normal + Vector<3>{0, 0, 1e-4}); }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.normal = 1.0001 * c.normal; }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.normal[0] = std::numeric_limits<double>::quiet_NaN(); }), "");
  EXPECT_NE(fault_if([](Contact<3>& c) { c.kind = Contact_kind::vertex; }), "");
  Answer<3> free;
  free.status = Motion_status::free;
  EXPECT_NE(fault_of(free), "");
}

TEST(Radius, NumbersThatAreNone) {
  constexpr double unbounded = std::numeric_limits<double>::infinity(),
                   not_a_number = std::numeric_limits<double>::quiet_NaN();
  const Room_under_test<3> room(room_of(membrane_in_cubes()));
  const Thick_motion<3> motion{{2, 4, 4}, {6, 4, 4}, {2, 5, 4}, 0};
  const auto with_radius = [&](double r, bool is_particle) {
    return [&room, motion, r, is_particle] {
      Thick_motion<3> other = motion;
      other.radius = r;
      room.answer(other, is_particle);
    };
  };
  for (const bool is_particle : {false, true}) {
    for (const double r : {not_a_number, -not_a_number, unbounded, -unbounded, -1., -5e-324})
      EXPECT_EQ(refusal_of(with_radius(r, is_particle)), Error_code::input) << r;
    for (const double r : {0., -0., 1., 5e-324}) EXPECT_FALSE(refusal_of(with_radius(r, is_particle))) << r;
  }
  // -0 is 0: the wall itself is met, not what is near it.
  Thick_motion<3> thin = motion;
  thin.radius = -0.;
  for (const bool is_particle : {false, true}) {
    const Answer<3> answer = room.answer(thin, is_particle), same = room.answer(motion, is_particle);
    ASSERT_TRUE(answer.contact && same.contact);
    EXPECT_EQ(answer.contact->time, 0.5);
    EXPECT_EQ(same.contact->time, 0.5);
  }
}

// The check of the paper misses what comes near the edge on its way only.
TEST(Radius, ThreeSegments) {
  const std::vector<Point<3>> inside{{0, 0, 4}, {8, 0, 4}, {4, 12, 4}};
  const Room_under_test<3> room(membrane_environment({{{4, 3, 0}, {4, 5, 0}, {4, 4, 4}}}, inside));
  const auto answer = [&](const Point<3>& target, Sweep sweep) {
    Edge_counts counts;
    return answer_sweep<3>(room.snapshot(), room.locator(), {inside[0], target, inside[2], 1},
                           {.sweep = sweep}, counts);
  };
  EXPECT_EQ(answer(inside[1], Sweep::triangle).status, Motion_status::contact);
  EXPECT_EQ(answer(inside[1], Sweep::three_segments).status, Motion_status::free);
  // Where its end is near the spike, the contact is that of the triangle.
  const Answer<3> by_triangle = answer({4, 0, 4}, Sweep::triangle);
  const Answer<3> by_segments = answer({4, 0, 4}, Sweep::three_segments);
  ASSERT_EQ(by_segments.status, Motion_status::contact);
  EXPECT_EQ(by_segments.contact->exact_time(), by_triangle.contact->exact_time());
  EXPECT_EQ(by_segments.contact->body, Body_feature::edge);
}

TEST(Radius, RulesThatHaveNone) {
  const Room_under_test<3> room(room_of(membrane_in_cubes()));
  const Search_options search{Contact_search::exhaustive};
  for (const double r : {0., 1.}) {
    const Edge_motion<3> motion{{2, 4, 4}, {6, 4, 4}, {2, 5, 4}, r};
    const auto expected = r == 0 ? std::nullopt : std::optional(Error_code::usage);
    for (const Sweep_options& options :
         {Sweep_options{.touch = Touch::stop}, Sweep_options{.search = &search}}) {
      Edge_counts counts;
      EXPECT_EQ(refusal_of([&] { answer_sweep(room.snapshot(), room.locator(), motion, options, counts); }),
                expected);
    }
    Edge_counts counts;
    EXPECT_EQ(refusal_of([&] {
                answer_move<3>(room.snapshot(), room.locator(), motion.p, motion.target, Touch::stop, counts,
                               r);
              }),
              expected);
    // Edges have no faces.
    EXPECT_FALSE(refusal_of(
        [&] { answer_sweep(room.snapshot(), room.locator(), motion, {.sweep = Sweep::faces}, counts); }));
  }
}

}  // namespace
}  // namespace cellwalk::test
