// SPDX-License-Identifier: LGPL-3.0-or-later
// Everything times a power of two: every answer is the same times that, to the bit.
#include <cellwalk/body/body.h>
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "walk/oracle_trial.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::test {
namespace {

constexpr std::array<int, 6> exponents{-60, -41, -40, -7, 20, 60};

template <std::size_t D>
std::array<double, D> scaled(const std::array<double, D>& x, int exponent) {
  return std::ldexp(1.0, exponent) * x;
}

template <int D>
std::vector<Point<D>> all_scaled(std::span<const Point<D>> points, int exponent) {
  std::vector<Point<D>> result;
  for (const Point<D>& x : points) result.push_back(scaled(x, exponent));
  return result;
}

/// A world at a scale, and a body in it.
template <int D>
struct Copy {
  int exponent;
  Snapshot<D> snapshot;
  Locator<D> locator;
  std::unique_ptr<Body<D>> body;
  Step_report<D> report;
  Body_counts counts;

  Copy(const Cell_soup<D>& soup, int k) : exponent(k), snapshot(compiled(soup, k)), locator(snapshot) {}

  static Snapshot<D> compiled(Cell_soup<D> soup, int k) {
    soup.points = all_scaled<D>(soup.points, k);
    return Snapshot<D>::compile(soup, glue(soup));
  }
  void place(Body_soup<D> soup) {
    soup.points = all_scaled<D>(soup.points, exponent);
    body = std::make_unique<Body<D>>(snapshot, locator, soup);
  }
  void step(std::span<const Point<D>> targets, const Body_options& options) {
    report.clear();
    body->step(all_scaled<D>(targets, exponent), options, report, counts);
  }
};

struct Seen {
  std::uint64_t steps = 0, contacts = 0, by_edge = 0, by_face = 0, at_once = 0, slides = 0, refused = 0;
  Body_counts counts;
};

template <int D>
void expect_scaled(const Contact<D>& a, const Contact<D>& b, int exponent) {
  EXPECT_EQ(a.exact_time(), b.exact_time());
  EXPECT_EQ(scaled(a.point, exponent), b.point);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.facet, b.facet);
  EXPECT_EQ(a.corner, b.corner);
  EXPECT_EQ(a.cell, b.cell);
}

template <int D>
void expect_scaled(const Copy<D>& one, const Copy<D>& other, const std::string& name) {
  SCOPED_TRACE(name + ", times 2^" + std::to_string(other.exponent));
  EXPECT_EQ(all_scaled<D>(one.body->positions(), other.exponent),
            (std::vector<Point<D>>(other.body->positions().begin(), other.body->positions().end())));
  ASSERT_EQ(one.report.contacts.size(), other.report.contacts.size());
  for (std::size_t i = 0; i < one.report.contacts.size(); ++i) {
    const Contact<D>&a = one.report.contacts[i], &b = other.report.contacts[i];
    EXPECT_EQ(a.vertex, b.vertex);
    EXPECT_EQ(a.feature, b.feature);
    expect_scaled<D>(a, b, other.exponent);
  }
  EXPECT_EQ(one.counts.stop_tries, other.counts.stop_tries);
  EXPECT_EQ(one.counts.held, other.counts.held);
  EXPECT_EQ(one.counts.in_region, other.counts.in_region);
}

/// Sweeps, searches and touches in turn; faces to the end once they are swept.
Body_options options_of(std::uint64_t turn, bool sweeps_faces) {
  Body_options options;
  options.sweep.sweep = sweeps_faces ? Sweep::faces : turn % 2 == 0 ? Sweep::triangle : Sweep::three_segments;
  static constexpr std::array<Search_options, 3> searches{{{Contact_search::dichotomic, 0x1p-10},
                                                           {Contact_search::exhaustive},
                                                           {Contact_search::dichotomic_segment, 0x1p-10}}};
  if (const auto which = turn / 2 % 5; which >= 2) options.sweep.search = &searches[which - 2];
  if (turn % 7 == 3) options.sweep.touch = Touch::stop;
  options.clearance = turn % 3 != 0;
  return options;
}

/// A body of three vertices, with edges and a face.
template <int D>
Body_soup<D> random_body(oracle::Motion_source<D>& source, bool generic) {
  const oracle::Motion_kind kind = source.kind(generic);
  Body_soup<D> soup;
  soup.points.push_back(source.start(kind));
  while (soup.points.size() < 3) soup.points.push_back(source.target(kind, soup.points[0], soup.points[0]));
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  if (D == 3) soup.faces = {{0, 1, 2}};
  return soup;
}

