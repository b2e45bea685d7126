// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace cellwalk::drawing {
namespace {

using Pixel = std::array<std::uint8_t, 3>;

constexpr Colour red{1, 0, 0}, blue{0, 0, 1}, white{1, 1, 1};

/// A small picture on white, seen from above, without perspective.
Picture_options plain(int width = 120, int height = 100) {
  Picture_options options;
  options.width = width;
  options.height = height;
  options.camera = {{0, 0, 1}, {0, 1, 0}, 0};
  options.top = options.bottom = white;
  return options;
}

void add_square(Drawing& drawing, double half, double z, std::uint32_t material) {
  const std::vector<Point<3>> points{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  const std::vector<std::vector<std::uint32_t>> facets{{0, 1, 2, 3}};
  add_surface(drawing, points, facets, material);
}

std::uint32_t flat(Drawing& drawing, Colour colour, double opacity = 1) {
  colour.opacity = opacity;
  return drawing.add_material({colour, 0, false});
}

bool is_near(const Pixel& p, int r, int g, int b, int error = 1) {
  return std::abs(p[0] - r) <= error && std::abs(p[1] - g) <= error && std::abs(p[2] - b) <= error;
}

TEST(Picture, FitsTheDrawing) {
  Drawing drawing;
  add_square(drawing, 7, 3, flat(drawing, red));
  const Image image = render(drawing, plain());
  ASSERT_EQ(image.rgb.size(), 3u * 120 * 100);
  int area = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) area += is_near(image.pixel(x, y), 255, 0, 0);
  EXPECT_NEAR(area, 84 * 84, 300);  // the height less the caption's strip and the margins
  EXPECT_TRUE(is_near(image.pixel(60, 47), 255, 0, 0));
  EXPECT_TRUE(is_near(image.pixel(5, 47), 255, 255, 255));
}

TEST(Picture, TheNearerSurfaceHidesTheOther) {
  for (const bool red_first : {true, false}) {
    Drawing drawing;
    const auto a = flat(drawing, red), b = flat(drawing, blue);
    if (red_first) add_square(drawing, 2, 1, a);
    add_square(drawing, 2, 0, b);
    if (!red_first) add_square(drawing, 2, 1, a);
    EXPECT_TRUE(is_near(render(drawing, plain()).pixel(60, 47), 255, 0, 0));
  }
}

TEST(Picture, TranslucentLayersDoNotDependOnTheirOrder) {
  for (const bool red_first : {true, false}) {
    Drawing drawing;
    const auto a = flat(drawing, red, 0.5), b = flat(drawing, blue, 0.5);
    if (red_first) add_square(drawing, 2, 1, a);
    add_square(drawing, 2, 0, b);
    if (!red_first) add_square(drawing, 2, 1, a);
    // White, then half blue, then half red.
    EXPECT_TRUE(is_near(render(drawing, plain()).pixel(60, 47), 191, 64, 127));
  }
}

TEST(Picture, NeighbouringTrianglesLeaveNeitherSeamNorOverlap) {
  Drawing drawing;
  const auto glass = flat(drawing, red, 0.5);
  std::vector<Point<3>> points{{0, 0, 0}};
  std::vector<std::vector<std::uint32_t>> facets;
  for (std::uint32_t i = 0; i < 37; ++i) {  // a fan of thin triangles
    points.push_back({std::cos(0.17 * i), std::sin(0.17 * i), 0});
    facets.push_back({0, i + 1, (i + 1) % 37 + 1});
  }
  facets.back() = {0, 37, 1};
  add_surface(drawing, points, facets, glass);
  const Image image = render(drawing, plain());
  for (int y = 30; y < 65; ++y)
    for (int x = 42; x < 78; ++x) EXPECT_TRUE(is_near(image.pixel(x, y), 255, 128, 128)) << x << ' ' << y;
}

TEST(Picture, PerspectiveShrinksWhatIsFar) {
  Drawing drawing;
  add_square(drawing, 1, 0, flat(drawing, red));
  add_square(drawing, 1, -20, flat(drawing, blue));
  Picture_options options = plain(200, 200);
  options.camera.field_of_view = 40;
  const Image perspective = render(drawing, options);
  options.camera.field_of_view = 0;
  const Image parallel = render(drawing, options);
  EXPECT_EQ(perspective.pixel(100, 95), parallel.pixel(100, 95));
  const auto count = [](const Image& image, const Pixel& p) {
    int n = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) n += image.pixel(x, y) == p;
    return n;
  };
  EXPECT_EQ(count(perspective, {0, 0, 255}), 0);  // hidden behind the nearer one, which looks larger
  // Seen from behind, the far one is the near one.
  options.camera = {{0, 0, -1}, {0, 1, 0}, 40};
  const Image behind = render(drawing, options);
  EXPECT_EQ(count(behind, {255, 0, 0}), 0);
  EXPECT_GT(count(behind, {0, 0, 255}), 10000);
}

