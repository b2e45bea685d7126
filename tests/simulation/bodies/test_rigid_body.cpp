// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies thrown around in generated environments: the invariants hold at any time, no certificate changes
// anything, and nothing gets stuck.
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/vessel.h>

#include <gtest/gtest.h>

#include "simulation/long_flight.h"
#include "simulation/worlds.h"

namespace cellwalk::test {
namespace {

TEST(RigidBody, KeepsItsInvariantsInAGrid2) {
  const Snapshot<2> snapshot = rooms<2>({8, 8}, {18, 21, 42, 45, 28});
  expect_flights_are_sound<2>(snapshot, polygon_body(5, 0.4), 12, 800);
}

TEST(RigidBody, KeepsItsInvariantsInAGrid3) {
  const Snapshot<3> snapshot = rooms<3>({4, 4, 4}, {21, 42, 5, 58});
  expect_flights_are_sound<3>(snapshot, hexahedron_body(0.5, false), 12, 200);
}

TEST(RigidBody, KeepsItsInvariantsInAVessel) {
  const Snapshot<3> snapshot = compile(branching_vessel({}));
  expect_flights_are_sound<3>(snapshot, hexahedron_body(0.5, false), 12, 300);
}

TEST(RigidBody, KeepsFacesFree) {
  // Boxes larger than the solid cells between which they fly.
  const Snapshot<3> snapshot = rooms<3>({8, 8, 8}, {155, 236, 292, 349, 100});
  const Body_soup<3> shape = box_body({1.7, 1.6, 1.5}, {1, 1, 1}, true);
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  const Flown flown = fly<3>(snapshot, shape, 8, 300, 0.05, 5, 3, true, options);
  std::cout << flown.counts.faces.faces << " faces swept, " << flown.counts.faces.clear << " clear, "
            << flown.contacts << " contacts, " << flown.face_contacts << " of faces\n";
  EXPECT_EQ(flown.differing, 0u);
  EXPECT_EQ(flown.stuck, 0u);
  EXPECT_GT(flown.face_contacts, 5u);
  EXPECT_GT(flown.counts.faces.clear, 1000u);
}

TEST(LongFlight, InAVessel) { expect_long_flights_are_sound(compile(branching_vessel({})), 0.5, 150'000); }

}  // namespace
}  // namespace cellwalk::test