template <int D>
void move_at_all_scales(std::vector<std::unique_ptr<Copy<D>>>& copies, oracle::Motion_source<D>& source,
                        bool generic, std::uint64_t turn, const std::string& name, Seen& seen) {
  const Copy<D>& one = *copies[0];
  std::vector<Point<D>> targets;
  for (const Point<D>& x : one.body->positions()) {
    oracle::Motion_kind kind;
    do kind = source.kind(generic);
    while (kind == oracle::Motion_kind::in_wall_plane || kind == oracle::Motion_kind::along_edge);
    targets.push_back(source.target(kind, x, x));
  }
  const Body_options options = options_of(turn, D == 3 && turn / 8 % 3 == 0);
  for (const auto& copy : copies) copy->step(targets, options);
  for (std::size_t k = 1; k < copies.size(); ++k) expect_scaled<D>(one, *copies[k], name);
  ++seen.steps;
  seen.contacts += one.report.contacts.size();
  for (std::size_t i = 0; i < one.report.contacts.size(); ++i) {
    const Contact<D>& c = one.report.contacts[i];
    seen.by_edge += c.body == Body_feature::edge;
    seen.by_face += c.body == Body_feature::face;
    seen.at_once += c.exact_time() == Exact_time();
    seen.slides += i > 0 && one.report.contacts[i - 1].vertex == c.vertex;
  }
}

template <int D>
Seen bodies_at_all_scales(bool generic) {
  Seen seen;
  std::uint64_t turn = 0;
  const std::size_t worlds = oracle::scaled_count(oracle::world_kinds);
  for (std::uint64_t number = 0; number < worlds; ++number) {
    const oracle::World<D> world = oracle::make_world<D>(number);
    std::vector<std::unique_ptr<Copy<D>>> copies{};
    copies.push_back(std::make_unique<Copy<D>>(world.soup, 0));
    for (const int k : exponents) copies.push_back(std::make_unique<Copy<D>>(world.soup, k));
    oracle::Motion_source<D> source(world, number);
    for (int placed = 0, tried = 0; placed < 12 && tried < 400; ++tried) {
      const Body_soup<D> soup = random_body(source, generic);
      try {
        copies[0]->place(soup);
      } catch (const Error&) {
        ++seen.refused;
        continue;
      }
      for (const auto& copy : copies) copy->place(soup);
      ++placed;
      for (int step = 0; step < 8 && !testing::Test::HasFailure(); ++step)
        move_at_all_scales(copies, source, generic, turn++, world.name, seen);
      turn -= turn % 8;
    }
    seen.counts += copies[0]->counts;
  }
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.steps << " steps at "
            << exponents.size() + 1 << " scales, " << seen.contacts << " contacts, " << seen.by_edge
            << " by edges, " << seen.by_face << " by faces, " << seen.at_once << " at 0, " << seen.slides
            << " after another, " << seen.counts.in_region << " moves in regions, " << seen.counts.stop_tries
            << " stops tried\n";
  return seen;
}

template <int D>
void expect_all_branches() {
  for (const bool generic : {true, false}) {
    const Seen seen = bodies_at_all_scales<D>(generic);
    if (oracle::scaled_count(oracle::world_kinds) < oracle::world_kinds) continue;
    EXPECT_GT(seen.steps, 500u);
    EXPECT_GT(seen.contacts, 500u);
    EXPECT_GT(seen.by_edge, 50u);
    EXPECT_GT(seen.slides, 100u);
    EXPECT_GT(seen.at_once, 20u);
    EXPECT_GT(seen.counts.edges.searches, 0u);
  }
}