TEST(Picture, ShapesAreLitRoundAndInPlace) {
  Drawing drawing;
  const auto grey = drawing.add_material({{0.5, 0.5, 0.5}});
  add_ball(drawing, {0, 0, 0}, 1, grey);
  const Image ball = render(drawing, plain());
  std::set<Pixel> shades;
  int area = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x)
      if (ball.pixel(x, y) != Pixel{255, 255, 255}) ++area, shades.insert(ball.pixel(x, y));
  EXPECT_NEAR(area, 3.14 * 41.5 * 41.5, 250);
  EXPECT_GT(shades.size(), 20u);

  for (const Vector<3>& along : {Vector<3>{1, 0, 0}, Vector<3>{0.3, 1, 0}, Vector<3>{0, -1, 0.5}}) {
    Drawing arrow;
    add_arrow(arrow, {0, 0, 0}, along, 2, 0.05, arrow.add_material({red}));
    double furthest = -1;
    for (const Picture_triangle& t : arrow.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        furthest = std::max(furthest, dot(t.corners[i], along) / length(along));
        EXPECT_NEAR(length(t.normals[i]), 1, 1e-12);
      }
    EXPECT_NEAR(furthest, 2, 1e-12);
  }

  // A tube keeps its radius along straight pieces, and survives repeated points and reversals.
  Drawing tube;
  const std::vector<Point<3>> line{{0, 0, 0}, {0, 0, 0}, {5, 0, 0}, {9, 0, 0}, {5, 0, 0}};
  add_tube(tube, line, 0.5, tube.add_material({red}));
  for (const Picture_triangle& t : tube.triangles)
    for (const Point<3>& p : t.corners) {
      EXPECT_TRUE(is_finite(p));
      EXPECT_LE(std::hypot(p[1], p[2]), 0.5 + 1e-12);
      EXPECT_TRUE(p[0] >= -0.5 - 1e-12 && p[0] <= 9.5 + 1e-12);
    }
}

TEST(Picture, FlatShapesCoverWhatTheyShould) {
  Drawing drawing;
  add_flat_line(drawing, {0, 0}, {10, 0}, 1, 0, flat(drawing, blue));
  add_disc(drawing, {5, 0}, 2, 0.1, flat(drawing, red));
  add_flat_arrow(drawing, {5, 3}, {0, 1}, 2, 0.3, 0, flat(drawing, blue));
  const Image image = render(drawing, plain(220, 200));
  int reds = 0, blues = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 220; ++x) {
      reds += is_near(image.pixel(x, y), 255, 0, 0);
      blues += is_near(image.pixel(x, y), 0, 0, 255);
    }
  const double unit = 196.0 / 11;  // pixels: 11 units fill the width between its margins
  EXPECT_NEAR(reds, 3.14 * 4 * unit * unit, 250);
  EXPECT_NEAR(blues, (6 + 0.8 + 0.9) * unit * unit, 400);
}

