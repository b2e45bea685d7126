// SPDX-License-Identifier: LGPL-3.0-or-later
// Figures: panels with titles, labels and a legend.
#ifndef CELLWALK_INTERNAL_DRAWING_FIGURE_H
#define CELLWALK_INTERNAL_DRAWING_FIGURE_H

#include <cellwalk/internal/drawing/picture.h>

#include <span>
#include <string>
#include <vector>

namespace cellwalk::drawing {

/// A label at a point of a drawing; the offset of its left end from the point is in pixels.
struct Label {
  Point<3> at;
  std::string text;
  double right = 12, up = -8;
};

struct Panel {
  std::string title;
  Drawing drawing;
  std::vector<Label> labels;
};

/// One entry of the legend.
struct Legend_entry {
  enum Swatch { patch, line, dashes, disc };
  Swatch swatch;
  Colour colour;
  std::string text;
};

struct Figure_options {
  Camera camera;
  int panel_width = 780, panel_height = 450;  ///< pixels
  std::size_t columns = 2, legend_columns = 3;
};

/// Arranges panels and legend in rows, on white.
/// \pre as render(); text is printable ASCII
Image make_figure(std::span<const Panel> panels, std::span<const Legend_entry> legend,
                  const Figure_options& options);

/// A dashed straight line, flat (for planar drawings) or round.
void add_dashes(Drawing& drawing, const Point<3>& a, const Point<3>& b, double size, double dash, bool flat,
                std::uint32_t material);

/// A flat polygon of one colour.
void add_patch(Drawing& drawing, std::span<const Point<3>> loop, std::uint32_t material);

}  // namespace cellwalk::drawing

#endif  // CELLWALK_INTERNAL_DRAWING_FIGURE_H
