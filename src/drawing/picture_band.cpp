// SPDX-License-Identifier: LGPL-3.0-or-later
// The fill rule, the shading and the blending of the samples of a band.
#include "picture_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk::drawing::detail {
namespace {

constexpr double rim_power = 2.5;  // the rate at which the rim fades from the outline

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

}  // namespace

Band::Band(int width, int first_row, int rows)
    : width_(width),
      first_row_(first_row),
      rows_(rows),
      near_(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows),
            -std::numeric_limits<float>::infinity()),
      colour_(near_.size()),
      head_(near_.size(), -1) {}

void Band::fill(const Screen_triangle& t, const Material& material, const Lights& lights, bool opaque,
                bool perspective) {
  std::array<std::size_t, 3> v{0, 1, 2};
  using Corners = std::array<std::int32_t, 3>;
  const auto step = [&](const Corners& a, std::size_t i) { return std::int64_t{a[v[i]]} - a[v[0]]; };
  const auto area_of = [&] { return step(t.x, 1) * step(t.y, 2) - step(t.x, 2) * step(t.y, 1); };
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
        const std::int64_t dx = std::int64_t{t.x[b]} - t.x[a], dy = std::int64_t{t.y[b]} - t.y[a];
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

}  // namespace cellwalk::drawing::detail
