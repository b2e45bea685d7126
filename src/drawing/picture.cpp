// SPDX-License-Identifier: LGPL-3.0-or-later
// The renderer: bands of rows, each with a depth buffer for opaque triangles and a list of fragments per
// sample for translucent ones, which are sorted by depth before they are blended. Not by VTK, which is
// optional here: pictures of a scene are equal in every build and need no graphics driver.
#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "picture_view.h"

namespace cellwalk::drawing {
namespace {

using detail::Picture_view;
using detail::Projected;

constexpr int subpixel = 256;    // corners are snapped to this fraction of a sample: exact edge functions
constexpr int band_pixels = 16;  // rows of pixels drawn at once: bounds the memory of the fragment lists
constexpr double opaque_from = 0.995;
constexpr double rim_power = 2.5;           // the rate at which the rim fades from the outline
constexpr double caption_size = 0.019;      // capitals' height in picture heights
constexpr double largest_projection = 1e6;  // samples; a corner further off is not drawn

struct Vec3 {
  float x, y, z;
};
float dot3(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 to_float(const Vector<3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// A triangle in samples, ready to be filled.
struct Screen_triangle {
  std::array<std::int64_t, 3> x, y;  // in 1/subpixel samples
  std::array<float, 3> near;
  std::array<Vec3, 3> normal, eye;
  std::uint32_t material;
};

struct Fragment {
  float near, red, green, blue, opacity;
  std::int32_t next;
};

struct Lights {
  Vec3 key, fill;
};

/// The colour of a point of a surface whose unit normal n faces the eye.
Fragment shade(const Material& material, Vec3 n, Vec3 eye, const Lights& lights, float near) {
  Fragment f{near,
             static_cast<float>(material.colour.red),
             static_cast<float>(material.colour.green),
             static_cast<float>(material.colour.blue),
             static_cast<float>(material.colour.opacity),
             -1};
  if (!material.lit) return f;
  const float norm = std::sqrt(std::max(dot3(n, n) * dot3(eye, eye), 1e-30f));
  const float facing = std::min(1.0f, std::abs(dot3(n, eye)) / norm);
  const float turn = (dot3(n, eye) < 0 ? -1.0f : 1.0f) / std::sqrt(std::max(dot3(n, n), 1e-30f));
  n = {turn * n.x, turn * n.y, turn * n.z};
  const float key = std::max(0.0f, dot3(n, lights.key)), fill = std::max(0.0f, dot3(n, lights.fill));
  const float light = 0.42f + 0.52f * key + 0.16f * fill + 0.08f * facing;
  const float shine = 0.22f * std::pow(key, 24.0f);
  f.red = std::min(1.0f, f.red * light + shine);
  f.green = std::min(1.0f, f.green * light + shine);
  f.blue = std::min(1.0f, f.blue * light + shine);
  const float rim = static_cast<float>(material.rim) * std::pow(1 - facing, static_cast<float>(rim_power));
  f.opacity = std::min(1.0f, f.opacity + rim);
  return f;
}

/// The samples of a band of rows.
class Band {
 public:
  Band(int width, int first_row, int rows)
      : width_(width),
        first_row_(first_row),
        rows_(rows),
        near_(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows),
              -std::numeric_limits<float>::infinity()),
        colour_(near_.size()),
        head_(near_.size(), -1) {}

  void fill(const Screen_triangle& t, const Material& material, const Lights& lights, bool opaque,
            bool perspective);
  /// The finished colour of a sample over a background.
  Vec3 resolve(int x, int row, Vec3 background);

 private:
  int width_, first_row_, rows_;
  std::vector<float> near_;
  std::vector<Vec3> colour_;
  std::vector<std::int32_t> head_;
  std::vector<Fragment> fragments_;
  std::vector<Fragment> stack_;
};

void Band::fill(const Screen_triangle& t, const Material& material, const Lights& lights, bool opaque,
                bool perspective) {
  std::array<std::size_t, 3> v{0, 1, 2};
  const auto area_of = [&] {
    return (t.x[v[1]] - t.x[v[0]]) * (t.y[v[2]] - t.y[v[0]]) -
           (t.x[v[2]] - t.x[v[0]]) * (t.y[v[1]] - t.y[v[0]]);
  };
  std::int64_t area = area_of();
  if (area == 0) return;
  if (area < 0) {
    std::swap(v[1], v[2]);
    area = -area;
  }
  const auto floor_sample = [](std::int64_t a) {
    return static_cast<int>(a >= 0 ? a / subpixel : -((-a - 1) / subpixel) - 1);
  };
  const auto [low_x, high_x] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [low_y, high_y] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const int x0 = std::max(0, floor_sample(low_x)), x1 = std::min(width_ - 1, floor_sample(high_x));
  const int y0 = std::max(first_row_, floor_sample(low_y)),
            y1 = std::min(first_row_ + rows_ - 1, floor_sample(high_y));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const std::int64_t px = std::int64_t{x} * subpixel + subpixel / 2,
                         py = std::int64_t{y} * subpixel + subpixel / 2;
      std::array<float, 3> weight;
      bool inside = true;
      for (std::size_t i = 0; i < 3 && inside; ++i) {
        const std::size_t a = v[(i + 1) % 3], b = v[(i + 2) % 3];
        const std::int64_t dx = t.x[b] - t.x[a], dy = t.y[b] - t.y[a];
        const std::int64_t e = dx * (py - t.y[a]) - dy * (px - t.x[a]);
        // A sample on a common edge belongs to exactly one of its two triangles.
        inside = e > 0 || (e == 0 && (dy > 0 || (dy == 0 && dx < 0)));
        weight[i] = static_cast<float>(static_cast<double>(e) / static_cast<double>(area));
      }
      if (!inside) continue;
      const float near = weight[0] * t.near[v[0]] + weight[1] * t.near[v[1]] + weight[2] * t.near[v[2]];
      const std::size_t sample = static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(x);
      if (!(near > near_[sample])) continue;
      if (perspective)
        for (std::size_t i = 0; i < 3; ++i) weight[i] *= t.near[v[i]] / near;
      const auto blend = [&](const std::array<Vec3, 3>& a) {
        const Vec3 &p = a[v[0]], &q = a[v[1]], &r = a[v[2]];
        return Vec3{weight[0] * p.x + weight[1] * q.x + weight[2] * r.x,
                    weight[0] * p.y + weight[1] * q.y + weight[2] * r.y,
                    weight[0] * p.z + weight[1] * q.z + weight[2] * r.z};
      };
      Fragment f = shade(material, blend(t.normal), blend(t.eye), lights, near);
      if (opaque) {
        near_[sample] = near;
        colour_[sample] = {f.red, f.green, f.blue};
      } else {
        f.next = head_[sample];
        head_[sample] = static_cast<std::int32_t>(fragments_.size());
        fragments_.push_back(f);
      }
    }
}

Vec3 Band::resolve(int x, int row, Vec3 background) {
  const std::size_t sample =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  Vec3 c = near_[sample] > -std::numeric_limits<float>::infinity() ? colour_[sample] : background;
  stack_.clear();
  for (std::int32_t i = head_[sample]; i >= 0; i = fragments_[static_cast<std::size_t>(i)].next)
    stack_.push_back(fragments_[static_cast<std::size_t>(i)]);
  std::stable_sort(stack_.begin(), stack_.end(),
                   [](const Fragment& a, const Fragment& b) { return a.near < b.near; });
  for (const Fragment& f : stack_)
    c = {c.x + f.opacity * (f.red - c.x), c.y + f.opacity * (f.green - c.y),
         c.z + f.opacity * (f.blue - c.z)};
  return c;
}

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
      s.x[i] = std::llround(p.x * samples * subpixel);
      s.y[i] = std::llround(p.y * samples * subpixel);
      s.near[i] = static_cast<float>(p.near);
      s.normal[i] = to_float(t.normals[i]);
      s.eye[i] = to_float(view.toward_eye(t.corners[i]));
    }
    if (drawable) result.push_back(s);
  }
  return result;
}

}  // namespace

