// SPDX-License-Identifier: LGPL-3.0-or-later
// A motion in space among the walls near it.
#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/internal/kernel/box.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "picture.h"
#include "picture_plot.h"

namespace cellwalk::cli {
namespace {

using namespace drawing;
using namespace query_colours;

constexpr int width_of_space = 1000, height_of_space = 720;  // pixels
// Shares of the diagonal of the box shown.
constexpr double axis_width = 0.0025, rim_width = 0.0012, dot_width = 0.008, arrow_share = 0.09;
constexpr double share_around = 0.2;  // of the motion, shown on all sides
constexpr int meridians = 96;         // of what has a radius

/// The part of a convex polygon on one side of a plane across an axis.
std::vector<Point<3>> cut(const std::vector<Point<3>>& loop, std::size_t k, double at, double side) {
  std::vector<Point<3>> part;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point<3>&a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double of_a = side * (a[k] - at), of_b = side * (b[k] - at);
    if (of_a >= 0) part.push_back(a);
    if (of_a * of_b >= 0) continue;
    part.push_back(a + (of_a / (of_a - of_b)) * (b - a));
    part.back()[k] = at;
  }
  return part;
}

std::vector<Point<3>> part_in(std::vector<Point<3>> loop, const detail::Box<3>& box) {
  for (std::size_t k = 0; k < 3; ++k) loop = cut(cut(loop, k, box.low[k], 1), k, box.high[k], -1);
  return loop;
}

/// True if a side of a polygon is due to the box.
bool is_cut_off(const Point<3>& a, const Point<3>& b, const detail::Box<3>& box) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == b[k] && (a[k] == box.low[k] || a[k] == box.high[k])) return true;
  return false;
}

void add_walls(Drawing& drawing, const Snapshot<3>& snapshot, const detail::Box<3>& box, double width) {
  const std::uint32_t wall = drawing.add_material({wall_in_space, 0.1}), edge = drawing.add_material({grid});
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (snapshot.is_solid(cell)) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet h = snapshot.half_facet(cell, f);
      const Cell other = snapshot.neighbour(h);
      if (!snapshot.is_impassable(h) || (other != Cell::none && !snapshot.is_solid(other) && other < cell))
        continue;
      std::vector<Point<3>> loop;
      for (const std::uint32_t v : snapshot.loop(h)) loop.push_back(snapshot.point(v));
      loop = part_in(std::move(loop), box);
      if (loop.size() < 3) continue;
      add_patch(drawing, loop, wall);
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (const Point<3>& a = loop[k], &b = loop[(k + 1) % loop.size()]; !is_cut_off(a, b, box))
          add_tube(drawing, std::array{a, b}, width, edge);
    }
  }
}

/// All that is within a radius of the hull of points, as one surface.
void add_rounded(Drawing& drawing, const std::vector<Point<3>>& corners, double radius,
                 std::uint32_t material) {
  const auto outwards = [](int ring, int side) {
    const double polar = 2 * std::numbers::pi * ring / meridians,
                 angle = 2 * std::numbers::pi * side / meridians;
    return Vector<3>{std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)};
  };
  const auto add = [&](const std::array<Vector<3>, 3>& n) {
    const auto at = [&](const Vector<3>& u) { return furthest<3>(corners, u) + radius * u; };
    drawing.triangles.push_back({{at(n[0]), at(n[1]), at(n[2])}, n, material});
  };
  for (int r = 0; r < meridians / 2; ++r)
    for (int s = 0; s < meridians; ++s) {
      add({outwards(r, s), outwards(r + 1, s), outwards(r + 1, s + 1)});
      add({outwards(r, s), outwards(r + 1, s + 1), outwards(r, s + 1)});
    }
}

