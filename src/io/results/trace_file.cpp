// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files/binary.h"
#include "trace_parts.h"

namespace cellwalk::io {
namespace {

/// What a trace begins with: one of bodies with a radius with the last; others that have a grid, or in which
/// touches block, with the one before.
constexpr std::string_view plain_magic = "ECCDTRC2", grid_magic = "ECCDTRC3", thick_magic = "ECCDTRC4";

/// A replay builds all cells of the grid, however short the file is. Beyond a million cells, which any file
/// may have, the bytes set the limit: traces of large grids have much motion.
constexpr std::uint64_t cells_of_any_file = 1'000'000, cells_a_byte = 64;

/// The next `count` values, if so many bytes are left.
template <class T>
std::vector<T> take_values(Binary_reader& in, std::uint64_t count, const char* what) {
  if (count > in.left() / sizeof(T))
    in.fail(fmt::format("the file ends within {}: it is cut short, get it whole", what));
  std::vector<T> values(static_cast<std::size_t>(count));
  const std::string_view bytes = in.take_bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

Traced_body take_body(Binary_reader& in, bool has_radii) {
  Traced_body body;
  body.vertices = in.take<std::uint32_t>("the vertices of a body");
  const auto edges = in.take<std::uint32_t>("the edges of a body");
  const auto faces = in.take<std::uint32_t>("the faces of a body");
  const auto radii = has_radii ? in.take<std::uint32_t>("the number of radii of a body") : 0;
  body.edges = take_values<std::array<std::uint32_t, 2>>(in, edges, "the edges of a body");
  body.radii = take_values<double>(in, radii, "the radii of a body");
  body.faces = take_values<std::array<std::uint32_t, 3>>(in, faces, "the faces of a body");
  return body;
}

/// What is wrong with the edges of a body; empty if nothing.
std::string flaw_of_edges(const Traced_body& body) {
  for (std::size_t e = 0; e < body.edges.size(); ++e) {
    const auto& [u, v] = body.edges[e];
    if (u >= v || v >= body.vertices)
      return fmt::format(
          "edge {} joins vertices {} and {} of {}: the lower one must come first, and both exist", e, u, v,
          body.vertices);
    if (e > 0 && !(body.edges[e - 1] < body.edges[e]))
      return fmt::format("edge {} is not above the one before: edges must ascend", e);
  }
  return {};
}

/// What is wrong with the faces of a body whose edges are in order; empty if nothing.
std::string flaw_of_faces(const Traced_body& body) {
  std::vector<std::array<std::uint32_t, 3>> sorted = body.faces;
  for (std::size_t f = 0; f < sorted.size(); ++f) {
    std::ranges::sort(sorted[f]);
    const auto& [u, v, w] = sorted[f];
    for (const std::array<std::uint32_t, 2>& side : {std::array{u, v}, {v, w}, {u, w}})
      if (!std::ranges::binary_search(body.edges, side))
        return fmt::format("face {} has a side from vertex {} to vertex {}, which is no edge of the body", f,
                           side[0], side[1]);
  }
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    return fmt::format("two faces have the vertices {}, {} and {}: leave one out", (*twice)[0], (*twice)[1],
                       (*twice)[2]);
  return {};
}

/// What is wrong with the radii of a body; empty if nothing.
std::string flaw_of_radii(const Traced_body& body, bool touch_blocks) {
  if (body.radii.size() > 1 && body.radii.size() != body.edges.size())
    return fmt::format("{} radii of {} edges: there is one for each, one for all, or none", body.radii.size(),
                       body.edges.size());
  for (std::size_t e = 0; e < body.radii.size(); ++e) {
    const double r = body.radii[e];
    if (!(r >= 0 && std::isfinite(r)))
      return fmt::format("radius {} is {}: a finite number of at least 0 is expected", e, r);
    if (touch_blocks && r > 0)
      return fmt::format("radius {} is {}, and touches block: what has a radius touches no wall", e, r);
  }
  return {};
}

/// True if the grid has cells, and all their indices fit into 32 bits.
bool is_indexable(const Traced_grid& grid) {
  constexpr std::uint64_t most = std::uint64_t{1} << 32;
  const auto& [nx, ny, nz] = grid.cells;
  if (nx == 0 || ny == 0 || nz == 0) return false;
  const std::uint64_t layer = std::uint64_t{nx} * ny;
  return layer <= most && layer * nz <= most;
}

/// What is wrong with a body; empty if nothing.
std::string flaw_of(const Traced_body& body, bool touch_blocks) {
  if (body.vertices == 0) return "it has no vertices";
  if (std::string what = flaw_of_edges(body); !what.empty()) return what;
  if (std::string what = flaw_of_radii(body, touch_blocks); !what.empty()) return what;
  return flaw_of_faces(body);
}

/// What is wrong with the values of a trace whose arrays have their lengths; empty if nothing.
std::string flaw_of(const Body_trace& trace) {
  if (trace.grid)
    if (std::string what = flaw_of_grid(*trace.grid); !what.empty()) return what;
  for (std::size_t b = 0; b < trace.bodies.size(); ++b)
    if (const std::string what = flaw_of(trace.bodies[b], trace.touch_blocks); !what.empty())
      return fmt::format("body {}: {}", b, what);
  const std::size_t vertices = trace.vertices();
  if (vertices == 0 && trace.steps > 0)
    return fmt::format("announces {} steps of no bodies: nothing moves in them", trace.steps);
  const auto not_finite = [vertices](const std::vector<Point<3>>& points, const char* what) -> std::string {
    const auto bad = std::find_if_not(points.begin(), points.end(), is_finite<3>);
    if (bad == points.end()) return {};
    const auto i = static_cast<std::size_t>(bad - points.begin());
    return fmt::format("{} of vertex {} in step {} has a coordinate that is not finite", what, i % vertices,
                       i / vertices);
  };
  if (std::string what = not_finite(trace.before, "the position"); !what.empty()) return what;
  if (std::string what = not_finite(trace.targets, "the target"); !what.empty()) return what;
  for (std::size_t i = 0; i < trace.answers.size(); ++i)
    if ((trace.answers[i] & ~body_trace_bits) != 0)
      return fmt::format("answer {} has an unknown bit: it is {}", i, trace.answers[i]);
  return {};
}

/// How touches count, and the grid, if there is one.
void take_environment(Binary_reader& in, Body_trace& trace) {
  const auto touch = in.take<std::uint32_t>("the rule of touches");
  if (touch > 1) in.fail(fmt::format("the rule of touches is {}: 0 or 1 is expected", touch));
  trace.touch_blocks = touch == 1;
  const auto has_grid = in.take<std::uint32_t>("the number that announces a grid");
  if (has_grid > 1)
    in.fail(fmt::format("the number that announces a grid is {}: 0 or 1 is expected", has_grid));
  if (has_grid == 0) return;
  Traced_grid& grid = trace.grid.emplace();
  for (std::uint32_t& n : grid.cells) n = in.take<std::uint32_t>("the grid");
  const auto solid = in.take<std::uint32_t>("the number of obstacles");
  grid.solid = take_values<std::uint32_t>(in, solid, "the obstacles");
}

/// Bodies, steps and answers.
void take_motion(Binary_reader& in, Body_trace& trace, bool has_radii) {
  const auto bodies = in.take<std::uint32_t>("the number of bodies");
  trace.steps = in.take<std::uint32_t>("the number of steps");
  // Compared by division: the counts have 32 bits, and their products more than 64.
  std::uint64_t vertices = 0;
  for (std::uint32_t b = 0; b < bodies; ++b) {
    trace.bodies.push_back(take_body(in, has_radii));
    vertices += trace.bodies.back().vertices;
    if (vertices > in.left() / sizeof(Point<3>))
      in.fail(
          fmt::format("announces {} vertices of bodies, more than the {} bytes left hold: it is cut short, "
                      "get it whole",
                      vertices, in.left()));
  }
  if (vertices > 0 && trace.steps > in.left() / (2 * sizeof(Point<3>) * vertices))
    in.fail(
        fmt::format("announces {} steps of {} vertices, more than the {} bytes left hold: it is cut short, "
                    "get it whole",
                    trace.steps, vertices, in.left()));
  trace.before = take_values<Point<3>>(in, (std::uint64_t{trace.steps} + 1) * vertices, "the positions");
  trace.targets = take_values<Point<3>>(in, trace.steps * vertices, "the targets");
  const auto has_answers = in.take<std::uint8_t>("the byte that announces answers");
  if (has_answers > 1)
    in.fail(fmt::format("the byte that announces answers is {}: 0 or 1 is expected", has_answers));
  if (has_answers == 1) {
    const std::uint64_t a_step = trace.answers_of_step();
    if (a_step > 0 && trace.steps > in.left() / a_step)
      in.fail("the file ends within the answers: it is cut short, get it whole");
    trace.answers = take_values<std::uint8_t>(in, trace.steps * a_step, "the answers");
  }
  if (in.left() > 0)
    in.fail(
        fmt::format("goes on for {} bytes after what it announces: it is damaged, get it anew", in.left()));
}

}  // namespace

std::string flaw_of_grid(const Traced_grid& grid) {
  if (!is_indexable(grid))
    return fmt::format(
        "a grid of {} x {} x {} cells: there must be some, and no more than 32-bit indices name",
        grid.cells[0], grid.cells[1], grid.cells[2]);
  for (std::size_t i = 0; i < grid.solid.size(); ++i) {
    if (grid.solid[i] >= grid.cell_count())
      return fmt::format("obstacle {} is cell {}, of {}: the trace is damaged", i, grid.solid[i],
                         grid.cell_count());
    if (i > 0 && grid.solid[i] <= grid.solid[i - 1])
      return fmt::format("obstacle {} is cell {}, after cell {}: obstacles must ascend", i, grid.solid[i],
                         grid.solid[i - 1]);
  }
  return {};
}

void check_grid_size(const std::string& name, const Traced_grid& grid, std::uint64_t bytes) {
  if (grid.cell_count() > std::max(cells_of_any_file, cells_a_byte * bytes))
    fail(name, fmt::format("announces a grid of {} cells in {} bytes, too large for so little motion: it may "
                           "be damaged; get it anew, or record in a smaller grid",
                           grid.cell_count(), bytes));
}

Body_trace parse_trace(const std::string& name, std::string_view bytes) {
  if (bytes.starts_with(hexahedra_magic)) return parse_hexahedra(name, bytes);
  const bool has_radii = bytes.starts_with(thick_magic);
  const bool has_environment = has_radii || bytes.starts_with(grid_magic);
  if (!has_environment && !bytes.starts_with(plain_magic))
    fail(name,
         fmt::format("is no trace: it begins with none of {}, {}, {} and {}; name a file of recorded motion",
                     hexahedra_magic, plain_magic, grid_magic, thick_magic));
  Binary_reader in(name, bytes.substr(plain_magic.size()), false);
  Body_trace trace;
  if (has_environment) take_environment(in, trace);
  take_motion(in, trace, has_radii);
  if (const std::string what = flaw_of(trace); !what.empty()) fail(name, what);
  if (trace.grid) check_grid_size(name, *trace.grid, bytes.size());
  return trace;
}

Body_trace read_trace(const std::filesystem::path& path) { return parse_trace(path.string(), load(path)); }

void write_trace(Atomic_file& file, const Body_trace& trace) {
  const auto refuse = [&](const std::string& what) {
    throw Error(Error_code::usage, fmt::format("{}: is not written: {}", file.destination().string(), what));
  };
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  const bool fits =
      trace.bodies.size() <= most && std::ranges::all_of(trace.bodies, [](const Traced_body& body) {
        return body.edges.size() <= most && body.faces.size() <= most;
      });
  if (!fits || (trace.grid && trace.grid->solid.size() > most) ||
      trace.before.size() != (trace.steps + std::size_t{1}) * trace.vertices() ||
      trace.targets.size() != trace.moves() ||
      (!trace.answers.empty() && trace.answers.size() != trace.steps * trace.answers_of_step()))
    refuse("the trace holds other numbers of positions, targets and answers than its counts say");
  if (const std::string what = flaw_of(trace); !what.empty()) refuse(what);
  const auto write = [&file](std::size_t count) {
    const auto number = static_cast<std::uint32_t>(count);
    file.write(bytes_of(&number, 1));
  };
  const bool has_radii = trace.has_radii(), has_environment = has_radii || trace.touch_blocks || trace.grid;
  file.write(has_radii ? thick_magic : has_environment ? grid_magic : plain_magic);
  if (has_environment) {
    write(trace.touch_blocks);
    write(trace.grid.has_value());
  }
  if (trace.grid) {
    for (const std::uint32_t n : trace.grid->cells) write(n);
    write(trace.grid->solid.size());
    file.write(bytes_of(trace.grid->solid));
  }
  write(trace.bodies.size());
  write(trace.steps);
  for (const Traced_body& body : trace.bodies) {
    write(body.vertices);
    write(body.edges.size());
    write(body.faces.size());
    if (has_radii) write(body.radii.size());
    file.write(bytes_of(body.edges));
    file.write(bytes_of(body.radii));
    file.write(bytes_of(body.faces));
  }
  file.write(bytes_of(trace.before));
  file.write(bytes_of(trace.targets));
  const std::uint8_t has_answers = !trace.answers.empty();
  file.write(bytes_of(&has_answers, 1));
  file.write(bytes_of(trace.answers));
}

}  // namespace cellwalk::io