Image render(const Drawing& drawing, const Picture_options& options) {
  check(options);
  const Picture_view view(drawing, options);
  const int samples = options.samples;
  const std::vector<Screen_triangle> triangles = project(drawing, view, samples);
  const auto direction = [&](double right, double up, double toward) {
    const Vector<3> v = right * view.right() + up * view.up() + toward * view.toward();
    return to_float((1 / length(v)) * v);
  };
  const Lights lights{direction(-0.45, 0.75, 0.75), direction(0.8, -0.1, 0.4)};
  const auto is_opaque = [&](const Screen_triangle& t) {
    return drawing.materials[t.material].colour.opacity >= opaque_from;
  };

  const int bands = (options.height + band_pixels - 1) / band_pixels;
  const std::int64_t band_height = std::int64_t{band_pixels} * samples * subpixel;
  std::vector<std::vector<std::uint32_t>> in_band(static_cast<std::size_t>(bands));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [low, high] = std::minmax({triangles[i].y[0], triangles[i].y[1], triangles[i].y[2]});
    if (high < 0) continue;
    for (std::int64_t b = std::max<std::int64_t>(0, low / band_height - 1);
         b < bands && b * band_height <= high; ++b)
      in_band[static_cast<std::size_t>(b)].push_back(static_cast<std::uint32_t>(i));
  }

  Image image{options.width, options.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
  for (int b = 0; b < bands; ++b) {
    const int first = b * band_pixels, rows = std::min(band_pixels, options.height - first);
    Band band(options.width * samples, first * samples, rows * samples);
    for (const bool opaque : {true, false})  // opaque first, so that fragments behind them are not collected
      for (const std::uint32_t i : in_band[static_cast<std::size_t>(b)])
        if (is_opaque(triangles[i]) == opaque)
          band.fill(triangles[i], drawing.materials[triangles[i].material], lights, opaque,
                    view.is_perspective());
    for (int row = 0; row < rows; ++row) {
      const double down = (first + row + 0.5) / options.height;
      const auto mix = [down](double top, double bottom) {
        return static_cast<float>(top + down * (bottom - top));
      };
      const Vec3 background{mix(options.top.red, options.bottom.red),
                            mix(options.top.green, options.bottom.green),
                            mix(options.top.blue, options.bottom.blue)};
      for (int x = 0; x < options.width; ++x) {
        Vec3 sum{0, 0, 0};
        for (int j = 0; j < samples; ++j)
          for (int i = 0; i < samples; ++i) {
            const Vec3 c = band.resolve(x * samples + i, row * samples + j, background);
            sum = {sum.x + c.x, sum.y + c.y, sum.z + c.z};
          }
        const float share = 1.0f / static_cast<float>(samples * samples);
        std::uint8_t* out =
            &image.rgb[3 * (static_cast<std::size_t>(first + row) * static_cast<std::size_t>(options.width) +
                            static_cast<std::size_t>(x))];
        out[0] = to_byte(share * sum.x), out[1] = to_byte(share * sum.y), out[2] = to_byte(share * sum.z);
      }
    }
  }
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