TEST(Picture, AnEmptyDrawingGivesTheBackground) {
  Picture_options options = plain(32, 16);
  options.bottom = red;
  const Image image = render({}, options);
  EXPECT_GT(image.pixel(5, 0)[1], 240);
  EXPECT_LT(image.pixel(5, 15)[1], 15);
}

TEST(Picture, WritesItsCaption) {
  Drawing drawing;
  drawing.caption = "abc 123";
  const Image image = render(drawing, plain(400, 300));
  int ink = 0, above = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) (y > 280 ? ink : above) += image.pixel(x, y)[0] < 128;
  EXPECT_GT(ink, 30);
  EXPECT_EQ(above, 0);
  Image text{200, 40, std::vector<std::uint8_t>(3 * 200 * 40, 255)};
  const double width = draw_text(text, "Wide", 5, 30, 20, {0, 0, 0});
  EXPECT_GT(width, draw_text(text, "i", 5, 30, 20, {0, 0, 0}));
  for (char c = ' '; c <= '~'; ++c) {  // every printable character advances
    EXPECT_GT(draw_text(text, std::string(1, c), 0, 0, 20, {0, 0, 0}), 0) << c;
  }
}

TEST(Picture, MakesALongCaptionFit) {
  Drawing drawing;
  drawing.caption = std::string(80, 'H');
  const Image image = render(drawing, plain(400, 300));
  int left = 0, right = 0, margin = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) (x < 200 ? left : x < 395 ? right : margin) += image.pixel(x, y)[0] < 200;
  EXPECT_GT(left, 100);
  EXPECT_GT(right, 100);
  EXPECT_EQ(margin, 0);
}

TEST(Picture, RefusesSizesOutOfRange) {
  EXPECT_THROW(render({}, plain(5, 100)), Error);
  EXPECT_THROW(render({}, plain(100, 20000)), Error);
  Picture_options options = plain();
  options.samples = 0;
  EXPECT_THROW(render({}, options), Error);
}

TEST(Picture, RoundShapesAreCountedBeforeTheyAreDrawn) {
  const std::vector<Point<3>> line{{0, 0, 0}, {1, 0, 0}, {2, 1, 0}};
  for (const int sides : {20, 12, 8, 6, 4, 3}) {
    Drawing round, flat;
    round.sides = flat.sides = sides;
    for (int i = 0; i < 7; ++i) {
      add_ball(round, {3.0 * i, 0, 0}, 1, 0);
      add_disc(flat, {3.0 * i, 0}, 1, 0, 0);
    }
    add_tube(round, line, 0.1, 0);
    add_flat_line(flat, {0, 0}, {1, 0}, 0.1, 0, 0);
    EXPECT_EQ(round.triangles.size(), triangles_of({7, 2, 2}, sides, false)) << sides;
    EXPECT_EQ(flat.triangles.size(), triangles_of({7, 1, 2}, sides, true)) << sides;
  }
}

