// SPDX-License-Identifier: LGPL-3.0-or-later
// The motion of the paper's figure 8: the scene of `cellwalk run` without a scene, by the rule of traces.
#include <cellwalk/internal/generators/body_of_shape.h>
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/internal/simulation/target_recorder.h>
#include <cellwalk/internal/simulation/world.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "motions.h"

namespace cellwalk::figure_8 {
namespace {

/// The scene with bodies as the options have them.
Scene<3> scene_of(const Trace_options& options) {
  auto scene = std::get<Scene<3>>(io::read_scene(CELLWALK_PAPER_SCENE));
  Body_start<3>& cubes = scene.bodies.at(0);
  std::get<Hexahedron_shape>(std::get<Body_shape<3>>(cubes.source)).side = options.body_side;
  Particle_cloud& cloud = cubes.cloud.value();
  cloud.count = options.bodies;
  if (options.speed) cloud.speed = *options.speed / scene.time_step;
  return scene;
}

/// The rule of traces, and contacts, which tell the bodies how to bounce.
Body_options rule(const Body_trace& trace) {
  Body_options options = body_trace_options(Sweep::triangle, trace);
  options.reports_blocked = false;
  return options;
}

}  // namespace

Made_trace record_deforming(const Snapshot<3>& snapshot, Body_trace start, const Trace_options& options) {
  const Scene<3> scene = scene_of(options);
  const Body_start<3>& cubes = scene.bodies.front();
  World<3> world(snapshot, scene, {generate_body(std::get<Body_shape<3>>(cubes.source))}, rule(start));
  for (const Moving_body<3>& moving : world.bodies()) {
    const auto positions = moving.body().positions();
    start.before.insert(start.before.end(), positions.begin(), positions.end());
  }
  const Locator<3> locator(snapshot);
  Target_recorder recorder(snapshot, locator, std::move(start));
  std::vector<Point<3>> targets;
  for (std::uint32_t step = 0; step < options.steps; ++step) {
    world.step();
    targets.clear();
    for (const Moving_body<3>& moving : world.bodies())
      targets.insert(targets.end(), moving.targets().begin(), moving.targets().end());
    recorder.step(targets);
    // Two bodies moved by one rule, one for contacts and one for answers.
    for (std::size_t b = 0; b < options.bodies; ++b)
      if (!std::ranges::equal(world.positions(b), recorder.bodies()[b].positions()))
        throw std::logic_error("a body of the simulation is not where its trace has it");
  }
  return {recorder.trace(), cubes.cloud->speed * scene.time_step};
}

}  // namespace cellwalk::figure_8