/// Across the motion and the normal, or the edge; a little from above.
Camera camera_for(const Pictured_motion<3>& shown, const Answer<3>& answer) {
  constexpr double least = 0.1, tilt = 0.45;
  const auto unit = [](const Vector<3>& v) { return length(v) > 0 ? (1 / length(v)) * v : v; };
  const Vector<3> along = unit(shown.points[1] - shown.points[0]);
  std::vector<Vector<3>> others;
  if (shown.is_edge()) others.push_back(unit(shown.points[2] - shown.points[0]));
  if (answer.contact) others.push_back(answer.contact->normal);
  others.insert(others.end(), {{1, 0, 0}, {0, 1, 0}});
  for (const Vector<3>& other : others)
    if (const Vector<3> n = cross(along, other); length(n) > least) {
      const Vector<3> up =
          answer.contact && length(answer.contact->normal) > 0 ? answer.contact->normal : -1.0 * along;
      return {unit(n) + tilt * up, up};
    }
  return {};
}

}  // namespace

void write_picture(io::Atomic_file& file, const Snapshot<3>& snapshot, std::size_t row,
                   const Pictured_motion<3>& shown, const Answer<3>& answer) {
  detail::Box<3> box;
  for (const Point<3>& x : shown.points) box.extend(x);
  if (answer.contact) box.extend(answer.contact->point);
  box = detail::enlarged(box, shown.radius);
  box = detail::enlarged(box, share_around * length(box.high - box.low));
  const double unit = length(box.high - box.low);
  Panel panel{title_of(row, answer, shown.name(0)), {}, {}};
  Drawing& drawing = panel.drawing;
  add_walls(drawing, snapshot, box, rim_width * unit);
  std::vector<Legend_entry> legend{{Legend_entry::patch, wall_in_space, "walls near the motion"}};
  const bool is_thick = shown.radius > 0;
  const auto name = [&](const Colour& colour, const Colour& line, const char* text) {
    legend.push_back({is_thick ? Legend_entry::patch : Legend_entry::line, is_thick ? colour : line, text});
  };
  const auto add = [&](const std::vector<Point<3>>& corners, const Colour& colour, const Colour& line) {
    if (is_thick) add_rounded(drawing, corners, shown.radius, drawing.add_material({colour, 0.25}));
    if (corners.size() < 3) add_tube(drawing, corners, axis_width * unit, drawing.add_material({line}));
  };
  add(shown.at(shown.points[0]), thick_start, motion);
  name(thick_start, motion, "before the motion");
  add_dashes(drawing, shown.points[0], shown.points[1], axis_width * unit / 2, 4 * axis_width * unit, false,
             drawing.add_material({motion}));
  if (answer.status == Motion_status::free || answer.status == Motion_status::contact) {
    const bool stops = answer.contact.has_value();
    if (is_thick) {
      add(shown.swept(), thick_way, motion);
      name(thick_way, motion, "swept");
    }
    add(shown.at(shown.end), stops ? thick_stop : thick_start, stops ? contact : motion);
    if (stops) name(thick_stop, contact, "where it stops");
  }
  if (answer.contact) {
    const std::uint32_t material = drawing.add_material({contact});
    add_ball(drawing, answer.contact->point, dot_width * unit, material);
    const bool has_normal = length(answer.contact->normal) > 0;
    if (has_normal)
      add_arrow(drawing, answer.contact->point, answer.contact->normal, arrow_share * unit, axis_width * unit,
                material);
    legend.push_back({Legend_entry::disc, contact,
                      has_normal ? "the point of the wall, and the normal" : "the nearest point of walls"});
  }
  for (std::size_t i = 0; i < shown.points.size(); ++i) {
    add_ball(drawing, shown.points[i], dot_width / 2 * unit, drawing.add_material({motion}));
    panel.labels.push_back({shown.points[i], shown.name(i), 10, 9});
  }
  Figure_options options;
  options.camera = camera_for(shown, answer);
  options.panel_width = width_of_space;
  options.panel_height = height_of_space;
  options.columns = 1;
  file.write(encode_png(make_figure({&panel, 1}, legend, options)));
}

}  // namespace cellwalk::cli
