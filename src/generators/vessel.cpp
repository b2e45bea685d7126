// SPDX-License-Identifier: LGPL-3.0-or-later
// Only + - * / and sqrt are used here: they are rounded in the same way everywhere, unlike other functions of
// the standard library.
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/generators/implicit.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_option.h"

namespace cellwalk {
namespace {

using detail::Box;
using detail::check_option;
using detail::with_all_coordinates;

constexpr int segments_per_tube = 10;

/// The point at t of the quadratic curve through a and c that heads for b.
Point<3> on_curve(const Point<3>& a, const Point<3>& b, const Point<3>& c, double t) {
  return (1 - t) * (1 - t) * a + (2 * t * (1 - t) * b + t * t * c);
}

Tube make_tube(const Point<3>& a, const Point<3>& b, const Point<3>& c, double first_radius,
               double last_radius, int parent) {
  Tube tube;
  tube.parent = parent;
  for (int i = 0; i <= segments_per_tube; ++i) {
    const double t = static_cast<double>(i) / segments_per_tube;
    tube.points.push_back(on_curve(a, b, c, t));
    tube.radii.push_back(first_radius + t * (last_radius - first_radius));
  }
  return tube;
}

/// The depth of p in a tube: positive inside.
double depth_in(const Tube& tube, const Point<3>& p) {
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < tube.points.size(); ++i) {
    const Vector<3> axis = tube.points[i + 1] - tube.points[i], to_p = p - tube.points[i];
    const double t = std::clamp(dot(axis, to_p) / dot(axis, axis), 0.0, 1.0);
    depth =
        std::max(depth, tube.radii[i] + t * (tube.radii[i + 1] - tube.radii[i]) - length(to_p - t * axis));
  }
  return depth;
}

/// The larger of two depths, smoothed if they differ by less than `width`.
double smooth_max(double a, double b, double width) {
  const double h = std::max(0.0, 1 - std::abs(a - b) / width);
  return std::max(a, b) + h * h * width / 4;
}

double squared_distance(const Box<3>& box, const Point<3>& p) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = std::max({0.0, box.low[i] - p[i], p[i] - box.high[i]});
    sum += d * d;
  }
  return sum;
}

Box<3> box_of(const Tube& tube) {
  Box<3> box;
  for (std::size_t i = 0; i < tube.points.size(); ++i) {
    const Vector<3> radius = with_all_coordinates<3>(tube.radii[i]);
    box.extend({tube.points[i] - radius, tube.points[i] + radius});
  }
  return box;
}

/// The union of tubes, blended over a width of `blend` where they meet, and tissue around them.
Cell_soup<3> fill_tubes(const std::vector<Tube>& tubes, double blend, double cell_size, double tissue) {
  std::vector<Box<3>> boxes;
  boxes.reserve(tubes.size());
  for (const Tube& tube : tubes) boxes.push_back(box_of(tube));
  Implicit_shape shape;
  shape.cell_size = cell_size;
  shape.tissue = tissue;
  shape.low = boxes[0].low, shape.high = boxes[0].high;
  for (const Box<3>& box : boxes)
    for (int k = 0; k < 3; ++k) {
      // Blending adds up to blend / 4 at a place where two tubes meet, and a little more for a third one.
      shape.low[k] = std::min(shape.low[k], box.low[k] - blend / 2);
      shape.high[k] = std::max(shape.high[k], box.high[k] + blend / 2);
    }
  // Far from all tubes and their tissue only the sign counts. A tube is skipped if it would change neither
  // sign nor blend.
  const double far = -2 * (blend + cell_size) - tissue;
  shape.depth = [&, far](const Point<3>& p) {
    double depth = far;
    for (std::size_t i = 0; i < tubes.size(); ++i)
      if (squared_distance(boxes[i], p) < far * far) depth = smooth_max(depth, depth_in(tubes[i], p), blend);
    return depth;
  };
  return fill_implicit(shape);
}

/// Lengths are in radii.
void check_tissue(double tissue, double cell_size) {
  check_option(tissue == 0 || (tissue >= 1.25 * cell_size && tissue <= 20),
               "vessel, tube: the tissue must be 0, or lie between 1.25 cell sizes and 20 radii");
}

void check(const Vessel_options& o) {
  check_option(o.generations >= 0 && o.generations <= 6, "vessel: the generations must lie in [0,6]");
  check_option(o.length >= 3 && o.length <= 100, "vessel: the length of the trunk must lie in [3,100] radii");
  check_option(o.curvature >= 0 && o.curvature <= 1, "vessel: the curvature must lie in [0,1]");
  check_option(o.radius > 0 && std::isfinite(o.radius), "vessel: the radius must be positive");
}

}  // namespace

