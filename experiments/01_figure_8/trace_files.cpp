// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace_files.h"

#include <cellwalk/internal/io/trace_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace cellwalk::figure_8 {
namespace {

bool is_of_hexahedra(const Body_trace& trace) {
  const Traced_body expected = hexahedron();
  return trace.grid && trace.touch_blocks && trace.answers.size() == trace.steps * trace.answers_of_step() &&
         std::ranges::all_of(trace.bodies, [&](const Traced_body& body) {
           return body.vertices == expected.vertices && body.edges == expected.edges;
         });
}

/// \param answers of the vertex, then of its edges
std::uint8_t as_one(std::size_t vertex, const std::uint8_t* answers) {
  unsigned edges = 0, triangles = 0;
  for (std::size_t i = 0; i < trace_edges; ++i) {
    edges |= ((answers[1 + i] & body_trace_blocked) != 0 ? 1u : 0u) << i;
    triangles |= ((answers[1 + i] & body_trace_swept) != 0 ? 1u : 0u) << i;
  }
  return trace_answer(vertex, answers[0] != 0, edges, triangles);
}

}  // namespace

Trace read_hexahedra(const std::filesystem::path& file) {
  Body_trace from = io::read_trace(file);
  if (!is_of_hexahedra(from))
    throw std::runtime_error(file.string() + ": is no trace of hexahedra in a grid with answers to touches");
  Trace trace;
  trace.nx = from.grid->cells[0], trace.ny = from.grid->cells[1], trace.nz = from.grid->cells[2];
  trace.obstacles = std::move(from.grid->solid);
  trace.bodies = static_cast<std::uint32_t>(from.bodies.size());
  trace.steps = from.steps;
  const auto origin =
      nlohmann::json::parse(std::ifstream(std::filesystem::path(file).replace_extension("json")));
  trace.seed = origin.at("seed");
  trace.body_side = origin.at("body_side");
  trace.speed = origin.at("speed");
  const auto starts = from.before_step(0);
  trace.start_positions.assign(starts.begin(), starts.end());
  trace.targets = std::move(from.targets);
  for (std::size_t i = 0; i < trace.moves(); ++i)
    trace.answers.push_back(as_one(i % trace_vertices, from.answers.data() + i * (1 + trace_edges)));
  return trace;
}

}  // namespace cellwalk::figure_8
