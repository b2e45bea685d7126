// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <cmath>

#include "body/rooms.h"

namespace cellwalk {
namespace {

using test::rooms;

/// What is in the way of a particle.
template <int D>
Contact<D> contact_of(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                      Walk_counts& counts) {
  const Walk_result<D> result = walk<Exact>(snapshot, particle, target, counts);
  return vertex_contact(snapshot, particle.position, target, result.contact.value(), counts);
}

template <int D>
Particle<D> particle_at(const Snapshot<D>& snapshot, const Point<D>& p) {
  return Locator<D>(snapshot).particle_at(p).value();
}

/// A coordinate of the exact contact point.
template <int D>
Rational contact_coordinate(const Point<D>& from, const Point<D>& target, const Contact<D>& contact,
                            std::size_t k) {
  const Rational a(from[k]);
  return a + to_rational(contact.exact_time()) * (Rational(target[k]) - a);
}

/// True if each coordinate of x is that of the exact contact point, rounded down or up.
template <int D>
bool is_rounded_contact(const Point<D>& x, const Point<D>& from, const Point<D>& target,
                        const Contact<D>& contact) {
  for (std::size_t k = 0; k < D; ++k) {
    const Rational at = contact_coordinate(from, target, contact, k);
    const double below = std::nextafter(x[k], -10), above = std::nextafter(x[k], 10);
    if (!(Rational(below) < at && at < Rational(above))) return false;
  }
  return true;
}

/// True if each coordinate of x is that of the exact contact point or comes before it on the way.
template <int D>
bool lies_before_contact(const Point<D>& x, const Point<D>& from, const Point<D>& target,
                         const Contact<D>& contact) {
  for (std::size_t k = 0; k < D; ++k) {
    const Rational at = contact_coordinate(from, target, contact, k), here(x[k]);
    if (target[k] >= from[k] ? here > at : here < at) return false;
  }
  return true;
}

TEST(VerifiedStop, StopsInTheWallPlaneWhereThatIsADouble) {
  const auto snapshot = rooms<3>({2, 1, 1});
  auto particle = particle_at<3>(snapshot, {0.5, 0.5, 0.5});
  Walk_counts counts;
  const Point<3> target{3.5, 0.5, 0.5};
  const Contact<3> contact = contact_of(snapshot, particle, target, counts);
  EXPECT_TRUE(stop_at_contact(snapshot, particle, target, contact, counts));
  EXPECT_EQ(particle.position, (Point<3>{2, 0.5, 0.5}));
  EXPECT_EQ(particle.cell, snapshot.cell(1));
}

TEST(VerifiedStop, ReachesObliqueWallsClosely) {
  // Jittered tetrahedra: the exact contact point is mostly not a double, and half of its roundings are behind
  // the wall.
  Simplex_grid_options<3> options;
  options.cells = {2, 2, 2};
  options.jitter = 0.15;
  const auto snapshot = test::compile(tetrahedral_grid(options));
  const auto start = particle_at<3>(snapshot, {1, 1, 1});
  ASSERT_NE(start.cell, Cell::none);
  Random random(5);
  Walk_counts counts, of_stops;
  int stops = 0, rounded = 0, towards_start = 0, stuck = 0;
  for (int i = 0; i < 5000; ++i) {
    auto particle = start;
    Point<3> inside, target;
    for (double& x : inside) x = random.real(0.5, 1.5);
    for (double& x : target) x = random.real(-2, 4);
    ASSERT_EQ(move<Exact>(snapshot, particle, inside, counts).status, Walk_status::arrived);
    const auto result = move<Exact>(snapshot, particle, target, counts);
    if (result.status != Walk_status::contact) continue;
    ++stops;
    const Contact<3> contact = contact_of(snapshot, particle, target, counts);
    if (!stop_at_contact(snapshot, particle, target, contact, of_stops)) ++stuck;
    rounded += is_rounded_contact(particle.position, inside, target, contact);
    towards_start += lies_before_contact(particle.position, inside, target, contact);
    EXPECT_TRUE(in_closure(snapshot, particle.cell, particle.position));
    EXPECT_LT(length(particle.position - result.contact->point), 1e-12);
  }
  EXPECT_GT(stops, 2000);
  EXPECT_EQ(rounded, stops) << "some rounding of a point in a wall lies on its free side";
  EXPECT_GT(towards_start, stops / 5);
  EXPECT_GT(stops - towards_start, stops / 5) << "that towards the start lies behind an oblique wall";
  EXPECT_EQ(stuck, 0);
  EXPECT_LT(of_stops.walks, 1.01 * stops) << "the rounding along the normal comes first";
}

TEST(VerifiedStop, GoesBackOnTheWayWhereNothingNearTheContactIsFree) {
  const auto snapshot = rooms<2>({2, 1});
  auto particle = particle_at<2>(snapshot, {1, 0.5});
  Walk_counts counts;
  const Point<2> target{3, 0.5};
  Contact<2> contact = contact_of(snapshot, particle, target, counts);
  EXPECT_EQ(contact.time, 0.5);
  contact.set_time(Exact_time(0.5 + 0x1p-30));  // behind the wall, and the normal leads further away
  contact.normal = {1, 0};
  EXPECT_TRUE(stop_at_contact(snapshot, particle, target, contact, counts));
  EXPECT_EQ(particle.position, (Point<2>{1 + 2 * ((0.5 + 0x1p-30) * (1 - 0x1p-20)), 0.5}));
  // Where it stands on the wall already, it stays.
  particle = particle_at<2>(snapshot, {2, 0.5});
  contact = contact_of(snapshot, particle, target, counts);
  EXPECT_EQ(contact.exact_time(), Exact_time());
  EXPECT_FALSE(stop_at_contact(snapshot, particle, target, contact, counts));
  EXPECT_EQ(particle.position, (Point<2>{2, 0.5}));
}

TEST(Advance, ReflectsWithRestitutionAndFriction) {
  const auto snapshot = rooms<2>({4, 4});
  const auto start = particle_at<2>(snapshot, {3, 2});
  const auto run = [&](double restitution, double friction) {
    auto particle = start;
    std::vector<Contact<2>> met;
    Walk_counts counts;
    const auto v = advance(snapshot, particle, Vector<2>{2, 0.5}, {restitution, friction}, met, counts);
    EXPECT_EQ(met.size(), 1u);
    EXPECT_EQ(met.at(0).exact_time(), Exact_time(0.5));
    EXPECT_EQ(met.at(0).normal, (Vector<2>{-1, 0}));
    return std::pair(particle.position, v);
  };
  const auto expect_near = [](const Point<2>& a, const Point<2>& b) { EXPECT_LT(length(a - b), 1e-13); };
  auto [p, v] = run(1, 0);
  EXPECT_EQ(v, (Vector<2>{-2, 0.5}));
  expect_near(p, {3, 2.5});
  std::tie(p, v) = run(0.5, 0);
  EXPECT_EQ(v, (Vector<2>{-1, 0.5}));
  expect_near(p, {3.5, 2.5});
  std::tie(p, v) = run(0, 0);  // slides
  EXPECT_EQ(v, (Vector<2>{0, 0.5}));
  expect_near(p, {4, 2.5});
  std::tie(p, v) = run(0, 1);  // sticks
  EXPECT_EQ(v, (Vector<2>{0, 0}));
  expect_near(p, {4, 2.25});
}

TEST(Advance, SlidesAlongTheEdgeOfTwoWallsAndRestsInACorner) {
  const auto snapshot = rooms<3>({4, 4, 4});
  auto particle = particle_at<3>(snapshot, {3, 3, 1});
  std::vector<Contact<3>> met;
  Walk_counts counts;
  auto v = advance(snapshot, particle, Vector<3>{2, 1.5, 1}, {}, met, counts);
  EXPECT_LT(length(particle.position - Point<3>{4, 4, 2}), 1e-13);
  EXPECT_LT(length(v - Vector<3>{0, 0, 1}), 1e-13);
  EXPECT_EQ(met.size(), 2u);
  met.clear();
  v = advance(snapshot, particle, Vector<3>{5, 5, 5}, {}, met, counts);
  EXPECT_LT(length(particle.position - Point<3>{4, 4, 4}), 1e-13);
  EXPECT_LT(length(v), 1e-13);
  EXPECT_TRUE(in_closure(snapshot, particle.cell, particle.position));
}

TEST(Advance, KeepsTheSpeedOfAParticleThatBouncesInAWedge) {
  // A triangle whose walls meet at a small angle: many contacts in one step, none of which may lose the
  // particle.
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {8, 0}, {8, 1}};
  const std::array<std::uint32_t, 3> triangle{0, 1, 2};
  add_polygon(soup, triangle);
  const auto snapshot = test::compile(soup);
  auto particle = particle_at<2>(snapshot, {6, 0.4});
  std::vector<Contact<2>> met;
  Walk_counts counts;
  const Wall_response elastic{1, 0, 200};
  const auto v = advance(snapshot, particle, Vector<2>{-20, 0.3}, elastic, met, counts);
  EXPECT_GT(met.size(), 5u);
  EXPECT_NEAR(length(v), length(Vector<2>{-20, 0.3}), 1e-11);
  EXPECT_TRUE(in_closure(snapshot, particle.cell, particle.position));
}

}  // namespace
}  // namespace cellwalk
