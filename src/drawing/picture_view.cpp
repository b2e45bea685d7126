// SPDX-License-Identifier: LGPL-3.0-or-later
// The distance of the eye at which a drawing fills its picture, and the projection.
#include "picture_view.h"

#include <cellwalk/internal/kernel/box.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace cellwalk::drawing::detail {
namespace {

constexpr double margin = 0.06;         // left free on all sides, of the smaller side of the picture
constexpr double caption_strip = 0.05;  // left free at the bottom for the caption, of the height
constexpr double tilt = 0.35;           // of an automatic view, to show the depth

using Box = cellwalk::detail::Box<3>;

Box box_of(const Drawing& drawing) {
  Box box;
  for (const Picture_triangle& t : drawing.triangles)
    for (const Point<3>& p : t.corners) box.extend(p);
  return box;
}

Vector<3> unit_axis(std::size_t i) {
  Vector<3> e{};
  e[i] = 1;
  return e;
}

}  // namespace

Picture_view::Picture_view(const Drawing& drawing, const Picture_options& options)
    : half_width_(options.width / 2.0), half_height_(options.height / 2.0) {
  const double free_height = (1 - caption_strip) * options.height;
  half_height_ = free_height / 2;
  if (drawing.triangles.empty()) return;
  const Box box = box_of(drawing);
  const Vector<3> size = box.high - box.low;
  std::array<std::size_t, 3> order{0, 1, 2};  // of axes by the extent of the drawing, largest first
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  const bool flat = size[order[2]] <= 1e-3 * size[order[0]];

  const Camera& camera = options.camera;
  if (length(camera.toward) > 0) {
    toward_ = normalized(camera.toward);
  } else {
    toward_ = unit_axis(order[2]);
    if (!flat)
      toward_ = normalized(toward_ + tilt * unit_axis(order[1]) - (0.4 * tilt) * unit_axis(order[0]));
  }
  Vector<3> up = length(camera.up) > 0 ? camera.up : unit_axis(order[1]);
  if (length(cross(up, toward_)) < 1e-6 * length(up)) up = unit_axis(order[0]);
  if (length(cross(up, toward_)) < 1e-6 * length(up)) up = unit_axis(order[2]);
  right_ = normalized(cross(up, toward_));
  up_ = cross(toward_, right_);

  // The box seen in the frame of the view gives the centre, all corners give the distance.
  constexpr double big = std::numeric_limits<double>::infinity();
  Vector<3> low{big, big, big}, high{-big, -big, -big};
  const auto in_frame = [&](const Point<3>& p) {
    return Vector<3>{dot(p, right_), dot(p, up_), dot(p, toward_)};
  };
  for (const Picture_triangle& t : drawing.triangles)
    for (const Point<3>& p : t.corners) {
      const Vector<3> q = in_frame(p);
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], q[i]), high[i] = std::max(high[i], q[i]);
    }
  const Vector<3> middle = 0.5 * (low + high);
  centre_ = middle[0] * right_ + middle[1] * up_ + middle[2] * toward_;
  const double border = margin * std::min<double>(options.width, free_height);
  const double room_x = half_width_ - border, room_y = half_height_ - border;
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-300});

  if (!(camera.field_of_view > 0)) {
    scale_ = std::min(2 * room_x / std::max(high[0] - low[0], 1e-6 * extent),
                      2 * room_y / std::max(high[1] - low[1], 1e-6 * extent));
    return;
  }
  // Pixels per unit of tangent: the larger side of the picture spans the field of view.
  const double focal = std::max(options.width, options.height) / 2.0 /
                       std::tan(camera.field_of_view / 2 * std::numbers::pi / 180);
  double distance = 1e-3 * extent;
  for (const Picture_triangle& t : drawing.triangles)
    for (const Point<3>& p : t.corners) {
      const Vector<3> q = in_frame(p) - middle;
      distance = std::max({distance, q[2] + std::abs(q[0]) * focal / room_x,
                           q[2] + std::abs(q[1]) * focal / room_y, q[2] + 1e-3 * extent});
    }
  distance_ = distance;
  scale_ = focal / distance;
}

Projected Picture_view::project(const Point<3>& p) const {
  const Vector<3> d = p - centre_;
  const double depth = dot(d, toward_);
  if (!is_perspective())
    return {half_width_ + scale_ * dot(d, right_), half_height_ - scale_ * dot(d, up_), depth};
  const double nearness = 1 / (distance_ - depth), factor = scale_ * distance_ * nearness;
  return {half_width_ + factor * dot(d, right_), half_height_ - factor * dot(d, up_), nearness};
}

Vector<3> Picture_view::toward_eye(const Point<3>& p) const {
  return is_perspective() ? normalized(centre_ + distance_ * toward_ - p) : toward_;
}

}  // namespace cellwalk::drawing::detail
