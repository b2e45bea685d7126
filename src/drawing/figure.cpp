// SPDX-License-Identifier: LGPL-3.0-or-later
// The layout of panels, their captions and the swatches of the legend, in pixels.
#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/internal/drawing/figure.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "picture_view.h"

namespace cellwalk::drawing {
namespace {

constexpr Colour white{1, 1, 1}, line_ink{0.10, 0.12, 0.15};
// Pixels.
constexpr int margin = 14, title_height = 40, legend_row_height = 34, swatch_width = 46;
constexpr double title_size = 16, label_size = 15, legend_text_size = 13;
constexpr double halo = 2.2;  // white around a label, so that it can be read on lines
constexpr int halo_directions = 16;
constexpr double circle = 6.283185307179586;

void fill(Image& image, int x0, int y0, int x1, int y1, const Colour& c) {
  for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y)
    for (int x = std::max(0, x0); x < std::min(image.width, x1); ++x) {
      std::uint8_t* out =
          &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                          static_cast<std::size_t>(x))];
      const double part[] = {c.red, c.green, c.blue};
      for (int i = 0; i < 3; ++i)
        out[i] = static_cast<std::uint8_t>(255 * (1 - c.opacity + c.opacity * part[i]) + 0.5);
    }
}

void write_over(Image& image, const std::string& text, double x, double y) {
  for (int i = 0; i < halo_directions; ++i) {
    const double angle = circle * i / halo_directions;
    draw_text(image, text, x + halo * std::cos(angle), y + halo * std::sin(angle), label_size, white);
  }
  draw_text(image, text, x, y, label_size, line_ink);
}

void paste(Image& figure, const Image& panel, int x, int y) {
  for (int row = 0; row < panel.height; ++row) {
    const auto from = panel.rgb.begin() + std::ptrdiff_t{3} * row * panel.width;
    std::copy(from, from + std::ptrdiff_t{3} * panel.width,
              figure.rgb.begin() + 3 * (std::ptrdiff_t{y + row} * figure.width + x));
  }
}

Image draw(const Panel& panel, const Figure_options& options) {
  Picture_options picture;
  picture.width = options.panel_width;
  picture.height = options.panel_height;
  picture.camera = options.camera;
  picture.top = picture.bottom = white;
  Image image = render(panel.drawing, picture);
  const detail::Picture_view view(panel.drawing, picture);
  for (const Label& label : panel.labels) {
    const auto at = view.project(label.at);
    write_over(image, label.text, at.x + label.right, at.y - label.up);
  }
  return image;
}

void draw_swatch(Image& image, const Legend_entry& entry, int x, int middle) {
  constexpr int half_line = 2, half_patch = 9, half_disc = 7, dash = 9;
  const int end = x + swatch_width - 10;
  switch (entry.swatch) {
    case Legend_entry::patch:
      fill(image, x - 1, middle - half_patch - 1, end + 1, middle + half_patch + 1, {0.6, 0.6, 0.6});
      fill(image, x, middle - half_patch, end, middle + half_patch, entry.colour);
      break;
    case Legend_entry::line:
      fill(image, x, middle - half_line, end, middle + half_line, entry.colour);
      break;
    case Legend_entry::dashes:
      for (int i = x; i < end; i += 2 * dash - 4)
        fill(image, i, middle - half_line, std::min(end, i + dash), middle + half_line, entry.colour);
      break;
    case Legend_entry::disc:
      for (int dy = -half_disc; dy <= half_disc; ++dy) {
        const int dx = static_cast<int>(std::sqrt(half_disc * half_disc - dy * dy));
        fill(image, (x + end) / 2 - dx, middle + dy, (x + end) / 2 + dx + 1, middle + dy + 1, entry.colour);
      }
      break;
  }
}

}  // namespace

Image make_figure(std::span<const Panel> panels, std::span<const Legend_entry> legend,
                  const Figure_options& options) {
  const int columns = static_cast<int>(options.columns),
            legend_columns = static_cast<int>(options.legend_columns);
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int legend_rows = (static_cast<int>(legend.size()) + legend_columns - 1) / legend_columns;
  const int row_height = title_height + options.panel_height;
  Image figure{columns * options.panel_width + (columns + 1) * margin,
               rows * row_height + legend_rows * legend_row_height + 2 * margin,
               {}};
  figure.rgb.assign(3 * static_cast<std::size_t>(figure.width) * static_cast<std::size_t>(figure.height),
                    255);
  for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const int x = margin + (i % columns) * (options.panel_width + margin), y = (i / columns) * row_height;
    draw_text(figure, panel.title, x + margin, y + 0.75 * title_height, title_size, line_ink);
    paste(figure, draw(panel, options), x, y + title_height);
  }
  for (int i = 0; i < static_cast<int>(legend.size()); ++i) {
    const Legend_entry& entry = legend[static_cast<std::size_t>(i)];
    const int x = 2 * margin + (i % legend_columns) * (figure.width - 2 * margin) / legend_columns;
    const int y =
        rows * row_height + margin + (i / legend_columns) * legend_row_height + legend_row_height / 2;
    draw_swatch(figure, entry, x, y);
    draw_text(figure, entry.text, x + swatch_width, y + legend_text_size / 2, legend_text_size, line_ink);
  }
  return figure;
}

void add_dashes(Drawing& drawing, const Point<3>& a, const Point<3>& b, double size, double dash, bool flat,
                std::uint32_t material) {
  const int pieces = std::max(1, static_cast<int>(length(b - a) / (2 * dash) + 0.5));
  for (int i = 0; i < pieces; ++i) {
    const Point<3> from = a + ((i + 0.2) / pieces) * (b - a), to = a + ((i + 0.8) / pieces) * (b - a);
    if (flat)
      add_flat_line(drawing, {from[0], from[1]}, {to[0], to[1]}, 2 * size, a[2], material);
    else
      add_tube(drawing, std::vector{from, to}, size, material);
  }
}

void add_patch(Drawing& drawing, std::span<const Point<3>> loop, std::uint32_t material) {
  std::vector<std::uint32_t> facet;
  for (std::uint32_t i = 0; i < loop.size(); ++i) facet.push_back(i);
  add_surface(drawing, loop, std::array{facet}, material, 0);
}

}  // namespace cellwalk::drawing
