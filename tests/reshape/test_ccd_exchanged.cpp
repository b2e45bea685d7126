// SPDX-License-Identifier: LGPL-3.0-or-later
// The published collision queries against a static obstacle, with the roles exchanged: what moves in them is
// a vertex of a membrane here, and the obstacle is a body. A vertex that moves is the tip of a needle, an
// edge of which one end moves is the side of one, whose base is at its other end. The needles are so thin
// that they meet what the vertex or the edge meets. Labels count touches; what a touch comes to is judged by
// the oracles of moving walls.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "edge/ccd_queries.h"
#include "edge/membrane_environment.h"
#include "reshape/wall_judge.h"

namespace cellwalk::test {
namespace {

const std::string data = CELLWALK_TEST_DATA "/ccd_static/";

/// A body in the environment of a membrane.
struct Query_world {
  Query_world(const std::array<Point<3>, 3>& membrane, const Point<3>& target, const Body_soup<3>& soup)
      : environment(membrane_environment(membrane, with(soup.points, target))),
        snapshot(environment.snapshot()) {
    bodies.push_back(std::make_unique<Body<3>>(snapshot, Locator<3>(snapshot), soup));
  }
  Residents<3> residents() { return {{bodies[0].get()}, {}}; }

  Environment<3> environment;
  const Snapshot<3>& snapshot;
  std::vector<Particle<3>> particles;
  std::vector<std::unique_ptr<Body<3>>> bodies;

