// SPDX-License-Identifier: LGPL-3.0-or-later
#include "worlds.h"

#include <cellwalk/internal/generators/lattice_world.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::exact_float {
namespace {

/// Binary places of the columns of a lattice map: with the coordinates of the lattice, determinants then have
/// more than the 53 bits of a double, and points, even at the largest offset, have no more.
template <int D>
constexpr int column_places = D == 2 ? 26 : 20;

template <int D>
double rounded(double x) {
  return std::ldexp(std::nearbyint(std::ldexp(x, column_places<D>)), -column_places<D>);
}

/// A rotation by twice the angle of tangent t; 3D: about an axis in general position, by the formula of
/// Rodrigues.
std::array<Vector<2>, 2> rotation_columns(double t, std::array<Vector<2>, 2>) {
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  return {{{c, s}, {-s, c}}};
}
std::array<Vector<3>, 3> rotation_columns(double t, std::array<Vector<3>, 3>) {
  const Vector<3> axis = (1 / std::sqrt(14.0)) * Vector<3>{1, 2, 3};
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  std::array<Vector<3>, 3> columns;
  for (int i = 0; i < 3; ++i) {
    Vector<3> unit{};
    unit[i] = 1;
    columns[i] = c * unit + s * cross(axis, unit) + ((1 - c) * axis[i]) * axis;
  }
  return columns;
}

}  // namespace

template <int D>
Lattice_map<D> lattice_map(const Setting& setting) {
  Lattice_map<D> map;
  map.columns = rotation_columns(setting.turn, map.columns);
  for (int i = 0; i < D; ++i)
    for (double& x : map.columns[i])
      x = std::ldexp(setting.is_rounded ? x : rounded<D>(x), setting.scale - (i == 0 ? setting.aspect : 0));
  if (setting.offset >= 0) map.origin.fill(std::ldexp(1.0, setting.offset + setting.scale));
  return map;
}

template <int D>
World<D> make_world(const Setting& setting, std::uint64_t seed) {
  auto options = mixed_lattice_world<D>(seed);
  const Lattice_map<D> map = lattice_map<D>(setting);
  if (setting.is_rounded) {
    options.box_share = options.prism_share = options.star_share = options.merge_share = 0;
    options.simplex_share = 1;
  } else {
    options.map = map;
  }
  options.cells.fill(4);
  int extent = 4;  // log2 of a bound of coordinates, in cells
  if (setting.is_wide) {
    options.cells.fill(D == 2 ? 20 : 8);
    options.membrane_share = options.solid_share = options.removed_share = 0.005;
    extent = 6;
  }
  const double unit = std::ldexp(1.0, std::max(extent, setting.offset + 1) - 53 + setting.scale);
  World<D> world{lattice_world(options), map, options.cells, unit};
  if (setting.is_rounded)
    for (Point<D>& p : world.soup.points) p = map(p);
  return world;
}

namespace {

/// A point of the lattice: eighths of a cell, or halves, which lie on more facets.
template <int D>
Point<D> lattice_point(const World<D>& world, Random& random) {
  Point<D> p;
  const bool is_coarse = random.below(2) == 0;
  for (int i = 0; i < D; ++i)
    p[i] = is_coarse ? static_cast<double>(random.below(2 * world.cells[i] + 1)) / 2
                     : static_cast<double>(random.below(8 * world.cells[i] + 1)) / 8;
  return p;
}

/// A direction of the lattice: along a diagonal or axis, or anywhere, in eighths.
template <int D>
Vector<D> lattice_direction(Random& random) {
  Vector<D> v;
  const int step = random.below(2) == 0 ? 8 : 1;
  do {
    for (double& x : v) x = (static_cast<double>(random.below(16 / step + 1)) * step - 8) / 8;
  } while (v == Vector<D>{});
  return v;
}

/// Between points of the lattice.
template <int D>
Motion<D> lattice_motion(const World<D>& world, const Setting& setting, Random& random) {
  const Point<D> start = lattice_point(world, random);
  const Vector<D> step = setting.length * lattice_direction<D>(random);
  return {world.map(start), world.map(start + step)};
}

/// From anywhere to a point of the lattice, or past it.
template <int D>
Motion<D> aimed_motion(const World<D>& world, const Setting& setting, Random& random) {
  const Point<D> feature = lattice_point(world, random);
  Point<D> start;
  for (int i = 0; i < D; ++i) start[i] = feature[i] + setting.length * random.real(-0.75, 0.75);
  const Point<D> from = world.map(start), aim = world.map(feature);
  if (random.below(2) == 0) return {from, aim};
  return {from, from + 1.5 * (aim - from)};
}

}  // namespace

template <int D>
Motion<D> make_motion(const World<D>& world, const Setting& setting, Random& random) {
  Motion<D> motion =
      random.below(2) == 0 ? lattice_motion(world, setting, random) : aimed_motion(world, setting, random);
  const bool is_degenerate = setting.on_degeneracy || (setting.ulps < 0 && random.below(2) == 0);
  if (is_degenerate) return motion;
  const int ulps = setting.ulps >= 0 ? setting.ulps : static_cast<int>(random.below(11));
  const double step = std::ldexp(world.unit, ulps);
  motion.to[random.below(D)] += random.below(2) == 0 ? step : -step;
  return motion;
}

template Lattice_map<2> lattice_map<2>(const Setting&);
template Lattice_map<3> lattice_map<3>(const Setting&);
template World<2> make_world<2>(const Setting&, std::uint64_t);
template World<3> make_world<3>(const Setting&, std::uint64_t);
template Motion<2> make_motion(const World<2>&, const Setting&, Random&);
template Motion<3> make_motion(const World<3>&, const Setting&, Random&);

}  // namespace cellwalk::exact_float
