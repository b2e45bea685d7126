// SPDX-License-Identifier: LGPL-3.0-or-later
// A stroke font, so that captions need neither a font file nor a library.
//
// A glyph is an advance width and strokes separated by ';'. A stroke is a run of points, two hexadecimal
// digits each: x, and y counted up from the descender line (baseline 3, lower-case height 9, capitals c). '~'
// rounds the corners.
#include <cellwalk/internal/drawing/picture.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace cellwalk::drawing {
namespace {

struct Glyph {
  char character;
  int width;
  std::string_view strokes;
};

constexpr double baseline = 3, capital_height = 9;  // grid units
constexpr double gap = 2.6;                         // between glyphs
constexpr double pen = 1.05;                        // width of a stroke

constexpr Glyph glyphs[] = {
    {' ', 2, ""},
    {'!', 0, "0c06;0303"},
    {'\'', 0, "0c0a"},
    {'"', 2, "0c0a;2c2a"},
    {'#', 6, "2c13;5c43;0969;0666"},
    {'%', 6, "6c03;~1c0b1a2b1c;~5544536455"},
    {'(', 2, "~2d0a0522"},
    {')', 2, "~0d2a2502"},
    {'*', 4, "2b27;0a48;084a"},
    {'+', 6, "3a34;0767"},
    {',', 1, "1402"},
    {'-', 4, "0747"},
    {'.', 0, "0303"},
    {'/', 5, "025c"},
    {'0', 6, "~3c1b0906143354666 95b3c"},
    {'1', 3, "0a3c33"},
    {'2', 6, "~0a1b3c5b6958;580363"},
    {'3', 6, "~0b3c5b5938;~386765543304"},
    {'4', 6, "434c0666"},
    {'5', 6, "5c1c08;~08395866543304"},
    {'6', 6, "~38170614335465573 8;~062a4c"},
    {'7', 6, "0c6c23"},
    {'8', 6, "~3c1b1938595b3c;~3817051433546557 38"},
    {'9', 6, "~3c1b0917375769 5b3c;~69665413"},
    {':', 0, "0404;0808"},
    {';', 1, "1402;1808"},
    {'<', 5, "5a0754"},
    {'=', 6, "0868;0565"},
    {'>', 5, "0a5704"},
    {'?', 5, "~0a1b3c4b4926 25;2323"},
    {'A', 6, "033c63;1656"},
    {'B', 6, "3c0c03 33;0838;~3c5b5938;~3867 64 33"},
    {'C', 6, "~6a5b3c1b09061433 5465"},
    {'D', 6, "2c0c0323;~2c5b69665423"},
    {'E', 6, "6c0c0363;0858"},
    {'F', 6, "6c0c03;0858"},
    {'G', 6, "~6a5b3c1b09061433 5465;656747"},
    {'H', 6, "0c03;6c63;0868"},
    {'I', 0, "0c03"},
    {'J', 5, "~5c5755 43 1305"},
    {'K', 6, "0c03;6c07;2963"},
    {'L', 5, "0c0353"},
    {'M', 8, "030c478c83"},
    {'N', 6, "030c636c"},
    {'O', 6, "~3c1b0906143354666 95b3c"},
    {'P', 6, "030c3c;~3c5b6a5938;0838"},
    {'Q', 6, "~3c1b0906143354666 95b3c;4563"},
    {'R', 6, "030c3c;0838;~3c5b6a5938;3863"},
    {'S', 6, "~6a5b3c1b0a1938576654 331405"},
    {'T', 6, "0c6c;3c33"},
    {'U', 6, "~0c0806143354 66686c"},
    {'V', 6, "0c336c"},
    {'W', 8, "0c234a638c"},
    {'X', 6, "0c63;036c"},
    {'Y', 6, "0c386c;3833"},
    {'Z', 6, "0c6c0363"},
    {'_', 6, "0262"},
    {'a', 6, "~391806143354665839;6963"},
    {'b', 6, "~391806143354665839;0c03"},
    {'c', 5, "~583918061433 54"},
    {'d', 6, "~391806143354665839;6c63"},
    {'e', 6, "0666;~66583918061433 54"},
    {'f', 4, "~4c3c2a2723;0949"},
    {'g', 6, "~391806143354665839;~696361 4010"},
    {'h', 6, "0c03;~071939586663"},
    {'i', 0, "0903;0c0c"},
    {'j', 2, "~29252110 00;2c2c"},
    {'k', 5, "0c03;5905;2653"},
    {'l', 0, "0c03"},
    {'m', 8, "0903;~0718294743;~4758697883"},
    {'n', 6, "0903;~071939586663"},
    {'o', 6, "~391806143354665839"},
    {'p', 6, "~391806143354665839;0900"},
    {'q', 6, "~391806143354665839;6960"},
    {'r', 4, "0903;~07182949"},
    {'s', 5, "~583918173655443313 04"},
    {'t', 4, "~2c28253343;0949"},
    {'u', 6, "~0906143354 65;6963"},
    {'v', 6, "093369"},
    {'w', 8, "0923496389"},
    {'x', 5, "0953;5903"},
    {'y', 6, "0933;6920"},
    {'z', 5, "09590353"},
};

int digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

/// The strokes of a glyph as fine polylines, in grid units.
std::vector<std::vector<Point<2>>> polylines(std::string_view strokes) {
  constexpr int pieces = 6;  // of a rounded stroke between two points
  std::vector<std::vector<Point<2>>> result;
  while (!strokes.empty()) {
    const std::size_t end = std::min(strokes.find(';'), strokes.size());
    std::string_view stroke = strokes.substr(0, end);
    strokes.remove_prefix(std::min(end + 1, strokes.size()));
    const bool rounded = stroke.starts_with('~');
    std::vector<int> digits;
    for (const char c : stroke)
      if (c != '~' && c != ' ') digits.push_back(digit(c));
    std::vector<Point<2>> points;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
      points.push_back({double(digits[i]), double(digits[i + 1])});
    if (!rounded) {
      result.push_back(points);
      continue;
    }
    const bool closed = points.front() == points.back();
    const std::size_t n = points.size();
    const auto before = [&](std::size_t i) {
      return i > 0 ? points[i - 1] : closed ? points[n - 2] : points[0];
    };
    const auto after = [&](std::size_t i) {
      return i + 1 < n ? points[i + 1] : closed ? points[1] : points[n - 1];
    };
    std::vector<Point<2>> fine{points[0]};
    for (std::size_t i = 0; i + 1 < n; ++i) {  // a Catmull-Rom spline
      const Vector<2> d0 = 0.5 * (after(i) - before(i)), d1 = 0.5 * (after(i + 1) - before(i + 1));
      for (int k = 1; k <= pieces; ++k) {
        const double t = double(k) / pieces, s = 1 - t;
        fine.push_back((s * s * (1 + 2 * t)) * points[i] + (s * s * t) * d0 +
                       (t * t * (3 - 2 * t)) * points[i + 1] - (t * t * s) * d1);
      }
    }
    result.push_back(fine);
  }
  return result;
}

double distance(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  const Vector<2> ab = b - a, ap = p - a;
  const double l2 = dot(ab, ab), t = l2 > 0 ? std::clamp(dot(ap, ab) / l2, 0.0, 1.0) : 0.0;
  return length(ap - t * ab);
}

/// Covers the picture along a polyline given in pixels.
void stroke(Image& image, const std::vector<Point<2>>& line, double width, const Colour& colour) {
  Point<2> low = line[0], high = line[0];
  for (const Point<2>& p : line)
    for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  const double reach = width / 2 + 1;
  const auto clamp_to = [](double a, int size) { return static_cast<int>(std::clamp(a, 0.0, double(size))); };
  for (int y = clamp_to(low[1] - reach, image.height); y < clamp_to(high[1] + reach + 1, image.height); ++y)
    for (int x = clamp_to(low[0] - reach, image.width); x < clamp_to(high[0] + reach + 1, image.width); ++x) {
      const Point<2> centre{x + 0.5, y + 0.5};
      double nearest = distance(centre, line[0], line[0]);
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        nearest = std::min(nearest, distance(centre, line[i], line[i + 1]));
      const double cover = colour.opacity * std::clamp(width / 2 + 0.5 - nearest, 0.0, 1.0);
      if (cover <= 0) continue;
      const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(x));
      const double ink[3] = {colour.red, colour.green, colour.blue};
      for (std::size_t i = 0; i < 3; ++i)
        image.rgb[at + i] =
            static_cast<std::uint8_t>(image.rgb[at + i] * (1 - cover) + 255 * ink[i] * cover + 0.5);
    }
}

}  // namespace

double draw_text(Image& image, const std::string& text, double x, double y, double size,
                 const Colour& colour) {
  const double unit = size / capital_height;
  double pen_x = x;
  for (const char c : text) {
    const Glyph* glyph =
        std::find_if(std::begin(glyphs), std::end(glyphs), [c](const Glyph& g) { return g.character == c; });
    if (glyph == std::end(glyphs)) glyph = &glyphs[0];
    for (std::vector<Point<2>>& line : polylines(glyph->strokes)) {
      for (Point<2>& p : line) p = {pen_x + unit * p[0], y - unit * (p[1] - baseline)};
      stroke(image, line, pen * unit, colour);
    }
    pen_x += unit * (glyph->width + gap);
  }
  return pen_x - x;
}

}  // namespace cellwalk::drawing
