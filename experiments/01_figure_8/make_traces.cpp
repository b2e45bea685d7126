// SPDX-License-Identifier: LGPL-3.0-or-later
// Records a trace of the scene of figure 8.
//
//   make_traces OUT.bin [--motion deforming|rigid] [--cells NX NY NZ] [--solid SHARE] [--side CELLS]
//               [--steps N] [--bodies N] [--speed CELLS] [--seed N]
#include <cellwalk/internal/io/trace_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <bit>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "trace_maker.h"

namespace {

void run(const std::string& file, const cellwalk::figure_8::Trace_options& options) {
  using namespace cellwalk;
  const Trace trace = figure_8::make_trace(options);
  io::write_trace(file, trace);
  std::uint64_t vertices = 0, edges = 0, triangles = 0, held = 0;
  for (const unsigned a : trace.answers) {
    vertices += a & trace_segment_bit;
    edges += static_cast<unsigned>(std::popcount(a & trace_edge_bits));
    triangles += static_cast<unsigned>(std::popcount(a & trace_triangle_bits));
    held += (a & (trace_segment_bit | trace_edge_bits)) != 0;
  }
  fmt::print("{}: {} cells, {} solid, {} moves, {} held, hits: {} vertices, {} edges, {} triangles\n", file,
             trace.cells(), trace.obstacles.size(), trace.moves(), held, vertices, edges, triangles);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Records a trace of the scene of figure 8");
  std::string file;
  cellwalk::figure_8::Trace_options options;
  app.add_option("file", file, "trace to write")->required();
  const std::map<std::string, cellwalk::figure_8::Motion> motions{
      {"deforming", cellwalk::figure_8::Motion::deforming}, {"rigid", cellwalk::figure_8::Motion::rigid}};
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
