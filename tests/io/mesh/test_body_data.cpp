// SPDX-License-Identifier: LGPL-3.0-or-later
// Public meshes of bodies: closed surfaces of one part, so that vertices, edges and faces obey Euler's
// formula.
#include <cellwalk/io/body_file.h>

#include <gtest/gtest.h>

#include "io/io_fixture.h"
#include "records/body_checks.h"

namespace cellwalk::io {
namespace {

struct Body {
  const char* file;
  std::size_t points, polygons, handles;
};

TEST(PublicBodies, AreClosedSurfaces) {
  const Body bodies[] = {{"torus.obj", 800, 1600, 1}, {"meca_snake_900tri.obj", 497, 990, 0}};
  for (const Body& b : bodies) {
    SCOPED_TRACE(b.file);
    const auto file = read_body<3>(std::filesystem::path(CELLWALK_TEST_DATA) / "body" / b.file);
    EXPECT_EQ(test::flaw(file.body), "");
    EXPECT_EQ(file.body.points.size(), b.points);
    EXPECT_EQ(file.body.faces.size(), b.polygons);
    EXPECT_EQ(2 * file.body.edges.size(), 3 * b.polygons);
    EXPECT_EQ(b.points + b.polygons + 2 * b.handles, file.body.edges.size() + 2);
    const std::string message =
        refusal([&] { read_body<2>(std::filesystem::path(CELLWALK_TEST_DATA) / "body" / b.file); });
    EXPECT_NE(message.find(", in a 2D body: "), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace cellwalk::io
