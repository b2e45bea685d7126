// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "cli/common/environment_file.h"

namespace cellwalk::cli {
namespace {

/// Number k of an option of a recipe; `otherwise` where it is not given.
double option(const Generator_call& generator_call, const char* name, double otherwise, std::size_t k = 0) {
  const auto found = generator_call.options.find(name);
  if (found == generator_call.options.end() || found->second.empty()) return otherwise;
  return found->second[std::min(k, found->second.size() - 1)];
}

std::vector<std::array<std::uint32_t, 2>> edges_of_traces() {
  const std::array<Point<3>, trace_vertices> anywhere{};
  return trace_body_soup(anywhere).edges;
}

/// What the header says of how the bodies were made: that of the first entry.
double side_of(const Body_start<3>& start) {
  const auto* shape = std::get_if<Body_shape<3>>(&start.source);
  const auto* hexahedron = shape ? std::get_if<Hexahedron_shape>(shape) : nullptr;
  return hexahedron ? start.placement.scale * hexahedron->side : 0;
}

/// The trace of a scene before its first step.
Trace start_of(const Environment<3>& environment, const World<3>& world, const Scene<3>& scene) {
  const auto& generator_call = std::get<Generator_call>(scene.environment);
  const Snapshot<3>& snapshot = environment.snapshot();
  Trace trace;
  // As hex_grid() numbers them, the last point of the grid is its highest corner.
  const Point<3>& corner = snapshot.points().back();
  trace.nx = static_cast<std::uint32_t>(corner[0]);
  trace.ny = static_cast<std::uint32_t>(corner[1]);
  trace.nz = static_cast<std::uint32_t>(corner[2]);
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i)
    if (snapshot.is_solid(snapshot.cell(i))) trace.obstacles.push_back(static_cast<std::uint32_t>(i));
  trace.bodies = static_cast<std::uint32_t>(world.bodies().size());
  for (const auto& moving : world.bodies())
    for (const Point<3>& x : moving.body().positions()) trace.start_positions.push_back(x);
  const Body_start<3>& first = scene.bodies.front();
  trace.seed =
      first.cloud ? first.cloud->seed : static_cast<std::uint64_t>(option(generator_call, "seed", 1));
  trace.obstacle_fraction = option(generator_call, "solid", 0);
  trace.body_side = side_of(first);
  trace.speed = scene.time_step * (first.cloud ? first.cloud->speed : length(first.velocity));
  return trace;
}

}  // namespace

template <int D>
void check_recordable(const Scene<D>& scene, const std::vector<Body_soup<D>>& shapes,
                      const std::string& scene_name) {
  const auto refuse = [&](const std::string& key, const std::string& what) {
    throw Error(Error_code::input, fmt::format("{}: {}: {}", scene_name, key, what));
  };
  if constexpr (D == 2) {
    refuse("dimension", "a trace holds 3D bodies: record a scene of dimension 3");
  } else {
    const auto* generator_call = std::get_if<Generator_call>(&scene.environment);
    if (!generator_call || generator_call->generator != "hexes")
      refuse("environment", "a trace is of a grid of unit cubes: use {\"generate\": \"hexes\", ...}");
    if (option(*generator_call, "scale", 1) != 1 || option(*generator_call, "rotated", 0) != 0 ||
        option(*generator_call, "sheared", 0) != 0)
      refuse("environment", "a trace is of a grid of unit cubes: leave scale, rotated and sheared out");
    if (!scene.particles.empty()) refuse("particles", "a trace holds bodies only: leave them out");
    if (scene.catheter) refuse("catheter", "a trace holds bodies only: leave it out");
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (shapes[i].points.size() != trace_vertices || shapes[i].edges != edges_of_traces())
        refuse(fmt::format("bodies[{}]", i),
               "a trace holds bodies of 8 vertices and 12 edges, vertex v joined to v^1, v^2 and v^4: use "
               "the shape "
               "hexahedron, without faces");
  }
}

Body_options recorded_options() {
  Body_options options = trace_options(Sweep::triangle);
  options.reported = Reported::both;
  return options;
}

Run_trace::Run_trace(io::Atomic_file& file, const std::string& scene_name, const Environment<3>& environment,
                     const World<3>& world, const Scene<3>& scene)
    : file_(file), trace_(start_of(environment, world, scene)) {
  naming(scene_name, [&] {
    for (std::size_t b = 0; b < world.bodies().size(); ++b)
      check_trace_start(environment.snapshot(), world.bodies()[b].body(), b);
  });
}

void Run_trace::record(const World<3>& world) {
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const auto targets = world.bodies()[b].targets();
    trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
    append_answers(world.report(b).blocked, Sweep::triangle, trace_.answers);
  }
  ++trace_.steps;
}

template void check_recordable(const Scene<2>&, const std::vector<Body_soup<2>>&, const std::string&);
template void check_recordable(const Scene<3>&, const std::vector<Body_soup<3>>&, const std::string&);

}  // namespace cellwalk::cli
