// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions of bodies recorded in worlds.
#ifndef CELLWALK_TESTS_SIMULATION_RECORDED_MOTIONS_H
#define CELLWALK_TESTS_SIMULATION_RECORDED_MOTIONS_H

#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/worlds.h"

namespace cellwalk::test {

/// A motion that was recorded, and where.
struct Recorded_motion {
  Snapshot<3> snapshot;
  Body_trace trace;
};

inline Recorded_motion record_motion(Snapshot<3> snapshot, const Scene<3>& scene,
                                     std::vector<Body_soup<3>> shapes) {
  World<3> world(snapshot, scene, std::move(shapes));
  Body_trace_recorder recorder(world);
  for (std::uint32_t i = 0; i < scene.steps; ++i) {
    world.step();
    recorder.record_step();
  }
  Body_trace trace = recorder.trace();
  return {std::move(snapshot), std::move(trace)};
}

inline const std::vector<std::uint32_t> solid_rooms{21, 26, 37, 58, 80, 99};

inline Body_start<3> thrown_copies(std::uint32_t count, double speed,
                                   std::optional<Shape_material> material) {
  Body_start<3> start;
  start.cloud = Particle_cloud{count, speed, 7};
  start.spin = {0.5, 2, 0.3};
  start.material = material;
  return start;
}

/// Rigid bodies with and without faces, soft ones and a catheter.
inline Scene<3> crowd() {
  Scene<3> scene;
  scene.bodies = {thrown_copies(8, 4, {}),
                  thrown_copies(6, 3, Shape_material{Shape_mode::quadratic, 0.4, 0.7}),
                  thrown_copies(3, 3, Shape_material{Shape_mode::linear, 0.3, 0.8})};
  Catheter<3> catheter;
  catheter.path = {{0.2, 0.3, 0.4}, {5.5, 4.5, 3.5}};
  catheter.spacing = 0.3;
  catheter.advance = 0.1;
  catheter.particles = 16;
  scene.catheter = catheter;
  scene.gravity = {0, 0, -3};
  scene.time_step = 0.02;
  scene.steps = 120;
  return scene;
}

inline std::vector<Body_soup<3>> crowd_shapes() {
  return {hexahedron_body(0.5, false), hexahedron_body(0.4, true), icosphere_body(0.3, 1)};
}

inline const Recorded_motion& crowded_rooms() {
  static const Recorded_motion motion =
      record_motion(rooms<3>({6, 5, 4}, solid_rooms), crowd(), crowd_shapes());
  return motion;
}

/// A catheter that is pushed straight into a bent tube, along walls that are oblique to everything.
inline const Recorded_motion& tube_motion() {
  static const Recorded_motion motion = [] {
    Bulge_options options;
    options.cell_size = 0.5;
    const Tube line = bulging_tube_line(options);
    Scene<3> scene;
    Catheter<3> catheter;
    catheter.path = {line.points[2], line.points[4], line.points.back()};
    catheter.steering = Steering::none;
    catheter.stiffness = 0.9;
    catheter.spacing = 0.25;
    catheter.advance = 0.12;
    catheter.particles = 90;
    scene.catheter = catheter;
    scene.steps = 200;
    return record_motion(compile(bulging_tube(options)), scene, {});
  }();
  return motion;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_SIMULATION_RECORDED_MOTIONS_H
