// SPDX-License-Identifier: LGPL-3.0-or-later
// Still pictures without a display: a drawing of triangles, a software renderer, PNG files.
// <cellwalk/internal/drawing/drawing.h> adds balls, tubes, arrows and surfaces to a drawing.
#ifndef CELLWALK_INTERNAL_DRAWING_PICTURE_H
#define CELLWALK_INTERNAL_DRAWING_PICTURE_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::drawing {

/// Red, green, blue and opacity, each in [0,1].
struct Colour {
  double red = 0, green = 0, blue = 0, opacity = 1;
};

/// The appearance of a surface.
struct Material {
  Colour colour;
  /// Opacity added where the surface is seen edge-on, so that the outline of a translucent body stays
  /// visible.
  double rim = 0;
  bool lit = true;  ///< false: flat colour, for planar drawings
};

/// A triangle seen from both sides, with a unit normal at each corner.
struct Picture_triangle {
  std::array<Point<3>, 3> corners;
  std::array<Vector<3>, 3> normals;
  std::uint32_t material = 0;
};

constexpr int finest_sides = 20;

/// The content of a picture, in the units of the environment.
struct Drawing {
  std::vector<Material> materials;
  std::vector<Picture_triangle> triangles;
  std::string caption;       ///< a line at the lower left, smaller if it is long; printable ASCII
  int sides = finest_sides;  ///< of the round shapes that are added next, see Round_shapes

  std::uint32_t add_material(const Material& material) {
    materials.push_back(material);
    return static_cast<std::uint32_t>(materials.size() - 1);
  }
};

/// The view of a drawing. The distance is chosen so that the drawing fills the picture.
struct Camera {
  Vector<3> toward{};         ///< from the drawing to the eye; zero: chosen from the drawing's box
  Vector<3> up{};             ///< zero: chosen so that the longest side of the box is horizontal
  double field_of_view = 24;  ///< degrees, the larger of width and height; 0: parallel projection
};

struct Picture_options {
  int width = 1600;  ///< pixels, 16 to 16384
  int height = 1000;
  int samples = 3;  ///< per pixel and direction, 1 to 8
  Camera camera;
  Colour top{1.0, 1.0, 1.0}, bottom{0.86, 0.89, 0.93};  ///< background
  Colour ink{0.13, 0.16, 0.20};                         ///< caption
};

/// Rows from the top, three bytes a pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  std::array<std::uint8_t, 3> pixel(int x, int y) const {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

/// Draws with a depth buffer; translucent triangles are sorted per sample, so their order does not matter.
/// \pre every coordinate is finite, every material index valid
/// \throw Error(usage) for a size or a number of samples out of range
/// \throw Error(other) if so many layers lie over each other that even one sample a pixel would take minutes
/// Degenerate cases: an empty drawing gives the background.
/// Cost: about 1 s for 1600 x 1000 and 100,000 triangles; about 110 bytes a triangle, and at most 100 MB for
/// translucent layers. Where many layers lie over each other, fewer samples are taken.
Image render(const Drawing& drawing, const Picture_options& options = {});

/// Draws text with the left end of its baseline at (x,y), and capitals `size` pixels high; returns its width
/// in pixels.
double draw_text(Image& image, const std::string& text, double x, double y, double size,
                 const Colour& colour);

/// The bytes of a PNG file (8 bits, RGB, without a date).
std::string encode_png(const Image& image);

}  // namespace cellwalk::drawing

#endif  // CELLWALK_INTERNAL_DRAWING_PICTURE_H
