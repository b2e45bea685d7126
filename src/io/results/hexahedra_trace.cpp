// SPDX-License-Identifier: LGPL-3.0-or-later
// The format that traces in a grid once had: hexahedra, one byte of answers a move.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "io/files/binary.h"
#include "trace_parts.h"

namespace cellwalk::io {
namespace {

constexpr std::size_t hexahedra_header_size = 64, index_size = 4, point_size = 24, answer_size = 1;
/// Edges join vertex v to v^1, v^2 and v^4; the answer has a bit for each of them, in this order.
constexpr std::uint32_t hexahedron_vertices = 8, hexahedron_edges = 3;
/// Bits of an answer: the vertex, from bit 1 on the edges at the target, from bit 4 on the triangles.
constexpr unsigned vertex_bit = 1, first_edge_bit = 1, first_triangle_bit = 4;
constexpr unsigned holding_bits = 0x0f, all_bits = 0x7f;

/// The content of a file.
struct Hexahedra {
  Traced_grid grid;
  std::uint32_t bodies = 0, steps = 0, solid = 0;
  std::array<double, 3> origin{};  ///< share of solid cells, side of a body, speed: nothing depends on them
  std::vector<Point<3>> starts, targets;
  std::vector<std::uint8_t> answers;

  std::uint64_t vertices() const { return std::uint64_t{bodies} * hexahedron_vertices; }
  std::uint64_t moves() const { return vertices() * steps; }
};

/// Solid cells are followed by zero bytes up to a multiple of eight.
std::size_t padding(std::uint64_t solid) { return solid % 2 == 0 ? 0 : index_size; }

Hexahedra take_header(Binary_reader& in) {
  Hexahedra trace;
  for (std::uint32_t& n : trace.grid.cells) n = in.take<std::uint32_t>("the header");
  for (std::uint32_t* n : {&trace.bodies, &trace.steps, &trace.solid})
    *n = in.take<std::uint32_t>("the header");
  in.take<std::uint64_t>("the header");  // a seed
  for (double& x : trace.origin) x = in.take<double>("the header");
  return trace;
}

/// Compares the header with the number of bytes. The counts have 32 bits, and steps are compared by division,
/// so that no sum or product here has more than 64.
void check_counts(const std::string& name, const Hexahedra& trace, std::uint64_t bytes) {
  const std::uint64_t before_steps =
      index_size * std::uint64_t{trace.solid} + padding(trace.solid) + trace.vertices() * point_size;
  const std::uint64_t a_step = trace.vertices() * (point_size + answer_size);
  const std::string announced =
      fmt::format("{} obstacles, {} bodies and {} steps", trace.solid, trace.bodies, trace.steps);
  if (before_steps > bytes || (a_step > 0 && trace.steps > (bytes - before_steps) / a_step))
    fail(name, fmt::format("announces {}, more than its {} bytes hold: it is cut short, get it whole",
                           announced, hexahedra_header_size + bytes));
  if (const std::uint64_t rest = bytes - before_steps - trace.steps * a_step; rest > 0)
    fail(name, fmt::format("goes on for {} bytes after the {} that it announces: it is damaged, get it anew",
                           rest, announced));
}

/// What is wrong with a trace whose arrays have their lengths; empty if nothing.
std::string flaw_of(const Hexahedra& trace) {
  if (std::string what = flaw_of_grid(trace.grid); !what.empty()) return what;
  if (trace.bodies == 0 && trace.steps > 0)
    return fmt::format("announces {} steps of no bodies: nothing moves in them", trace.steps);
  for (double x : trace.origin)
    if (!std::isfinite(x)) return "a number of the header is not finite: the trace is damaged";
  for (std::size_t i = 0; i < trace.starts.size(); ++i)
    if (!is_finite(trace.starts[i]))
      return fmt::format("vertex {} of body {} starts at a coordinate that is not finite",
                         i % hexahedron_vertices, i / hexahedron_vertices);
  for (std::size_t i = 0; i < trace.targets.size(); ++i) {
    const std::size_t body = i / hexahedron_vertices % trace.bodies, step = i / trace.vertices();
    if (!is_finite(trace.targets[i]))
      return fmt::format("the target of vertex {} of body {} in step {} has a coordinate that is not finite",
                         i % hexahedron_vertices, body, step);
    if ((trace.answers[i] & ~all_bits) != 0)
      return fmt::format("the answer to vertex {} of body {} in step {} has an unknown bit: it is {}",
                         i % hexahedron_vertices, body, step, trace.answers[i]);
  }
  return {};
}

/// The next `count` values.
/// \pre as many bytes are left
template <class T>
std::vector<T> take_array(Binary_reader& in, std::size_t count) {
  std::vector<T> values(count);
  const std::string_view bytes = in.take_bytes(count * sizeof(T));
  if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

Traced_body hexahedron() {
  Traced_body body;
  body.vertices = hexahedron_vertices;
  for (std::uint32_t v = 0; v < hexahedron_vertices; ++v)
    for (std::uint32_t k = 0; k < hexahedron_edges; ++k)
      if (const std::uint32_t w = v ^ 1u << k; v < w) body.edges.push_back({v, w});
  return body;
}

/// Appends the answers to a move as any body has them: of the vertex, then of its edges, whose other ends
/// ascend. Those are v less a power of two, the largest first, and then v plus one, the smallest first.
void append_answers(std::uint32_t vertex, unsigned answer, std::vector<std::uint8_t>& answers) {
  answers.push_back((answer & vertex_bit) != 0 ? body_trace_blocked : 0);
  const auto append = [&](std::uint32_t k) {
    const unsigned edge = answer >> (first_edge_bit + k) & 1,
                   triangle = answer >> (first_triangle_bit + k) & 1;
    answers.push_back(static_cast<std::uint8_t>(edge * body_trace_blocked + triangle * body_trace_swept));
  };
  for (std::uint32_t k = hexahedron_edges; k-- > 0;)
    if ((vertex >> k & 1) == 1) append(k);
  for (std::uint32_t k = 0; k < hexahedron_edges; ++k)
    if ((vertex >> k & 1) == 0) append(k);
}

/// The same as a trace of any bodies. A vertex is where the answers so far have let it go.
Body_trace as_body_trace(Hexahedra&& from) {
  Body_trace trace;
  trace.touch_blocks = true;
  trace.grid = std::move(from.grid);
  trace.bodies.assign(from.bodies, hexahedron());
  trace.steps = from.steps;
  trace.before = std::move(from.starts);
  trace.before.reserve(from.vertices() + from.moves());
  trace.answers.reserve(from.moves() * (1 + hexahedron_edges));
  for (std::size_t i = 0; i < from.targets.size(); ++i) {
    const bool stays = (from.answers[i] & holding_bits) != 0;
    trace.before.push_back(stays ? Point<3>(trace.before[i]) : from.targets[i]);
    append_answers(i % hexahedron_vertices, from.answers[i], trace.answers);
  }
  trace.targets = std::move(from.targets);
  return trace;
}

}  // namespace

Body_trace parse_hexahedra(const std::string& name, std::string_view bytes) {
  Binary_reader in(name, bytes.substr(hexahedra_magic.size()), false);
  Hexahedra trace = take_header(in);
  check_counts(name, trace, in.left());
  trace.grid.solid = take_array<std::uint32_t>(in, trace.solid);
  for (const char c : in.take_bytes(padding(trace.solid)))
    if (c != 0)
      fail(name, "the bytes after the obstacles, which fill up to eight, are not zero: it is damaged");
  trace.starts = take_array<Point<3>>(in, trace.vertices());
  trace.targets = take_array<Point<3>>(in, trace.moves());
  trace.answers = take_array<std::uint8_t>(in, trace.moves());
  if (const std::string what = flaw_of(trace); !what.empty()) fail(name, what);
  check_grid_size(name, trace.grid, bytes.size());
  return as_body_trace(std::move(trace));
}

}  // namespace cellwalk::io
