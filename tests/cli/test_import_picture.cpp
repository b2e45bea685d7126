// SPDX-License-Identifier: LGPL-3.0-or-later
// `cellwalk import --picture`: what its pixels show.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>

#include "cli/meshes.h"
#include "cli/program.h"

namespace cellwalk::test {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour cap{26, 97, 204}, sheet{140, 56, 179}, open_edge{219, 20, 26};

std::uint32_t number_at(const std::string& s, std::size_t i) {
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < 4; ++k) n = n << 8 | static_cast<std::uint8_t>(s.at(i + k));
  return n;
}

/// A PNG as the library writes it: RGB, each row as differences from the one above.
struct Png {
  std::uint32_t width, height;
  std::map<Colour, std::size_t> pixels{};  // of each colour

  explicit Png(const std::string& bytes) : width(number_at(bytes, 16)), height(number_at(bytes, 20)) {
    std::string packed;
    for (std::size_t at = 8; at < bytes.size(); at += number_at(bytes, at) + 12)
      if (bytes.substr(at + 4, 4) == "IDAT") packed += bytes.substr(at + 8, number_at(bytes, at));
    const std::size_t stride = 3 * std::size_t{width} + 1;
    std::vector<std::uint8_t> rows(stride * height);
    uLongf size = rows.size();
    EXPECT_EQ(uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
              Z_OK);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t i = 1; i < stride; ++i) {
        if (y > 0)
          rows[y * stride + i] = static_cast<std::uint8_t>(rows[y * stride + i] + rows[(y - 1) * stride + i]);
        if (i % 3 == 0) ++pixels[{rows[y * stride + i - 2], rows[y * stride + i - 1], rows[y * stride + i]}];
      }
  }
  /// Pixels of a colour, up to rounding, or up to what a translucent wall in front of it changes.
  std::size_t count(const Colour& colour, int most_apart = 1) const {
    std::size_t n = 0;
    for (const auto& [c, number] : pixels) {
      int apart = 0;
      for (std::size_t k = 0; k < 3; ++k) apart = std::max(apart, std::abs(c[k] - colour[k]));
      if (apart <= most_apart) n += number;
    }
    return n;
  }
};

class ImportPicture : public Program {
 protected:
  Png picture(const std::string& mesh, std::vector<std::string> options = {}) const {
    std::vector<std::string> words{"import", mesh, "-o", "env.ovm", "--picture", "p.png"};
    words.insert(words.end(), options.begin(), options.end());
    succeed(words);
    return Png(text("p.png"));
  }
};

constexpr std::size_t swatch = 2000;  // pixels, more than one of the legend has

TEST_F(ImportPicture, OfCellsShowsThem) {
  write("cube.ovm", hexahedron_ovm(0));
  const Png png = picture("cube.ovm");
  EXPECT_GT(png.width, 1200u);
  EXPECT_EQ(png.count(cap), 0u);
  EXPECT_EQ(png.count(open_edge), 0u);
  EXPECT_GT(png.pixels.size(), 100u);
  succeed({"generate", "squares", "--cells", "6", "4", "-o", "plane.ovm"});
  EXPECT_GT(picture("plane.ovm").pixels.size(), 4u);
}

TEST_F(ImportPicture, ReplacesNoInputAndAppearsWithTheEnvironmentOnly) {
  write("cube.ovm", hexahedron_ovm(0));
  expect_failure(2, {"import", "cube.ovm", "-o", "env.ovm", "--picture", "cube.ovm"}, {"cube.ovm"});
  expect_failure(2, {"import", "cube.ovm", "-o", "env.ovm", "--picture", "env.ovm"}, {"env.ovm"});
  write("words.ovm", "no mesh at all\n");
  expect_failure(3, {"import", "words.ovm", "-o", "out.ovm", "--picture", "p.png"}, {"words.ovm"});
  EXPECT_FALSE(exists("p.png"));
}

#ifdef CELLWALK_TEST_MESHING
TEST_F(ImportPicture, ShowsCapsWhereTheSurfaceIsOpen) {
  write("closed.off", cube_off());
  const Png closed = picture("closed.off");
  EXPECT_EQ(closed.width, 1642u) << "two panels";
  EXPECT_EQ(closed.count(cap), 0u);
  EXPECT_EQ(closed.count(open_edge), 0u);
  write("open.off", open_cube_off());
  const Png open = picture("open.off");
  EXPECT_GT(open.count(cap), swatch);
  EXPECT_GT(open.count(open_edge), 0u);
  EXPECT_EQ(open.count(sheet), 0u);
  write("names.json", R"({"inlet": [0, 0, 0]})");
  EXPECT_GT(picture("open.off", {"--names", "names.json"}).count(cap), swatch) << "a cap of any name";
  const std::string bytes = text("p.png");
  picture("open.off", {"--names", "names.json"});
  EXPECT_EQ(text("p.png"), bytes);
}

TEST_F(ImportPicture, ShowsSheetsInside) {
  write("box.off",
        "OFF\n12 7 0\n0 0 0\n8 0 0\n8 4 0\n0 4 0\n0 0 4\n8 0 4\n8 4 4\n0 4 4\n4 1 1\n4 3 1\n4 3 3\n4 1 3\n"
        "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n4 8 9 10 11\n");
  const Png png = picture("box.off");
  EXPECT_GT(png.count(sheet, 20), swatch);
  EXPECT_EQ(png.count(cap), 0u);
}
#endif

}  // namespace
}  // namespace cellwalk::test
