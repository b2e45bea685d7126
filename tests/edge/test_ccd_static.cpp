// SPDX-License-Identifier: LGPL-3.0-or-later
// The published collision queries against a static obstacle: a vertex against a triangle, which is a membrane
// here, and an edge against an edge, which is the rim of a membrane. Labels count touches, as Touch::stop
// does. What is touched first, and when, is compared with a rational oracle.
//
// Touch::stop reports what is met off the start of a motion, labels also what is met at the start. No query
// tells them apart: none starts on its obstacle, which is asserted.
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "edge/ccd_queries.h"
#include "edge/membrane_environment.h"
#include "edge/membrane_of_edge.h"
#include "edge/rational_sweep.h"

namespace cellwalk::test {
namespace {

const std::string data = CELLWALK_TEST_DATA "/ccd_static/";

/// The same contact or none, at the same time exactly, and with the membrane.
void expect_contact(const Snapshot<3>& snapshot, const std::optional<Contact<3>>& contact,
                    const Rational_touch& expected) {
  ASSERT_EQ(contact.has_value(), expected.later.has_value());
  if (!contact) return;
  const Half_facet membrane = Snapshot<3>::half_facet(snapshot.cell(0), 0);
  EXPECT_TRUE(contact->facet == membrane || contact->facet == snapshot.opposite(membrane));
  std::ostringstream time;
  time << to_rational(contact->exact_time());
  EXPECT_EQ(test::Rational(time.str()), *expected.later);
}

TEST(CcdStatic, VertexAndFace) {
  const std::vector<Ccd_row> rows = read_ccd_rows(data + "vertex_face_static.csv.gz", 1, 5);
  int collisions = 0, found = 0, at_end = 0;
  Edge_counts counts;
  for (const Ccd_row& row : rows) {
    SCOPED_TRACE(row.name);
    const Point<3>&from = row.points[0], &to = row.points[1];
    const std::array<Point<3>, 3> obstacle{row.points[2], row.points[3], row.points[4]};
    const Rational_touch expected = touch_of_point(from, to, obstacle);
    EXPECT_FALSE(expected.at_start);
    EXPECT_EQ(expected.any(), row.labels[0]);

    const Environment<3> environment = membrane_environment(obstacle, std::array{from, to});
    const Particle<3> p = Locator<3>(environment.snapshot()).particle_at(from).value();
    ASSERT_NE(p.cell, Cell::none);
    const auto contact = first_touch(environment.snapshot(), p, to, counts);
    EXPECT_EQ(contact.has_value(), row.labels[0]);
    expect_contact(environment.snapshot(), contact, expected);
    collisions += row.labels[0];
    found += contact.has_value();
    at_end += contact && contact->time == 1;
  }
  std::cout << rows.size() << " vertex/face queries: " << collisions << " collide, " << found << " found, "
            << at_end << " of them touched at the end of the motion\n";
  EXPECT_EQ(rows.size(), 518u);
  EXPECT_EQ(collisions, 91);
  EXPECT_EQ(found, collisions);
  EXPECT_GT(at_end, 0);
}

/// Contacts while p moves and, if there is none, while q moves then.
using Contacts = std::array<std::optional<Contact<3>>, 2>;

/// An edge before it moves, in the environment of a membrane.
struct Edge_at_start {
  const Snapshot<3>& snapshot;
  Particle<3> p, q;
  Chain chain;
};

Contacts sweep_both(const Edge_at_start& edge, const Edge_motion& m, const Sweep_options& options,
                    Edge_counts& counts) {
  const Sweep_result<3> moved = sweep_edge(edge.snapshot, edge.p, m.p1, edge.q, edge.chain, options, counts);
  if (moved.contact) return {moved.contact, std::nullopt};
  const Chain back = reversed(edge.snapshot, moved.chain);
  return {std::nullopt, sweep_edge(edge.snapshot, edge.q, m.q1, moved.p, back, options, counts).contact};
}

/// True if a particle that goes the ways of the paper's segments, and the edge before it moves, touches a
/// wall.
bool do_segments_touch(const Edge_at_start& edge, const Edge_motion& m, Edge_counts& counts) {
  const auto touches = [&](Particle<3>& particle, const Point<3>& to) {
    if (first_touch(edge.snapshot, particle, to, counts)) return true;
    move(edge.snapshot, particle, to, counts.walk);
    return false;
  };
  Particle<3> p = edge.p, q = edge.q, along = edge.p;
  if (touches(along, m.q0) || touches(p, m.p1)) return true;
  along = p;
  if (touches(along, m.q0) || touches(q, m.q1)) return true;
  along = p;
  return touches(along, m.q1);
}

struct Seen {
  int motions = 0, collisions = 0, starts_across = 0;
  int first = 0, second = 0;  ///< contacts of Touch::stop while p moves, while q moves
  int crossings = 0;          ///< contacts of Touch::pass
  int three_segments = 0;     ///< contacts of Sweep::three_segments, which is never Touch::stop
  int segments_touch = 0;     ///< the paper's segments, with touches
  Edge_counts counts;
};

/// Asks the library about a motion and expects all that the oracle says. An edge that pierces the membrane
/// before it moves has no chain: that is all that can be said of it.
void check_motion(const Environment<3>& environment, const std::array<Point<3>, 3>& membrane,
                  const Edge_motion& m, Seen& seen) {
  const Edge_touch expected = touch_of_motion(m, membrane);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  const Particle<3> p = locator.particle_at(m.p0).value(), q = locator.particle_at(m.q0).value();
  ++seen.motions;
  seen.collisions += expected.any();
  const Chain_result<3> edge = find_chain(snapshot, p, q, seen.counts.walk);
  EXPECT_EQ(edge.contact.has_value(), expected.first.at_start);
  if (edge.contact) {
    ++seen.starts_across;
    return;
  }
  const Edge_at_start start{snapshot, p, q, edge.chain};

  const Contacts stop = sweep_both(start, m, {Sweep::triangle, Touch::stop}, seen.counts);
  expect_contact(snapshot, stop[0], expected.first);
  if (!stop[0]) expect_contact(snapshot, stop[1], expected.second);
  seen.first += stop[0].has_value();
  seen.second += stop[1].has_value();

  const Contacts pass = sweep_both(start, m, {Sweep::triangle, Touch::pass}, seen.counts);
  const bool is_crossed = crosses(m.p0, m.p1, m.q0, membrane) || crosses(m.q0, m.q1, m.p1, membrane);
  EXPECT_EQ(pass[0] || pass[1], is_crossed);
  seen.crossings += is_crossed;

  const Contacts three = sweep_both(start, m, {Sweep::three_segments, Touch::pass}, seen.counts);
  EXPECT_TRUE(is_crossed || !(three[0] || three[1]));
  seen.three_segments += three[0] || three[1];
  const bool segments_touch = do_segments_touch(start, m, seen.counts);
  EXPECT_EQ(segments_touch, expected.sides);
  seen.segments_touch += segments_touch;
}

std::ostream& operator<<(std::ostream& out, const Seen& seen) {
  return out << seen.motions << " motions, " << seen.collisions << " collide: " << seen.starts_across
             << " already before, " << seen.first << " while the first end moves, " << seen.second
             << " while the second does; " << seen.crossings
             << " of these two are crossings, of which three segments find " << seen.three_segments << ", or "
             << seen.segments_touch << " of all if touches count";
}

struct Edge_row {
  Edge_motion motion;
  std::array<Point<3>, 2> obstacle;
  bool p_first, q_first, sides_of_p_first;
};

Edge_row edge_row(const Ccd_row& row) {
  const auto& x = row.points;
  return {{x[0], x[2], x[1], x[3]}, {x[4], x[5]}, row.labels[1], row.labels[2], row.labels[3]};
}

std::vector<Ccd_row> edge_rows() { return read_ccd_rows(data + "edge_edge_static.csv.gz", 4, 6); }

TEST(CcdStatic, EdgeAndEdge) {
  const std::vector<Ccd_row> rows = edge_rows();
  Seen p_first, q_first;
  int labels_p = 0, labels_q = 0, labels_sides = 0, halved = 0, most_halvings = 0;
  for (const Ccd_row& named : rows) {
    SCOPED_TRACE(named.name);
    const Edge_row row = edge_row(named);
    const Edge_motion &m = row.motion, turned = m.q_first();
    const Edge_touch of_edge = touch_of_motion(m, row.obstacle);
    EXPECT_FALSE(of_edge.first.at_start);
    EXPECT_EQ(of_edge.any(), row.p_first);
    EXPECT_EQ(of_edge.sides, row.sides_of_p_first);
    EXPECT_EQ(touch_of_motion(turned, row.obstacle).any(), row.q_first);
    labels_p += row.p_first;
    labels_q += row.q_first;
    labels_sides += row.sides_of_p_first;

    const auto found = membrane_of_edge(row.obstacle[0], row.obstacle[1], m);
    ASSERT_TRUE(found);
    halved += found->halvings > 0;
    most_halvings = std::max(most_halvings, found->halvings);
    const auto& membrane = found->triangle;
    const Environment<3> environment = membrane_environment(membrane, std::array{m.p0, m.p1, m.q0, m.q1});
    const int contacts_p = p_first.first + p_first.second, contacts_q = q_first.first + q_first.second;
    check_motion(environment, membrane, m, p_first);
    check_motion(environment, membrane, turned, q_first);
    EXPECT_EQ(p_first.first + p_first.second - contacts_p, row.p_first);
    EXPECT_EQ(q_first.first + q_first.second - contacts_q, row.q_first);
  }
  std::cout << rows.size() << " edge/edge queries; membranes that had to be lower: " << halved
            << ", halved up to " << most_halvings << " times\n"
            << "p first: " << p_first << "\nq first: " << q_first << "\n";
  EXPECT_EQ(rows.size(), 821u);
  EXPECT_EQ(labels_p, 106);
  EXPECT_EQ(labels_q, 112);
  EXPECT_EQ(labels_sides, 15);
  EXPECT_EQ(p_first.first + p_first.second, labels_p);
  EXPECT_EQ(q_first.first + q_first.second, labels_q);
  EXPECT_GT(p_first.crossings, labels_p / 2);
  EXPECT_LT(p_first.crossings, labels_p) << "some only touch";
  // What the paper's segments find of them: those whose boundary meets the bare edge, by touching it.
  EXPECT_EQ(p_first.segments_touch, labels_sides);
  EXPECT_LE(p_first.three_segments, labels_sides);
  EXPECT_GT(halved, 10);
}

TEST(CcdStatic, EdgeAndWideMembrane) {
  // The membrane is as large as the scene and lies anywhere: it adds hits of its own, which the oracle
  // decides.
  Seen p_first, q_first;
  Random random(6);
  for (const Ccd_row& named : edge_rows()) {
    SCOPED_TRACE(named.name);
    const Edge_row row = edge_row(named);
    const Edge_motion& m = row.motion;
    const auto& [a, b] = row.obstacle;
    const double size = length(b - a) + length(m.p0 - a) + length(m.q0 - a);
    const Vector<3> path{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    const std::array<Point<3>, 3> membrane{a, b, a + size * path};
    const Environment<3> environment = membrane_environment(membrane, std::array{m.p0, m.p1, m.q0, m.q1});
    check_motion(environment, membrane, m, p_first);
    check_motion(environment, membrane, m.q_first(), q_first);
  }
  std::cout << "p first: " << p_first << "\nq first: " << q_first << "\n";
  EXPECT_GT(p_first.starts_across, 20);
  EXPECT_GT(p_first.first, 50);
  EXPECT_GT(p_first.second, 20);
  EXPECT_GT(p_first.three_segments, 20);
  EXPECT_LT(p_first.three_segments, p_first.crossings);
}

}  // namespace
}  // namespace cellwalk::test