/// Particles that slide and bounce.
template <int D>
void expect_flights_scale() {
  std::uint64_t contacts = 0, flights = 0;
  for (std::uint64_t number = 0; number < oracle::scaled_count(oracle::world_kinds); ++number) {
    const oracle::World<D> world = oracle::make_world<D>(number);
    std::vector<std::unique_ptr<Copy<D>>> copies{};
    copies.push_back(std::make_unique<Copy<D>>(world.soup, 0));
    for (const int k : exponents) copies.push_back(std::make_unique<Copy<D>>(world.soup, k));
    oracle::Motion_source<D> source(world, number);
    for (int k = 0; k < 40; ++k) {
      const oracle::Motion_kind kind = source.kind(k % 2 == 0);
      const Point<D> from = source.start(kind);
      if (!copies[0]->locator.particle_at(from)) continue;
      const Vector<D> velocity = source.target(kind, from, from) - from;
      Wall_response response;
      if (k % 4 == 1) response.restitution = 0.5;
      if (k % 3 == 1) response.friction = 0.25;
      std::vector<Contact<D>> first;
      Point<D> end{};
      Vector<D> speed{};
      for (const auto& copy : copies) {
        Particle<D> particle = copy->locator.particle_at(scaled(from, copy->exponent)).value();
        ASSERT_NE(particle.cell, Cell::none);
        std::vector<Contact<D>> met;
        Walk_counts counts;
        const Vector<D> after =
            advance(copy->snapshot, particle, scaled(velocity, copy->exponent), response, met, counts);
        if (copy->exponent == 0) {
          first = met;
          end = particle.position;
          speed = after;
          continue;
        }
        SCOPED_TRACE(world.name + ", times 2^" + std::to_string(copy->exponent));
        EXPECT_EQ(particle.position, scaled(end, copy->exponent));
        EXPECT_EQ(after, scaled(speed, copy->exponent));
        ASSERT_EQ(met.size(), first.size());
        for (std::size_t i = 0; i < met.size(); ++i) {
          EXPECT_EQ(met[i].exact_time(), first[i].exact_time());
          EXPECT_EQ(met[i].normal, first[i].normal);
          EXPECT_EQ(met[i].facet, first[i].facet);
        }
      }
      ++flights;
      contacts += first.size();
    }
  }
  if (oracle::is_shortened()) return;
  EXPECT_GT(flights, 100u);
  EXPECT_GT(contacts, 150u);
}

/// Doubles are nearest to each other at the origin: a lift by some of them there would be nothing, at any
/// scale.
template <int D>
void expect_lifts_at_the_origin() {
  const Cell_soup<D> soup = [] {
    Grid_options<D> options;
    options.cells.fill(3);
    if constexpr (D == 2)
      return square_grid(options);
    else
      return hex_grid(options);
  }();
  Point<D> inside, along, out;
  inside.fill(0.5);
  along.fill(0.5);
  along[1] = -0.25;
  out.fill(-0.25);
  out[0] = -0.125;
  Body_options options_without_clearance;
  options_without_clearance.clearance = false;
  for (const int k : exponents) {
    Copy<D> unit(soup, 0), copy(soup, k);
    for (const auto& [from, to] : {std::pair{Point<D>{}, along}, std::pair{inside, out}}) {
      for (Copy<D>* c : {&unit, &copy}) {
        c->place({{from}, {}, {}});
        c->step(std::vector<Point<D>>{to}, options_without_clearance);
      }
      ASSERT_FALSE(unit.report.contacts.empty());
      expect_scaled(unit, copy, "from a corner at the origin, or to it");
      Particle<D> slid = unit.locator.particle_at(from).value(),
                  there = copy.locator.particle_at(scaled(from, k)).value();
      std::vector<Contact<D>> met;
      Walk_counts counts;
      advance(unit.snapshot, slid, to - from, {}, met, counts);
      advance(copy.snapshot, there, scaled(to - from, k), {}, met, counts);
      EXPECT_EQ(scaled(slid.position, k), there.position);
    }
    unit.place({{Point<D>{}}, {}, {}});
    unit.step(std::vector<Point<D>>{along}, options_without_clearance);
    EXPECT_EQ(unit.body->positions()[0][1], 16 * 0x1p-53) << "16 units in the last place of 1/2";
  }
}

TEST(Scale, LiftsAtTheOrigin) {
  expect_lifts_at_the_origin<2>();
  expect_lifts_at_the_origin<3>();
}

TEST(Scale, BodiesAnswerAlikeAtAllScales2) { expect_all_branches<2>(); }
TEST(Scale, BodiesAnswerAlikeAtAllScales3) { expect_all_branches<3>(); }
TEST(Scale, ParticlesFlyAlikeAtAllScales2) { expect_flights_scale<2>(); }
TEST(Scale, ParticlesFlyAlikeAtAllScales3) { expect_flights_scale<3>(); }

}  // namespace
}  // namespace cellwalk::test
