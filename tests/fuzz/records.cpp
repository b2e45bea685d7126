// SPDX-License-Identifier: LGPL-3.0-or-later
// Readers of tables, scenes, recorded motions, traces, and of what is compressed.
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/internal/io/query_file.h>
#include <cellwalk/internal/io/repro_file.h>
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/internal/io/trace_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "fuzz/decoder.h"
#include "fuzz/targets.h"
#include "io/files/text.h"
#include "io/results/recording_format.h"

namespace cellwalk::fuzz {
namespace {

/// The parts of an input between these bytes.
std::vector<std::string> parts(std::string_view bytes, char between) {
  std::vector<std::string> result;
  for (std::size_t at = 0; at != bytes.npos;) {
    const std::size_t end = bytes.find(between, at);
    result.emplace_back(bytes.substr(at, end - at));
    at = end == bytes.npos ? end : end + 1;
  }
  return result;
}

/// Rows of a table as queries: finite, or with a reason.
template <int D, std::size_t N>
void query(const io::Csv_table& table, const std::array<std::string_view, N>& prefixes) {
  reads([&] {
    const auto rows = io::query_rows<D, N>(table, prefixes);
    demand(rows.size() == table.row_count(), "rows are lost");
    for (const auto& row : rows)
      for (const auto& p : row.points)
        demand(!row.error.empty() || is_finite(p), "a query that is not finite, without a reason");
  });
}

void expect_finite(const std::vector<Point<3>>& points) {
  for (const Point<3>& p : points) demand(is_finite(p), "a coordinate is not finite");
}

void check_trace(const Body_trace& trace) {
  demand(trace.before.size() == (std::size_t{trace.steps} + 1) * trace.vertices() &&
             trace.targets.size() == trace.moves() &&
             (trace.answers.empty() || trace.answers.size() == trace.steps * trace.answers_of_step()),
         "a trace's arrays do not fit its counts");
  expect_finite(trace.before);
  expect_finite(trace.targets);
  if (trace.grid) {
    const auto& solid = trace.grid->solid;
    demand(std::ranges::adjacent_find(solid, std::greater_equal<>()) == solid.end() &&
               (solid.empty() || solid.back() < trace.grid->cell_count()),
           "obstacles that are not in order, or not in the grid");
  }
  for (const Traced_body& body : trace.bodies) {
    const auto is_edge = [&body](std::uint32_t u, std::uint32_t v) {
      return std::ranges::binary_search(body.edges, std::array{std::min(u, v), std::max(u, v)});
    };
    demand(std::ranges::adjacent_find(body.edges, std::greater_equal<>()) == body.edges.end(),
           "edges that are not in order");
    demand(body.radii.size() <= 1 || body.radii.size() == body.edges.size(), "radii that are not of edges");
    for (const double r : body.radii)
      demand(r >= 0 && std::isfinite(r) && !(trace.touch_blocks && r > 0), "a radius that no edge may have");
    for (const auto& [u, v] : body.edges) demand(u < v && v < body.vertices, "an edge without its ends");
    for (const auto& [u, v, w] : body.faces)
      demand(is_edge(u, v) && is_edge(v, w) && is_edge(w, u), "a face without its edges");
  }
  for (const std::uint8_t answer : trace.answers)
    demand((answer & ~body_trace_bits) == 0, "an answer with an unknown bit");
}

}  // namespace

void csv(std::string_view bytes) {
  reads([&] {
    const io::Csv_table table = io::Csv_table::parse("in", std::string(bytes));
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      table.row_problem(row);
      for (std::size_t column = 0; column < table.columns().size(); ++column) {
        const io::Parsed_number number = table.number(row, column);
        demand(!number || std::isfinite(number.value), "a number that is not finite");
      }
    }
    if (const auto column = table.find_column("radius"))
      for (std::size_t row = 0; row < table.row_count(); ++row) {
        const io::Parsed_number radius = io::radius_of(table, row, *column);
        demand(!radius || (radius.value >= 0 && std::isfinite(radius.value)), "a radius that is none");
      }
    query<2, 2>(table, {"a", "b"});
    query<3, 2>(table, {"a", "b"});
    query<2, 3>(table, {"p", "t", "q"});
    query<3, 3>(table, {"p", "t", "q"});
    query<3, 1>(table, {""});
  });
}

/// A scene; what follows a byte 1 are changes, each after another one.
void scene(std::string_view bytes) {
  std::vector<std::string> changes = parts(bytes, '\1');
  const std::string text = changes.front();
  changes.erase(changes.begin());
  reads([&] { io::parse_scene("in", text, "folder"); });
  if (changes.empty() || !reads([&] { io::change_scene("in", text, {}); })) return;
  reads(
      [&] {
        const std::string changed = io::change_scene("in", text, changes);
        demand(reads([&] { io::change_scene("in", changed, {}); }), "a change makes no JSON: " + changed);
      },
      {Error_code::usage});
}

void record(std::string_view bytes) {
  reads([&] {
    std::visit(
        [](const auto& motion) {
          demand(motion.soup.cell_count() > 0 && is_finite(motion.from) && is_finite(motion.to),
                 "an empty record");
          for (const std::uint32_t v : motion.soup.vertices)
            demand(v < motion.soup.points.size(), "an index is out of range");
          demand(!motion.cell || *motion.cell < motion.soup.cell_count(), "a cell is out of range");
        },
        io::parse_repro("in", bytes));
  });
}

void trace(std::string_view bytes) {
  reads([&] { check_trace(io::parse_trace("in", bytes)); });
}

void motion(std::string_view bytes) {
  reads([&] {
    const Recording_scene scene = io::parse_recording("in", bytes);
    const std::uint64_t records =
        1 + std::uint64_t{scene.steps} / scene.every + (scene.steps % scene.every != 0);
    demand(records == scene.frame_count() && bytes.size() >= records, "more records than bytes");
    for (const auto* loops : {&scene.walls, &scene.floor})
      for (const auto& loop : *loops)
        for (const std::uint32_t v : loop) demand(v < scene.points.size(), "an index is out of range");
  });
}

/// The first byte says how the others are packed before they are read: not at all; or compressed, with one
/// byte changed or the end cut off, as the next two say. Checksums keep random bytes from getting far.
void gzip(std::string_view bytes) {
  Decoder in(bytes);
  const std::uint8_t damage = in.byte();
  if (damage % 3 == 0) {
    const std::string packed(in.rest());
    reads([&] { io::unpack("in", packed); });
    return;
  }
  const std::size_t at = in.below(65536);
  const std::string plain(in.rest());
  std::string packed = io::gzip(plain);
  demand(io::is_gzip(packed) && io::unpack("in", packed) == plain,
         "gzip does not give back what it was given");
  if (damage % 3 == 1)
    packed[at % packed.size()] ^= static_cast<char>(1 + damage / 3);
  else
    packed.resize(at % packed.size());
  reads([&] { io::unpack("in", packed); });
}

}  // namespace cellwalk::fuzz
