// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace.h"

#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace cellwalk::cli {

template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name) {
  const auto refuse = [&](const char* key, const char* what) {
    throw Error(Error_code::input, fmt::format("{}: {}: {}", scene_name, key, what));
  };
  if constexpr (D == 2) {
    refuse("dimension", "a trace holds 3D bodies: record a scene of dimension 3");
  } else {
    if (!scene.particles.empty()) refuse("particles", "a trace holds bodies only: leave them out");
    if (scene.bodies.empty() && !scene.catheter)
      refuse("bodies", "there is none to record: add one, or a catheter");
  }
}

Run_trace::Run_trace(io::Atomic_file& file, const std::string& scene_name, const World<3>& world)
    : file_(file) {
  constexpr std::uint32_t most_edges = 64;
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const Body<3>& body = world.bodies()[b].body();
    trace_.bodies.push_back({static_cast<std::uint32_t>(body.vertex_count()),
                             {body.edges().begin(), body.edges().end()},
                             {body.faces().begin(), body.faces().end()}});
    degrees_.push_back(degrees(trace_.bodies.back()));
    const auto& of_body = degrees_.back();
    const auto bad = std::ranges::find_if(of_body, [](std::uint32_t degree) { return degree > most_edges; });
    if (bad != of_body.end())
      throw Error(
          Error_code::input,
          fmt::format("{}: body {}: vertex {} has {} edges, and a trace holds answers to {}: leave it out",
                      scene_name, b, bad - of_body.begin(), *bad, most_edges));
  }
}

void Run_trace::before_step(const World<3>& world) {
  copies_.clear();
  for (const Moving_body<3>& moving : world.bodies()) {
    copies_.push_back(moving.body());
    const auto positions = moving.body().positions();
    trace_.before.insert(trace_.before.end(), positions.begin(), positions.end());
  }
}

void Run_trace::after_step(const World<3>& world) {
  const Body_options options = body_trace_options(Sweep::triangle);
  for (std::size_t b = 0; b < copies_.size(); ++b) {
    const auto targets = world.bodies()[b].targets();
    trace_.targets.insert(trace_.targets.end(), targets.begin(), targets.end());
    report_.clear();
    copies_[b].step(targets, options, report_, counts_);
    append_body_answers(degrees_[b], report_.blocked, options.sweep.sweep, trace_.answers);
  }
  ++trace_.steps;
}

void Run_trace::write(const World<3>& world) {
  before_step(world);  // a trace ends with where the bodies are after the last step
  io::write_body_trace(file_, trace_);
}

template void check_recordable(const Scene<2>&, const std::string&);
template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli
