// SPDX-License-Identifier: LGPL-3.0-or-later
// Lines, marks and numbers of cells within the visible part of the plane.
#include "picture_plot.h"

#include <cellwalk/internal/drawing/drawing.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "picture_motion.h"

namespace cellwalk::cli {
namespace {

using namespace query_colours;
using drawing::Colour;

constexpr int panel_width = 800;                                        // pixels
constexpr double least_shape = 0.3, largest_shape = 1.1;                // height of a panel by its width
constexpr double width_share = 0.0024;                                  // a line of width 1, of the extent
constexpr double margin_share = 0.2;                                    // around the motion, of the extent
constexpr double grid_lines = 0.6, wall_lines = 2.4, spot_lines = 2.6;  // in lines
constexpr double dash = 6, arrow_lines = 26;                            // in lines
constexpr int round_sides = 180;                                        // of what has a radius
constexpr std::size_t most_numbers = 60;  // of cells: more would only clutter the picture

Point<2> middle_of(const Cell_view<2>& view) {
  Vector<2> sum{};
  for (std::size_t i = 0; i < view.facet_count(); ++i) sum = sum + view.point(view.loop(i)[0]);
  return (1.0 / static_cast<double>(view.facet_count())) * sum;
}

/// The position of the number of a cell: towards the corner that is furthest from a line, so that lines
/// through the cell stay free.
Point<2> place_of_number(const Cell_view<2>& view, const Point<2>& from, const Point<2>& to) {
  constexpr double share = 0.4;
  const Point<2> middle = middle_of(view);
  const auto distance = [&](const Point<2>& x) {
    return std::abs((to[0] - from[0]) * (x[1] - from[1]) - (to[1] - from[1]) * (x[0] - from[0]));
  };
  Point<2> corner = middle;
  for (std::size_t i = 0; i < view.facet_count(); ++i)
    if (const Point<2>& x = view.point(view.loop(i)[0]); distance(x) > distance(corner)) corner = x;
  return middle + share * (corner - middle);
}

void extend(Point<2>& lower, Point<2>& upper, const Point<2>& x) {
  for (std::size_t k = 0; k < 2; ++k) {
    lower[k] = std::min(lower[k], x[k]);
    upper[k] = std::max(upper[k], x[k]);
  }
}

}  // namespace

Query_plot::Query_plot(const Snapshot<2>& snapshot, std::span<const Point<2>> points,
                       std::span<const Tint> tints)
    : snapshot_(snapshot), lower_(points[0]), upper_(points[0]) {
  const auto each_corner = [&](Cell cell, auto&& visit) {
    const Cell_view<2> view = snapshot.view(cell);
    for (std::size_t i = 0; i < view.facet_count(); ++i) visit(view.point(view.loop(i)[0]));
  };
  for (const Point<2>& x : points) extend(lower_, upper_, x);
  std::set<Cell> tinted;
  for (const Tint& tint : tints)
    for (const Cell cell : tint.cells) {
      tinted.insert(cell);
      each_corner(cell, [&](const Point<2>& x) { extend(lower_, upper_, x); });
    }
  const double margin = margin_share * length(upper_ - lower_);
  const Point<2> from = lower_ - Vector<2>{margin, margin}, to = upper_ + Vector<2>{margin, margin};
  std::vector<Cell> shown;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell cell = snapshot.cell(i);
    const Point<2> middle = middle_of(snapshot.view(cell));
    if (tinted.contains(cell) ||
        (middle[0] > from[0] && middle[0] < to[0] && middle[1] > from[1] && middle[1] < to[1]))
      shown.push_back(cell);
  }
  for (const Cell cell : shown) each_corner(cell, [&](const Point<2>& x) { extend(lower_, upper_, x); });
  unit_ = std::max(upper_[0] - lower_[0], upper_[1] - lower_[1]);
  const std::array<Point<3>, 4> ground{{{lower_[0], lower_[1], 0},
                                        {upper_[0], lower_[1], 0},
                                        {upper_[0], upper_[1], 0},
                                        {lower_[0], upper_[1], 0}}};
  drawing::add_patch(panel_.drawing, ground, material(solid));  // visible where there is no cell
  for (const Cell cell : shown) {
    Colour colour = snapshot.is_solid(cell) ? solid : free_cell;
    for (const Tint& tint : tints)
      if (tint.cells.contains(cell)) colour = tint.colour;
    add_cell(cell, colour);
    if (tinted.contains(cell) && tinted.size() <= most_numbers)
      label(place_of_number(snapshot.view(cell), points.front(), points.back()),
            std::to_string(snapshot.index(cell)), -8, -6);
  }
}

