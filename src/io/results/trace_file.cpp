// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files/binary.h"

namespace cellwalk::io {
namespace {

constexpr std::size_t trace_header_size = 64, index_size = 4, point_size = 24, answer_size = 1;
static_assert(sizeof(Point<3>) == point_size && std::endian::native == std::endian::little,
              "arrays are read and written as they lie in memory");

/// A replay builds all cells of the grid, however short the file is. Beyond a million cells, which any file
/// may have, the bytes set the limit: traces of large grids have much motion.
constexpr std::uint64_t cells_of_any_file = 1'000'000, cells_a_byte = 64;

/// Obstacles are followed by zero bytes up to a multiple of eight.
std::size_t padding(std::uint64_t obstacles) { return obstacles % 2 == 0 ? 0 : index_size; }

/// True if the grid has cells, and all their indices fit into 32 bits.
bool is_indexable(const Trace& trace) {
  constexpr std::uint64_t most = std::uint64_t{1} << 32;
  if (trace.nx == 0 || trace.ny == 0 || trace.nz == 0) return false;
  const std::uint64_t layer = std::uint64_t{trace.nx} * trace.ny;
  return layer <= most && layer * trace.nz <= most;
}

Trace take_header(Binary_reader& in, std::uint32_t& obstacles) {
  Trace trace;
  trace.nx = in.take<std::uint32_t>("the header");
  trace.ny = in.take<std::uint32_t>("the header");
  trace.nz = in.take<std::uint32_t>("the header");
  trace.bodies = in.take<std::uint32_t>("the header");
  trace.steps = in.take<std::uint32_t>("the header");
  obstacles = in.take<std::uint32_t>("the header");
  trace.seed = in.take<std::uint64_t>("the header");
  trace.obstacle_fraction = in.take<double>("the header");
  trace.body_side = in.take<double>("the header");
  trace.speed = in.take<double>("the header");
  return trace;
}

/// Compares the header with the number of bytes. The counts have 32 bits, and steps are compared by division,
/// so that no sum or product here has more than 64.
void check_size(const std::string& name, const Trace& trace, std::uint64_t obstacles, std::uint64_t bytes) {
  const std::uint64_t vertices = std::uint64_t{trace.bodies} * trace_vertices;
  const std::uint64_t before_steps = index_size * obstacles + padding(obstacles) + vertices * point_size;
  const std::uint64_t a_step = vertices * (point_size + answer_size);
  const std::string announced =
      fmt::format("{} obstacles, {} bodies and {} steps", obstacles, trace.bodies, trace.steps);
  if (before_steps > bytes || (a_step > 0 && trace.steps > (bytes - before_steps) / a_step))
    fail(name, fmt::format("announces {}, more than its {} bytes hold: it is cut short, get it whole",
                           announced, trace_header_size + bytes));
  if (const std::uint64_t rest = bytes - before_steps - trace.steps * a_step; rest > 0)
    fail(name, fmt::format("goes on for {} bytes after the {} that it announces: it is damaged, get it anew",
                           rest, announced));
}

/// The defect of the values of a trace whose arrays have the right lengths; empty if there is none.
std::string flaw(const Trace& trace) {
  if (!is_indexable(trace))
    return fmt::format(
        "a grid of {} x {} x {} cells: there must be some, and no more than 32-bit indices name", trace.nx,
        trace.ny, trace.nz);
  if (trace.bodies == 0 && trace.steps > 0)
    return fmt::format("announces {} steps of no bodies: nothing moves in them", trace.steps);
  for (double x : {trace.obstacle_fraction, trace.body_side, trace.speed})
    if (!std::isfinite(x)) return "a number of the header is not finite: the trace is damaged";
  for (std::size_t i = 0; i < trace.obstacles.size(); ++i) {
    if (trace.obstacles[i] >= trace.cells())
      return fmt::format("obstacle {} is cell {}, of {}: the trace is damaged", i, trace.obstacles[i],
                         trace.cells());
    if (i > 0 && trace.obstacles[i] <= trace.obstacles[i - 1])
      return fmt::format("obstacle {} is cell {}, after cell {}: obstacles must ascend", i,
                         trace.obstacles[i], trace.obstacles[i - 1]);
  }
  for (std::size_t i = 0; i < trace.start_positions.size(); ++i)
    if (!is_finite(trace.start_positions[i]))
      return fmt::format("vertex {} of body {} starts at a coordinate that is not finite", i % trace_vertices,
                         i / trace_vertices);
  for (std::size_t i = 0; i < trace.targets.size(); ++i) {
    const std::size_t body = i / trace_vertices % trace.bodies, step = i / trace_vertices / trace.bodies;
    if (!is_finite(trace.targets[i]))
      return fmt::format("the target of vertex {} of body {} in step {} has a coordinate that is not finite",
                         i % trace_vertices, body, step);
    if ((trace.answers[i] & ~trace_all_bits) != 0)
      return fmt::format("the answer to vertex {} of body {} in step {} has an unknown bit: it is {}",
                         i % trace_vertices, body, step, trace.answers[i]);
  }
  return {};
}

/// The next `count` values.
/// \pre as many bytes are left
template <class T>
std::vector<T> take_array(std::string_view& bytes, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return values;
}

}  // namespace

Trace parse_trace(const std::string& name, std::string_view bytes) {
  if (!bytes.starts_with(trace_magic))
    fail(name,
         fmt::format("is no trace: it does not begin with {}; name a file of recorded motion", trace_magic));
  const std::size_t file_size = bytes.size();
  Binary_reader in(name, bytes.substr(trace_magic.size()), false);
  std::uint32_t obstacles = 0;
  Trace trace = take_header(in, obstacles);
  bytes.remove_prefix(trace_header_size);
  check_size(name, trace, obstacles, bytes.size());
  trace.obstacles = take_array<std::uint32_t>(bytes, obstacles);
  for (char c : take_array<char>(bytes, padding(obstacles)))
    if (c != 0)
      fail(name, "the bytes after the obstacles, which fill up to eight, are not zero: it is damaged");
  trace.start_positions = take_array<Point<3>>(bytes, trace.bodies * trace_vertices);
  trace.targets = take_array<Point<3>>(bytes, trace.moves());
  trace.answers = take_array<std::uint8_t>(bytes, trace.moves());
  if (const std::string what = flaw(trace); !what.empty()) fail(name, what);
  if (trace.cells() > std::max<std::uint64_t>(cells_of_any_file, cells_a_byte * file_size))
    fail(name, fmt::format("announces a grid of {} cells in {} bytes, too large for so little motion: it may "
                           "be damaged; get it anew, or record in a smaller grid",
                           trace.cells(), file_size));
  return trace;
}

Trace read_trace(const std::filesystem::path& path) { return parse_trace(path.string(), load(path)); }

void write_trace(Atomic_file& file, const Trace& trace) {
  const auto refuse = [&](const std::string& what) {
    throw Error(Error_code::usage, fmt::format("{}: is not written: {}", file.destination().string(), what));
  };
  if (trace.obstacles.size() > std::numeric_limits<std::uint32_t>::max() ||
      trace.start_positions.size() != trace.bodies * trace_vertices ||
      trace.targets.size() != trace.moves() || trace.answers.size() != trace.moves())
    refuse("the trace holds other numbers of positions, targets and answers than its counts say");
  if (const std::string what = flaw(trace); !what.empty()) refuse(what);
  file.write(trace_magic);
  const auto obstacles = static_cast<std::uint32_t>(trace.obstacles.size());
  for (std::uint32_t n : {trace.nx, trace.ny, trace.nz, trace.bodies, trace.steps, obstacles})
    file.write(bytes_of(&n, 1));
  file.write(bytes_of(&trace.seed, 1));
  for (double x : {trace.obstacle_fraction, trace.body_side, trace.speed}) file.write(bytes_of(&x, 1));
  file.write(bytes_of(trace.obstacles));
  file.write(std::string(padding(obstacles), '\0'));
  file.write(bytes_of(trace.start_positions));
  file.write(bytes_of(trace.targets));
  file.write(bytes_of(trace.answers));
}

void write_trace(const std::filesystem::path& path, const Trace& trace) {
  Atomic_file file(path);
  write_trace(file, trace);
  file.commit();
}

}  // namespace cellwalk::io
