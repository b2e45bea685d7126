// SPDX-License-Identifier: LGPL-3.0-or-later
// Records a trace of the scene of figure 8, and beside it, in OUT.json, how it was made.
//
//   make_traces OUT.bin [--motion deforming|rigid] [--cells NX NY NZ] [--solid SHARE] [--side CELLS]
//               [--steps N] [--bodies N] [--speed CELLS] [--seed N]
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/io/trace_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "peers/hexahedra_trace.h"
#include "trace_maker.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::figure_8;

/// What of the answers says that a wall is hit.
std::string described(const Body_trace& trace) {
  std::uint64_t vertices = 0, edges = 0, triangles = 0, held = 0;
  constexpr std::size_t of_move = 1 + trace_edges;
  for (std::size_t i = 0; i < trace.answers.size(); i += of_move) {
    const auto answers = std::span(trace.answers).subspan(i, of_move);
    const auto hits = [&](std::uint8_t bit) {
      return static_cast<std::uint64_t>(
          std::ranges::count_if(answers.subspan(1), [bit](std::uint8_t a) { return (a & bit) != 0; }));
    };
    vertices += answers[0];
    edges += hits(body_trace_blocked);
    triangles += hits(body_trace_swept);
    held += answers[0] != 0 || hits(body_trace_blocked) > 0;
  }
  return fmt::format("{} held, hits: {} vertices, {} edges, {} triangles", held, vertices, edges, triangles);
}

void run(const std::filesystem::path& path, const Trace_options& options) {
  const auto [trace, speed] = make_trace(options);
  io::Atomic_file file(path);
  io::write_trace(file, trace);
  file.commit();
  io::write_json(std::filesystem::path(path).replace_extension("json"),
                 {{"body_side", options.body_side}, {"speed", speed}, {"seed", options.seed}});
  fmt::print("{}: {} cells, {} solid, {} moves, {}\n", path.string(), trace.grid->cell_count(),
             trace.grid->solid.size(), trace.moves(), described(trace));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Records a trace of the scene of figure 8");
  std::string file;
  Trace_options options;
  app.add_option("file", file, "trace to write")->required();
  const std::map<std::string, Motion> motions{{"deforming", Motion::deforming}, {"rigid", Motion::rigid}};
  app.add_option("--motion", options.motion, "how the bodies move")
      ->transform(CLI::CheckedTransformer(motions, CLI::ignore_case));
  app.add_option("--cells", options.cells, "cells along each axis");
  app.add_option("--solid", options.solid_share, "share of solid cells");
  app.add_option("--side", options.body_side, "side of a body, in cells");
  app.add_option("--speed", options.speed, "cells a step");
  app.add_option("--bodies", options.bodies, "hexahedra");
  app.add_option("--steps", options.steps, "steps");
  app.add_option("--seed", options.seed, "of the solid cells; of places and courses if rigid");
  CLI11_PARSE(app, argc, argv);
  try {
    run(file, options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_traces: {}\n", error.what());
    return 1;
  }
}