void Query_plot::add_cell(Cell cell, const Colour& colour) {
  const Cell_view<2> view = snapshot_.view(cell);
  std::vector<Point<3>> loop;
  for (std::size_t i = 0; i < view.facet_count(); ++i) {
    const Point<2>& x = view.point(view.loop(i)[0]);
    loop.push_back({x[0], x[1], height(Layer::cells)});
  }
  drawing::add_patch(panel_.drawing, loop, material(colour));
  if (snapshot_.is_solid(cell)) return;
  for (std::size_t i = 0; i < view.facet_count(); ++i) {
    const bool is_wall = snapshot_.is_impassable(Snapshot<2>::half_facet(cell, i));
    line(view.point(view.loop(i)[0]), view.point(view.loop(i)[1]), is_wall ? wall_lines : grid_lines,
         is_wall ? Layer::walls : Layer::grid, is_wall ? wall : grid);
  }
}

double Query_plot::height(Layer layer) const { return 0.25e-4 * unit_ * static_cast<double>(layer); }

void Query_plot::line(const Point<2>& from, const Point<2>& to, double width, Layer layer,
                      const Colour& colour) {
  drawing::add_flat_line(panel_.drawing, from, to, width * width_share * unit_, height(layer),
                         material(colour));
}

void Query_plot::dashes(const Point<2>& from, const Point<2>& to, double width, Layer layer,
                        const Colour& colour) {
  const double z = height(layer), share = width_share * unit_;
  drawing::add_dashes(panel_.drawing, {from[0], from[1], z}, {to[0], to[1], z}, width * share / 2,
                      dash * share, true, material(colour));
}

void Query_plot::facet(Half_facet f, double width, const Colour& colour, Layer layer) {
  const auto loop = snapshot_.loop(f);
  line(snapshot_.point(loop[0]), snapshot_.point(loop[1]), width, layer, colour);
}

void Query_plot::triangle(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Colour& colour) {
  const double z = height(Layer::patches);
  const std::array<Point<3>, 3> corners{{{a[0], a[1], z}, {b[0], b[1], z}, {c[0], c[1], z}}};
  drawing::add_patch(panel_.drawing, corners, material(colour));
}

void Query_plot::rounded(const std::vector<Point<2>>& corners, double radius, Layer layer,
                         const Colour& colour) {
  std::vector<Point<3>> loop;
  for (int k = 0; k < round_sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / round_sides;
    const Vector<2> outwards{std::cos(angle), std::sin(angle)};
    const Point<2> x = furthest<2>(corners, outwards) + radius * outwards;
    loop.push_back({x[0], x[1], height(layer)});
  }
  drawing::add_patch(panel_.drawing, loop, material(colour));
}

void Query_plot::spot(const Point<2>& x, double size, const Colour& colour) {
  drawing::add_disc(panel_.drawing, x, size * spot_lines * width_share * unit_, height(Layer::spots),
                    material(colour));
}

void Query_plot::point(const Point<2>& x, const std::string& name, const Colour& colour) {
  spot(x, 1, colour);
  label(x, name, 10, 9);
}

void Query_plot::contact(const Point<2>& x, const Vector<2>& normal) {
  spot(x, 1.3, query_colours::contact);
  drawing::add_flat_arrow(panel_.drawing, x, normal, arrow_lines * width_share * unit_,
                          2 * width_share * unit_, height(Layer::arrows), material(query_colours::contact));
}

void Query_plot::key(drawing::Legend_entry::Swatch swatch, const Colour& colour, const std::string& text) {
  legend_.push_back({swatch, colour, text});
}

void Query_plot::label(const Point<2>& x, const std::string& text, double right, double up) {
  panel_.labels.push_back({{x[0], x[1], 0}, text, right, up});
}

void Query_plot::write(io::Atomic_file& file, const std::string& title) {
  panel_.title = title;
  const double shape = (upper_[1] - lower_[1]) / std::max(upper_[0] - lower_[0], 1e-300);
  drawing::Figure_options options;
  options.camera = {{0, 0, 1}, {0, 1, 0}, 0};
  options.panel_width = panel_width;
  options.panel_height =
      static_cast<int>(std::lround(panel_width * std::clamp(shape, least_shape, largest_shape)));
  options.columns = 1;
  options.legend_columns = 2;
  file.write(drawing::encode_png(drawing::make_figure({&panel_, 1}, legend_, options)));
}

}  // namespace cellwalk::cli
