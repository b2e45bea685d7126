// SPDX-License-Identifier: LGPL-3.0-or-later
#include "face_trials.h"

#include <algorithm>

#include "falling_face.h"
#include "spike_room.h"

namespace cellwalk::small_obstacles {
namespace {

/// A face falls by this share of the bound in a step.
constexpr double steps_a_bound = 64;
/// The bound is reached after 64 steps of a level face; a face that leans and falls aslant needs more.
constexpr int most_steps = 256;
/// Room about an obstacle, more than any face needs where it starts and on its way.
constexpr double room_about = 24;
/// Of spikes. Faces are at most 6.7 wide and lean by at most 27 degrees: their corners start 3 below the tip
/// at most.
constexpr double least_height = 6;

}  // namespace

Spike_tally run_spikes(const Spike_setting& setting) {
  // The greatest circle of the base is larger than that of the faces: a spike stops them before they reach
  // the floor.
  const double height = std::max(setting.sharpness, least_height);
  const Spike spike{height, height / setting.sharpness};
  const double cone_sharpness = spike.height / inner_radius(spike);
  const Environment<3> environment = spike_room({room_about, spike.height + room_about}, spike);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  const Point<3> tip{0, 0, spike.height}, foot{0, 0, 0};
  Random random(setting.seed);
  Spike_tally tally;
  tally.bound = face_inradius * cone_sharpness;
  const double step = tally.bound / steps_a_bound;
  for (std::uint64_t i = 0; i < setting.faces; ++i) {
    const Fall face = random_fall(random, setting.aim, tip, step, step);
    const Landing by_edges = fall(snapshot, locator, face, Sweep::triangle, most_steps);
    if (!by_edges.stopped_by)
      ++tally.not_stopped;
    else if (passes_inside(by_edges.end, tip, foot)) {
      const double depth = distance_from_plane(by_edges.end, tip);
      tally.by_edges.push_back({depth, depth / (inradius(by_edges.end) * cone_sharpness)});
    } else
      ++tally.not_pierced;
    const Landing with_face = fall(snapshot, locator, face, Sweep::faces, most_steps);
    tally.stopped_by_face += with_face.stopped_by == Body_feature::face;
    tally.pierced_with_faces += passes_inside(with_face.end, tip, foot);
  }
  return tally;
}

Floating_tally run_floating(const Floating_setting& setting) {
  const double side = setting.size_over_inradius * face_inradius;
  const Room room{room_about, 2 * room_about};
  const Environment<3> environment = floating_room(room, side);
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  // A point inside the face falls through the centre of the cube. Normal and way of a face are at most 54
  // degrees apart, so from twice the side away along its way its plane is 1.17 sides from the centre, and
  // half a diagonal of the cube is 0.87.
  const Point<3> centre{0, 0, room.height / 2};
  const double above = 2 * side, step = side / 16;
  const int steps = 64;  // to as far behind it
  Random random(setting.seed);
  Floating_tally tally;
  for (std::uint64_t i = 0; i < setting.faces; ++i) {
    const Fall face = random_fall(random, Aim::random, centre, above, step);
    const bool stops = fall(snapshot, locator, face, Sweep::triangle, steps).stopped_by.has_value();
    (stops ? tally.stopped : tally.passed) += 1;
    tally.passed_with_faces += !fall(snapshot, locator, face, Sweep::faces, steps).stopped_by;
  }
  return tally;
}

}  // namespace cellwalk::small_obstacles
