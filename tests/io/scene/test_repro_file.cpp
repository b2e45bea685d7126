// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/repro_file.h>

#include "io/io_fixture.h"

namespace cellwalk::io {
namespace {

/// Two squares with a wall between them, the second solid.
Repro<2> sample() {
  Repro<2> record;
  record.soup.points = {{0, 0}, {1, 0}, {0.1, 1}, {0x1p-1060, 1}, {2, 0}, {2, 1}};
  add_polygon(record.soup, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  record.soup.impassable[1] = 1;
  add_polygon(record.soup, std::array<std::uint32_t, 4>{1, 4, 5, 2});
  record.soup.solid[1] = 1;
  record.from = {0x1.fffffffffffffp-1, 1.0 / 3};
  record.to = {-0.1, 1e300};
  record.kernel = "double";
  record.note = "missed";
  return record;
}

class ReproFile : public testing::Test {
 protected:
  /// Reads the sample with a part of its text replaced, which must be there.
  std::string refusal(const std::string& part, const std::string& other, double radius = 0) {
    const auto path = folder_ / "motion.json";
    std::string text = written(radius);
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    std::ofstream(path) << text.replace(at, part.size(), other);
    try {
      read_repro(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::input);
      return error.what();
    }
    return {};
  }

  /// The text of the sample.
  std::string written(double radius) {
    Repro<2> record = sample();
    record.radius = radius;
    write_repro(folder_ / "motion.json", record);
    std::ifstream in(folder_ / "motion.json");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  Folder folder_;
};

TEST_F(ReproFile, ReadsBackWhatWasWritten) {
  Repro<2> written = sample();
  for (const bool has_cell : {false, true}) {
    if (has_cell) written.cell = 1;
    write_repro(folder_ / "motion.json", written);
    const auto read = std::get<Repro<2>>(read_repro(folder_ / "motion.json"));
    EXPECT_EQ(read.soup.points, written.soup.points);
    EXPECT_EQ(read.soup.cell_begin, written.soup.cell_begin);
    EXPECT_EQ(read.soup.facet_begin, written.soup.facet_begin);
    EXPECT_EQ(read.soup.vertices, written.soup.vertices);
    EXPECT_EQ(read.soup.impassable, written.soup.impassable);
    EXPECT_EQ(read.soup.solid, written.soup.solid);
    EXPECT_EQ(read.from, written.from);
    EXPECT_EQ(read.to, written.to);
    EXPECT_EQ(read.cell, written.cell);
    EXPECT_EQ(read.kernel, "double");
    EXPECT_EQ(read.strategy, "exit_rule");
    EXPECT_EQ(read.note, "missed");
  }
}

TEST_F(ReproFile, ReadsTetrahedra) {
  Repro<3> written;
  written.soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_tetrahedron(written.soup, 0, 1, 2, 3);
  written.from = {0.1, 0.2, 0.3};
  written.to = {1, 1, 1};
  write_repro(folder_ / "motion.json", written);
  const auto read = std::get<Repro<3>>(read_repro(folder_ / "motion.json"));
  EXPECT_EQ(read.soup.vertices, written.soup.vertices);
  EXPECT_EQ(read.from, written.from);
}

TEST_F(ReproFile, HasTheFormatOfItsRadius) {
  const std::string thin = written(0);
  EXPECT_NE(thin.find("cellwalk motion 1"), std::string::npos);
  EXPECT_EQ(thin.find("radius"), std::string::npos);
  EXPECT_EQ(written(-0.0), thin);
  for (const double radius : {0.1, 0x1p-1074, 1e308}) {
    EXPECT_NE(written(radius).find("cellwalk motion 2"), std::string::npos);
    EXPECT_EQ(std::get<Repro<2>>(read_repro(folder_ / "motion.json")).radius, radius);
  }
  EXPECT_EQ(std::get<Repro<2>>(parse_repro("thin", thin)).radius, 0);
}

TEST_F(ReproFile, RefusesWrongRadii) {
  EXPECT_EQ(refusal("\"radius\": 0.5", "\"radius\": 0", 0.5), "");
  for (const char* other : {"\"radius\": -0.5", "\"radius\": \"0.5\"", "\"radius\": null", "\"note2\": 1"})
    EXPECT_NE(refusal("\"radius\": 0.5", other, 0.5).find(other[1] == 'r' ? "radius" : "note2"),
              std::string::npos)
        << other;
  EXPECT_NE(refusal("motion 2", "motion 1", 0.5).find("radius: unknown key"), std::string::npos);
  EXPECT_NE(refusal("motion 1", "motion 2").find("key \"radius\" is missing"), std::string::npos);
}

TEST_F(ReproFile, RefusesWhatItDoesNotUnderstand) {
  EXPECT_EQ(refusal("motion 1", "motion 1"), "");
  EXPECT_NE(refusal("motion 1", "motion 3").find("format"), std::string::npos);
  EXPECT_NE(refusal("\"note\"", "\"nota\"").find("nota"), std::string::npos);
  EXPECT_NE(refusal("\"to\"", "\"note2\"").find("note2"), std::string::npos);
  EXPECT_NE(refusal("\"dimension\": 2", "\"dimension\": 4").find("dimension"), std::string::npos);
  EXPECT_NE(refusal("\"solid\": true", "\"solid\": 1").find("cells[1].solid"), std::string::npos);
}

}  // namespace
}  // namespace cellwalk::io