std::vector<Tube> vessel_tubes(const Vessel_options& options) {
  check(options);
  Random random(options.seed);
  struct Bud {
    Point<3> start;
    Vector<3> direction, side;  // of the fork from which it comes
    double length, radius;
    int parent, generation;
  };
  std::vector<Tube> tubes;
  std::vector<Bud> buds{
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, options.length * options.radius, options.radius, -1, 0}};
  for (std::size_t i = 0; i < buds.size(); ++i) {
    const Bud bud = buds[i];
    const Vector<3> across = cross(bud.direction, bud.side);
    const double bend = options.curvature * random.real(-1, 1), sway = options.curvature * random.real(-1, 1);
    const Point<3> middle = bud.start + (bud.length / 2) * bud.direction;
    const Vector<3> end_direction = normalized(bud.direction + (bend * bud.side + sway * across));
    const Point<3> end = middle + (bud.length / 2) * end_direction;
    const int index = static_cast<int>(tubes.size());
    tubes.push_back(make_tube(bud.start, middle, end, bud.radius, 0.9 * bud.radius, bud.parent));
    if (bud.generation == options.generations) continue;
    // Successive forks lie in planes that are about perpendicular, as in lungs and brains. Two branches of
    // radius 0.8 have about the cross-section of Murray's law.
    const Vector<3> new_side = normalized(cross(end_direction, bud.side) + random.real(-0.4, 0.4) * bud.side);
    const Vector<3> side = normalized(new_side - dot(new_side, end_direction) * end_direction);
    for (double sign : {-1.0, 1.0}) {
      const double lean = random.real(0.55, 0.95);  // tangent of the angle between branch and parent
      const Vector<3> direction = normalized(end_direction + sign * lean * side);
      const Vector<3> next_side = normalized(side - dot(side, direction) * direction);
      buds.push_back({end, direction, next_side, bud.length * random.real(0.72, 0.9),
                      bud.radius * random.real(0.78, 0.86), index, bud.generation + 1});
    }
  }
  return tubes;
}

Cell_soup<3> branching_vessel(const Vessel_options& options) {
  const auto tubes = vessel_tubes(options);
  double thinnest = options.radius;
  for (const Tube& tube : tubes) thinnest = std::min(thinnest, tube.radii.back());
  const double cell_size = options.cell_size * options.radius;
  check_option(
      cell_size > 0 && cell_size <= 0.8 * thinnest && cell_size >= options.radius / 100,
      "vessel: the cell size must lie between a hundredth of the trunk's radius and four fifths of the "
      "thinnest branch's; "
      "give a smaller one, or fewer generations");
  check_tissue(options.tissue, options.cell_size);
  return fill_tubes(tubes, thinnest, cell_size, options.tissue * options.radius);
}

Tube bulging_tube_line(const Bulge_options& o) {
  check_option(o.length >= 3 && o.length <= 100, "tube: the length must lie in [3,100] radii");
  check_option(o.bend >= 0 && o.bend <= 1, "tube: the bend must lie in [0,1]");
  check_option(o.radius > 0 && std::isfinite(o.radius), "tube: the radius must be positive");
  const double half = o.length * o.radius / 2;
  // The curve rises to half the height of its control point.
  return make_tube({-half, 0, 0}, {0, 0, 4 * o.bend * half}, {half, 0, 0}, o.radius, o.radius, -1);
}

Cell_soup<3> bulging_tube(const Bulge_options& options) {
  std::vector<Tube> tubes{bulging_tube_line(options)};
  check_option(options.bulge_radius == 0 || (options.bulge_radius >= 0.5 && options.bulge_radius <= 20),
               "tube: the bulge's radius must be 0 or lie in [0.5,20] radii");
  check_option(std::abs(options.bulge_offset) <= 20, "tube: the bulge's offset must lie in [-20,20] radii");
  check_option(options.cell_size >= 0.01 && options.cell_size <= 0.5,
               "tube: the cell size must lie in [0.01,0.5] of the tube's radius");
  check_tissue(options.tissue, options.cell_size);
  if (options.bulge_radius > 0) {
    const Point<3> top = tubes[0].points[segments_per_tube / 2];
    const Point<3> centre = top + Vector<3>{0, 0, options.bulge_offset * options.radius};
    const double r = options.bulge_radius * options.radius;
    // A ball, as a very short tube.
    tubes.push_back({{centre, centre + Vector<3>{0, 0, r / 16}}, {r, r}, 0});
  }
  return fill_tubes(tubes, options.radius, options.cell_size * options.radius,
                    options.tissue * options.radius);
}

}  // namespace cellwalk