 private:
  static std::vector<Point<3>> with(std::vector<Point<3>> points, const Point<3>& x) {
    points.push_back(x);
    return points;
  }
};

using Judge = Wall_judge<3, Query_world>;

bool meet(const std::array<Point<3>, 4>& simplex, std::span<const Point<3>> set) {
  return relation<3>(simplex, set) != Relation::apart;
}

/// Whether a wall that is the needle of a vertex moves in its own plane.
enum class Needle { flat, tilted };

/// A triangle whose tip moves from one point to another, and which, to a set, is what the segment to its tip
/// from a base is, or if base and tip are at one place, what the tip is. None if there is none.
/// \pre the set does not meet that segment
std::optional<std::array<Point<3>, 3>> needle(const Point<3>& tip, const Point<3>& target,
                                              const Point<3>& base, std::span<const Point<3>> set,
                                              Needle kind) {
  const bool meets_set = meet({tip, target, base, base}, set);
  const Vector<3> motion = target - tip;
  const Vector<3> along = normalized(base == tip ? motion : tip - base);
  // The tip moves across the plane of the needle, as far as it can.
  Vector<3> up = motion - dot(motion, along) * along;
  for (std::size_t axis = 0; axis < 3 && length(up) <= 0x1p-20 * length(motion); ++axis) {
    Vector<3> unit{};
    unit[axis] = 1;
    if (std::abs(along[axis]) < 0.9) up = cross(along, unit);
  }
  const Vector<3> side = normalized(cross(along, normalized(up)));
  for (int k = 4; k < 46; ++k) {
    const double size = std::ldexp(length(base == tip ? motion : tip - base), -k);
    const Point<3> back = base + (-size) * along + (kind == Needle::flat ? 0 : size) * cross(along, side);
    const Point<3> other = back + size * side, near = base == tip ? back + (-size) * side : base;
    if (meet({tip, target, near, other}, set) == meets_set && !meet({tip, tip, near, other}, set))
      return std::array{tip, near, other};
  }
  return {};
}

struct Seen {
  Judge::Tally tally;
  int moves = 0, met = 0, contacts = 0, touching = 0;
  int starts_across = 0, wide = 0, without_needle = 0;  ///< not tried
};

/// Moves the tip of a needle, and expects a contact only if the set is met. Returns whether it is.
bool move_tip(const Point<3>& tip, const Point<3>& target, const Point<3>& base, const Body_soup<3>& soup,
              Seen& seen, Needle kind = Needle::flat) {
  const bool meets_set = meet({tip, target, base, base}, soup.points);
  seen.met += meets_set;
  ++seen.moves;
  if (tip == target) return meets_set;
  if (meet({tip, base, base, base}, soup.points)) {
    ++seen.starts_across;
    return true;
  }
  const auto membrane = needle(tip, target, base, soup.points, kind);
  if (!membrane || are_collinear((*membrane)[0], (*membrane)[1], (*membrane)[2])) {
    ++seen.without_needle;
    return meets_set;
  }
  Query_world world(*membrane, target, soup);
  Reshaping<3> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
  const Vertex_result<3> result = reshaping.test_move(0, target);
  EXPECT_NE(result.end, Move_end::boundary);
  if (result.end == Move_end::cell) {  // it turns by a right angle or more
    ++seen.wide;
    return meets_set;
  }
  Judge(world, seen.tally).judge(reshaping, 0, target);
  reshaping.finish();
  world.bodies[0]->validate();
  EXPECT_TRUE(meets_set || result.end == Move_end::reached);
  seen.contacts += result.end != Move_end::reached;
  seen.touching += meets_set && result.end == Move_end::reached;
  return meets_set;
}

std::ostream& operator<<(std::ostream& out, const Seen& seen) {
  return out << seen.moves << " moves, " << seen.met << " meet the obstacle: " << seen.contacts
             << " are blocked, " << seen.touching << " touch it; " << seen.starts_across
             << " start across it, " << seen.wide << " turn too far, " << seen.without_needle
             << " without a needle; fates " << seen.tally.fates.fates << ", choices "
             << seen.tally.fates.choices << ", undecided " << seen.tally.fates.undecided;
}

void vertices_and_faces(Needle kind, Seen& seen) {
  const std::vector<Ccd_row> rows = read_ccd_rows(data + "vertex_face_static.csv.gz", 1, 5);
  for (const Ccd_row& row : rows) {
    SCOPED_TRACE(row.name);
    const Point<3>&from = row.points[0], &to = row.points[1];
    const Body_soup<3> face{
        {row.points[2], row.points[3], row.points[4]}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    EXPECT_EQ(move_tip(from, to, from, face, seen, kind), row.labels[0]);
    ASSERT_EQ(seen.tally.wrong(), 0);
  }
  std::cout << rows.size() << " vertex/face queries: " << seen << "\n";
  EXPECT_EQ(rows.size(), 518u);
  EXPECT_EQ(seen.met, 91);
  EXPECT_EQ(seen.wide, 0);
  EXPECT_EQ(seen.starts_across, 0);
  EXPECT_GT(seen.contacts, 70);
  EXPECT_EQ(seen.tally.fates.undecided, 0) << "a wall that passes a face has a time";
}

TEST(CcdExchanged, VertexAndFace) {
  Seen seen;
  vertices_and_faces(Needle::tilted, seen);
}

TEST(CcdExchanged, VertexInThePlaneOfItsWallAndFace) {
  Seen seen;
  vertices_and_faces(Needle::flat, seen);
}

TEST(CcdExchanged, EdgeAndEdge) {
  const std::vector<Ccd_row> rows = read_ccd_rows(data + "edge_edge_static.csv.gz", 4, 6);
  Seen seen;
  int labels_p = 0, labels_q = 0;
  for (const Ccd_row& row : rows) {
    SCOPED_TRACE(row.name);
    const auto& x = row.points;
    const Point<3>&p0 = x[0], &q0 = x[1], &p1 = x[2], &q1 = x[3];
    const Body_soup<3> edge{{x[4], x[5]}, {{0, 1}}, {}};
    // One end after the other, the other end stands still meanwhile.
    const bool p_first[] = {move_tip(p0, p1, q0, edge, seen), move_tip(q0, q1, p1, edge, seen)},
               q_first[] = {move_tip(q0, q1, p0, edge, seen), move_tip(p0, p1, q1, edge, seen)};
    EXPECT_EQ(p_first[0] || p_first[1], row.labels[1]);
    EXPECT_EQ(q_first[0] || q_first[1], row.labels[2]);
    labels_p += row.labels[1];
    labels_q += row.labels[2];
    ASSERT_EQ(seen.tally.wrong(), 0);
  }
  std::cout << rows.size() << " edge/edge queries: " << seen << "\n";
  EXPECT_EQ(rows.size(), 821u);
  EXPECT_EQ(labels_p, 106);
  EXPECT_EQ(labels_q, 112);
  EXPECT_EQ(seen.wide, 0);
  EXPECT_LT(seen.starts_across + seen.without_needle, 40);
  EXPECT_GT(seen.contacts, 190);
}

}  // namespace
}  // namespace cellwalk::test
