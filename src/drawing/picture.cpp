// SPDX-License-Identifier: LGPL-3.0-or-later
// The renderer: bands of rows (picture_band.h), one after the other. Not by VTK, which is optional here:
// pictures of a scene are equal in every build and need no graphics driver.
#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "picture_band.h"
#include "picture_view.h"

namespace cellwalk::drawing {
namespace {

using detail::Band;
using detail::Lights;
using detail::Picture_view;
using detail::Projected;
using detail::Screen_triangle;
using detail::subpixel;
using detail::to_float;
using detail::Vec3;

constexpr int band_pixels = 16;  // rows of pixels drawn at once, fewer where they hold too many fragments:
constexpr double band_fragments = 4e6;  // 24 bytes each
// Samples of a picture, and how often they may be covered: altogether, or each sample in a large picture, but
// not beyond the last bound. It takes 20 to 50 ns each time, so that no picture takes more than a minute.
constexpr double most_samples = 1e9, most_covered = 1e8, most_layers = 8, most_covered_of_all = 1e9;
constexpr double opaque_from = 0.995;
constexpr double caption_size = 0.019;  // capitals' height in picture heights
// Pixels; a corner further off is not drawn. With 8 samples a pixel, it fits into 32 bits with its fraction,
// and areas fit into 64.
constexpr double largest_projection = 5e5;

void check(const Picture_options& options) {
  if (options.width < 16 || options.height < 16 || options.width > 16384 || options.height > 16384)
    throw Error(Error_code::usage, "picture: width and height must be 16 to 16384 pixels");
  if (options.samples < 1 || options.samples > 8)
    throw Error(Error_code::usage, "picture: samples must be 1 to 8");
}

std::uint8_t to_byte(float c) { return static_cast<std::uint8_t>(std::clamp(c, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// Triangles in samples, in drawing order, without those too far off the picture to be snapped.
std::vector<Screen_triangle> project(const Drawing& drawing, const Picture_view& view, int samples) {
  std::vector<Screen_triangle> result;
  result.reserve(drawing.triangles.size());
  for (const Picture_triangle& t : drawing.triangles) {
    Screen_triangle s{};
    s.material = t.material;
    bool drawable = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Projected p = view.project(t.corners[i]);
      drawable &= std::abs(p.x) < largest_projection && std::abs(p.y) < largest_projection;
      if (!drawable) break;
      s.x[i] = static_cast<std::int32_t>(std::lround(p.x * samples * subpixel));
      s.y[i] = static_cast<std::int32_t>(std::lround(p.y * samples * subpixel));
      s.near[i] = static_cast<float>(p.near);
      s.normal[i] = to_float(t.normals[i]);
      s.eye[i] = to_float(view.toward_eye(t.corners[i]));
    }
    if (drawable) result.push_back(s);
  }
  return result;
}

/// A part of the rows of a picture, and the triangles that may meet it.
struct Rows {
  int first, count;  // pixels
  std::vector<std::uint32_t> triangles;
};

/// A drawing from one camera, with a number of samples a pixel and direction.
class Renderer {
 public:
  Renderer(const Drawing& drawing, const Picture_options& options, int samples);

  /// The samples that triangles cover, each counted as often as it is covered, about.
  double covered() const;
  Image render() const;

 private:
  /// The rows of each band, from the top.
  std::vector<Rows> bands() const;
  /// Rows in halves until each of these holds few fragments, or is one row of pixels.
  void add_parts(Rows rows, std::vector<Rows>& parts) const;
  void render(const Rows& rows, Image& image) const;

  bool is_opaque(const Screen_triangle& t) const { return material(t).colour.opacity >= opaque_from; }
  const Material& material(const Screen_triangle& t) const { return drawing_.materials[t.material]; }
  bool meets(const Screen_triangle& t, int first, int count) const;
  /// About the number of samples that a triangle covers in `count` rows of pixels.
  double covered(const Screen_triangle& t, int first, int count) const;

  const Drawing& drawing_;
  const Picture_options& options_;
  int samples_;
  Picture_view view_;
  std::vector<Screen_triangle> triangles_;
  Lights lights_;
};

Renderer::Renderer(const Drawing& drawing, const Picture_options& options, int samples)
    : drawing_(drawing),
      options_(options),
      samples_(samples),
      view_(drawing, options),
      triangles_(project(drawing, view_, samples)) {
  const auto direction = [&](double right, double up, double toward) {
    const Vector<3> v = right * view_.right() + up * view_.up() + toward * view_.toward();
    return to_float((1 / length(v)) * v);
  };
  lights_ = {direction(-0.45, 0.75, 0.75), direction(0.8, -0.1, 0.4)};
}

bool Renderer::meets(const Screen_triangle& t, int first, int count) const {
  const std::int64_t row = std::int64_t{samples_} * subpixel;
  const auto [low, high] = std::minmax({t.y[0], t.y[1], t.y[2]});
  return high >= first * row && low <= (first + count) * row;
}

double Renderer::covered(const Screen_triangle& t, int first, int count) const {
  const double row = samples_ * subpixel;
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [low, high] = std::minmax({t.y[0], t.y[1], t.y[2]});
  // Half of the part of its box that lies in these rows of the picture.
  const double width = std::min<double>(right, options_.width * row) - std::max<double>(left, 0);
  const double height = std::min<double>(high, (first + count) * row) - std::max<double>(low, first * row);
  return width > 0 && height > 0 ? width * height / (2.0 * subpixel * subpixel) : 0;
}

double Renderer::covered() const {
  double sum = 0;
  for (const Screen_triangle& t : triangles_) sum += covered(t, 0, options_.height);
  return sum;
}

std::vector<Rows> Renderer::bands() const {
  std::vector<Rows> bands;
  for (int first = 0; first < options_.height; first += band_pixels)
    bands.push_back({first, std::min(band_pixels, options_.height - first), {}});
  const double band_height = double{band_pixels} * samples_ * subpixel;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto [low, high] = std::minmax({triangles_[i].y[0], triangles_[i].y[1], triangles_[i].y[2]});
    const double first = std::max(0.0, low / band_height - 1);
    for (std::size_t b = first < 1e9 ? static_cast<std::size_t>(first) : bands.size();
         b < bands.size() && bands[b].first * double{subpixel} * samples_ <= high; ++b)
      bands[b].triangles.push_back(static_cast<std::uint32_t>(i));
  }
  return bands;
}

void Renderer::add_parts(Rows rows, std::vector<Rows>& parts) const {
  double sum = 0;
  for (const std::uint32_t i : rows.triangles)
    if (!is_opaque(triangles_[i])) sum += covered(triangles_[i], rows.first, rows.count);
  if (sum <= band_fragments || rows.count == 1) return parts.push_back(std::move(rows));
  for (const int half : {0, 1}) {
    Rows part{
        rows.first + half * (rows.count / 2), half == 0 ? rows.count / 2 : rows.count - rows.count / 2, {}};
    for (const std::uint32_t i : rows.triangles)
      if (meets(triangles_[i], part.first, part.count)) part.triangles.push_back(i);
    add_parts(std::move(part), parts);
  }
}

void Renderer::render(const Rows& rows, Image& image) const {
  Band band(options_.width * samples_, rows.first * samples_, rows.count * samples_);
  for (const bool opaque : {true, false})  // opaque first, so that fragments behind them are not collected
    for (const std::uint32_t i : rows.triangles) {
      const Screen_triangle& t = triangles_[i];
      if (is_opaque(t) == opaque) band.fill(t, material(t), lights_, opaque, view_.is_perspective());
    }
  for (int row = 0; row < rows.count; ++row) {
    const double down = (rows.first + row + 0.5) / options_.height;
    const auto mix = [down](double top, double bottom) {
      return static_cast<float>(top + down * (bottom - top));
    };
    const Vec3 background{mix(options_.top.red, options_.bottom.red),
                          mix(options_.top.green, options_.bottom.green),
                          mix(options_.top.blue, options_.bottom.blue)};
    for (int x = 0; x < options_.width; ++x) {
      Vec3 sum{0, 0, 0};
      for (int j = 0; j < samples_; ++j)
        for (int i = 0; i < samples_; ++i) {
          const Vec3 c = band.resolve(x * samples_ + i, row * samples_ + j, background);
          sum = {sum.x + c.x, sum.y + c.y, sum.z + c.z};
        }
      const float share = 1.0f / static_cast<float>(samples_ * samples_);
      std::uint8_t* out = &image.rgb[3 * (static_cast<std::size_t>(rows.first + row) *
                                              static_cast<std::size_t>(options_.width) +
                                          static_cast<std::size_t>(x))];
      out[0] = to_byte(share * sum.x), out[1] = to_byte(share * sum.y), out[2] = to_byte(share * sum.z);
    }
  }
}

Image Renderer::render() const {
  Image image{options_.width, options_.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height));
  for (Rows& band : bands()) {
    std::vector<Rows> parts;
    add_parts(std::move(band), parts);
    for (const Rows& rows : parts) render(rows, image);
  }
  return image;
}

/// Renders with as many samples as the drawing may take, and at most as requested.
Image render_within_bounds(const Drawing& drawing, const Picture_options& options) {
  const double pixels = double{1} * options.width * options.height;
  const auto samples_of = [pixels](int samples) { return pixels * samples * samples; };
  const double most =
      std::clamp(most_layers * samples_of(options.samples), most_covered, most_covered_of_all);
  int samples = options.samples;
  while (samples_of(samples) > most_samples) --samples;  // one a pixel is always within the bound
  for (;; --samples) {
    const Renderer renderer(drawing, options, samples);
    if (renderer.covered() <= most) return renderer.render();
    if (samples == 1)
      throw Error(Error_code::other, "picture: too many layers lie over each other to draw them");
  }
}

}  // namespace

Image render(const Drawing& drawing, const Picture_options& options) {
  check(options);
  Image image = render_within_bounds(drawing, options);
  if (!drawing.caption.empty()) {
    double size = caption_size * options.height;
    const double margin = 1.6 * size, room = options.width - 2 * margin;
    Image nowhere;
    const double width = draw_text(nowhere, drawing.caption, 0, 0, size, options.ink);
    if (width > room) size *= room / width;
    draw_text(image, drawing.caption, margin, options.height - 1.3 * size, size, options.ink);
  }
  return image;
}

}  // namespace cellwalk::drawing