TEST(Picture, SidesFitIntoABudget) {
  for (const bool flat : {false, true}) {
    int before = finest_sides + 1;
    for (std::size_t n = 1; n < 100'000'000; n *= 3) {
      const Round_shapes shapes{n, n / 2, n / 3};
      const int sides = sides_within(shapes, 600'000, flat);
      EXPECT_LE(sides, before);
      EXPECT_TRUE(sides == 3 || triangles_of(shapes, sides, flat) <= 600'000) << n;
      before = sides;
    }
    EXPECT_EQ(sides_within({100, 0, 0}, 600'000, flat), finest_sides);
    EXPECT_EQ(before, 3);
  }
}

// Few sides make rougher shapes of the same size and place.
TEST(Picture, CoarseShapesCoverAboutTheSame) {
  const auto area = [](int sides) {
    Drawing drawing;
    drawing.sides = sides;
    add_ball(drawing, {0, 0, 0}, 1, flat(drawing, red));
    add_tube(drawing, std::vector<Point<3>>{{-3, 0, 0}, {3, 0, 0}}, 0.3, 0);
    const Image image = render(drawing, plain());
    int count = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 120; ++x) count += image.pixel(x, y) != Pixel{255, 255, 255};
    return count;
  };
  const int fine = area(finest_sides);
  for (const int sides : {12, 8, 6, 4, 3}) {
    EXPECT_GT(area(sides), fine / 2) << sides;
    EXPECT_LT(area(sides), 2 * fine) << sides;
  }
}

// So many layers of glass that bands are split, then that fewer samples are taken, then that none suffices.
TEST(Picture, ManyLayersAreDrawnInBoundedMemory) {
  Drawing drawing;
  const auto glass = flat(drawing, red, 0.01);
  const auto add_layers = [&](int count) {
    for (int i = 0; i < count; ++i)
      add_square(drawing, 1, 1e-7 * static_cast<double>(drawing.triangles.size()), glass);
  };
  add_layers(400);
  const Pixel middle = render(drawing, plain()).pixel(60, 47);
  EXPECT_TRUE(is_near(middle, 255, 5, 5, 2)) << int{middle[1]};  // 255 (1 - 0.01)^400 = 4.6
  add_layers(1300);
  EXPECT_TRUE(is_near(render(drawing, plain()).pixel(60, 47), 255, 0, 0, 1));
  add_layers(15000);
  EXPECT_THROW(render(drawing, plain()), Error);
}

// In a large picture, few layers cover as many samples; it is refused before anything is drawn.
TEST(Picture, LargeOnesOfManyLayersAreRefused) {
  Drawing drawing;
  const auto glass = flat(drawing, red, 0.01);
  const auto add_layers = [&](int count) {
    for (int i = 0; i < count; ++i)
      add_square(drawing, 1, 1e-7 * static_cast<double>(drawing.triangles.size()), glass);
  };
  add_layers(40);
  EXPECT_EQ(render(drawing, plain(128, 128)).rgb.size(), 3u * 128 * 128);
  for (const int size : {8192, 10'000, 16'384})
    EXPECT_THROW(render(drawing, plain(size, size)), Error) << size;
}

std::uint32_t number_at(const std::string& s, std::size_t i) {
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < 4; ++k) n = n << 8 | static_cast<std::uint8_t>(s[i + k]);
  return n;
}

TEST(Picture, PngHoldsThePixels) {
  Drawing drawing;
  add_ball(drawing, {0, 0, 0}, 1, drawing.add_material({{0.2, 0.5, 0.8, 0.5}, 0.4}));
  const Image image = render(drawing, plain(37, 29));
  const std::string png = encode_png(image);
  ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::vector<std::string> types;
  std::string packed;
  for (std::size_t at = 8; at < png.size();) {
    const std::size_t size = number_at(png, at);
    const std::string type = png.substr(at + 4, 4), data = png.substr(at + 8, size);
    const std::string body = type + data;
    EXPECT_EQ(number_at(png, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())));
    types.push_back(type);
    if (type == "IHDR") {
      EXPECT_EQ(number_at(data, 0), 37u);
      EXPECT_EQ(number_at(data, 4), 29u);
    }
    if (type == "IDAT") packed = data;
    at += size + 12;
  }
  EXPECT_EQ(types, (std::vector<std::string>{"IHDR", "IDAT", "IEND"}));
  std::string rows((37 * 3 + 1) * 29, '\0');
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  std::vector<std::uint8_t> above(37 * 3, 0);
  for (std::size_t y = 0; y < 29; ++y) {
    ASSERT_EQ(rows[y * 112], 2);
    for (std::size_t i = 0; i < 111; ++i) {
      above[i] = static_cast<std::uint8_t>(above[i] + static_cast<std::uint8_t>(rows[y * 112 + 1 + i]));
      ASSERT_EQ(above[i], image.rgb[y * 111 + i]);
    }
  }
}

}  // namespace
}  // namespace cellwalk::drawing
