// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies thrown around in a real vessel.
#include <cellwalk/environment/environment.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include "simulation/long_flight.h"

namespace cellwalk::test {
namespace {

TEST(LongFlight, InAnAneurysm) {
  const Surface_soup surface = io::read_surface(CELLWALK_TEST_DATA "/surface/aneurysm3D_1.off");
  const Environment<3> environment = Environment<3>::build(tetrahedralize(surface));
  expect_long_flights_are_sound(environment.snapshot(), 1.0, 150'000);
}

}  // namespace
}  // namespace cellwalk::test
