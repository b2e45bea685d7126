// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene.h"

#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/centre_lines.h"
#include "common/seeds.h"
#include "walls.h"

namespace cellwalk::moving_walls {
namespace {

constexpr std::uint32_t catheter_vertices = 110;
constexpr int soft_bodies = 20;
constexpr double soft_radius = 0.15;  ///< in radii of the trunk
/// The catheter is so far from the wall, in distances of the wall from the centre line; its middle is
/// nearest.
constexpr double least_gap = 0.005, most_gap = 0.1;
constexpr double vessel_amplitude = 0.05;  ///< in distances from the centre line
constexpr double patch_amplitude = 0.15;   ///< in sizes of cells

/// The point of a polyline at a share of its segments.
Point<3> along(const Tube& tube, double share) {
  const double at = share * static_cast<double>(tube.points.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), tube.points.size() - 2);
  return tube.points[i] + (at - static_cast<double>(i)) * (tube.points[i + 1] - tube.points[i]);
}

/// How far it is from a point to the wall in a direction, by bisection.
double distance_to_wall(const Locator<3>& locator, const Point<3>& from, const Vector<3>& direction) {
  constexpr int bisections = 40;
  double in = 0, out = 2;
  for (int i = 0; i < bisections; ++i) {
    const double middle = (in + out) / 2;
    (locator.locate(from + middle * direction).status == Location_status::free ? in : out) = middle;
  }
  return in;
}

/// A direction across an axis.
Vector<3> across(const Vector<3>& axis, const Vector<3>& wanted) {
  return normalized(wanted - (dot(wanted, axis) / dot(axis, axis)) * axis);
}

/// Goes from 0 to 1, to -1 and back to 0 during a beat: two parabolas.
double beat(double time) {
  const double x = time - std::floor(time);
  return x < 0.5 ? 16 * x * (0.5 - x) : -16 * (x - 0.5) * (1 - x);
}

}  // namespace

std::string_view name_of(Movers movers) {
  switch (movers) {
    case Movers::one:
      return "one";
    case Movers::hundred:
      return "hundred";
    case Movers::branch:
      return "branch";
    case Movers::all:
      break;
  }
  return "all";
}

Scene::Scene(const Cell_soup<3>& soup, const Vessel_options& options, Movers movers)
    : environment_(Environment<3>::build(soup, {.keep_map = false})) {
  const Locator<3> locator(snapshot());
  const std::vector<Tube> tubes = vessel_tubes(options);
  add_catheter(locator, tubes[0]);
  add_soft_bodies(locator, tubes);
  choose_movers(options, tubes, movers);
}

Residents<3> Scene::residents() {
  Residents<3> result;
  for (const auto& body : bodies_) result.bodies.push_back(body.get());
  return result;
}

void Scene::add_catheter(const Locator<3>& locator, const Tube& trunk) {
  const Vector<3> axis = trunk.points.back() - trunk.points.front();
  const Vector<3> sideways = across(axis, {1, 0.3, 0.2});
  for (double more = 1; more < 16; more *= 1.5) {
    Body_soup<3> soup;
    for (std::uint32_t i = 0; i < catheter_vertices; ++i) {
      const double share = static_cast<double>(i) / (catheter_vertices - 1);
      const Point<3> centre = along(trunk, 0.05 + 0.75 * share);
      const double off_middle = std::abs(2 * share - 1);
      const double gap = more * (least_gap + (most_gap - least_gap) * off_middle * off_middle);
      soup.points.push_back(centre + ((1 - gap) * distance_to_wall(locator, centre, sideways)) * sideways);
      if (i > 0) soup.edges.push_back({i - 1, i});
    }
    try {
      bodies_.push_back(std::make_unique<Body<3>>(snapshot(), locator, soup));
      nearest_ = soup.points[catheter_vertices / 2];
      return;
    } catch (const Error&) {  // an edge passes a wall: all go farther from it
    }
  }
  throw std::runtime_error("the catheter does not fit into the vessel");
}

void Scene::add_soft_bodies(const Locator<3>& locator, const std::vector<Tube>& tubes) {
  Random random(experiments::part_seed(1, "soft bodies"));
  const Body_soup<3> sphere = icosphere_body(soft_radius, 1);
  while (bodies_.size() < 1 + soft_bodies) {
    const Tube& tube = tubes[bodies_.size() % tubes.size()];
    const Vector<3> axis = tube.points.back() - tube.points.front();
    const Vector<3> direction = across(axis, {random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
    const Point<3> centre = along(tube, random.real(0.1, 0.9));
    const double gap = random.real(0, 0.3);
    Body_soup<3> soup = sphere;
    const double off = (1 - gap) * distance_to_wall(locator, centre, direction) - soft_radius;
    for (Point<3>& x : soup.points) x = x + ((centre - Point<3>{}) + off * direction);
    try {
      bodies_.push_back(std::make_unique<Body<3>>(snapshot(), locator, soup));
    } catch (const Error&) {  // a wall is in it: another place
    }
  }
}

void Scene::choose_movers(const Vessel_options& options, const std::vector<Tube>& tubes, Movers movers) {
  const bool is_patch = movers == Movers::one || movers == Movers::hundred;
  const auto points = snapshot().points();
  for (std::uint32_t i = 0; i < points.size() && !is_patch; ++i) {
    const experiments::Centre_place place = experiments::centre_of(tubes, points[i]);
    if (movers == Movers::branch && place.tube + 1 != tubes.size()) continue;
    movers_.push_back({i, points[i], vessel_amplitude * (place.centre - points[i])});
  }
  if (!is_patch) return;
  std::vector<std::pair<double, std::uint32_t>> near;
  for (const std::uint32_t i : Walls(snapshot()).points) near.emplace_back(length(points[i] - nearest_), i);
  std::ranges::sort(near);
  near.resize(std::min<std::size_t>(near.size(), movers == Movers::one ? 1 : 100));
  for (const auto& [distance, i] : near) {
    const Vector<3> inward = normalized(experiments::centre_of(tubes, points[i]).centre - points[i]);
    movers_.push_back({i, points[i], patch_amplitude * options.cell_size * inward});
  }
  std::ranges::sort(movers_, {}, &Mover::point);
}

std::vector<Vertex_move<3>> Scene::targets(double time) const {
  std::vector<Vertex_move<3>> result;
  result.reserve(movers_.size());
  for (const Mover& m : movers_) result.push_back({m.point, m.home + beat(time) * m.amplitude});
  return result;
}

}  // namespace cellwalk::moving_walls
