// SPDX-License-Identifier: LGPL-3.0-or-later
// The writer of recordings: differences of rounded positions, in planes of bytes.
#include <cellwalk/internal/io/recording_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/files/binary.h"
#include "recording_format.h"

namespace cellwalk::io {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t head_alignment = 8;  // arrays begin at a multiple of it
constexpr double steps_of_16_bits = 65535;
static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

std::size_t corner_count(const std::vector<std::vector<std::uint32_t>>& loops) {
  std::size_t count = 0;
  for (const auto& loop : loops) count += loop.size();
  return count;
}

ordered_json head_of(const Recording_scene& scene) {
  ordered_json bodies = ordered_json::array();
  for (const Recording_body& body : scene.bodies) {
    bodies.push_back({{"kind", body.is_catheter ? "catheter" : "body"},
                      {"vertices", body.vertices},
                      {"edges", body.edges},
                      {"faces", body.faces}});
    if (body.radius > 0) bodies.back()["radius"] = body.radius;
  }
  return {{"dimension", scene.dimension},
          {"time_step", scene.time_step},
          {"steps", scene.steps},
          {"every", scene.every},
          {"records", scene.frame_count()},
          {"cells", scene.cells},
          {"lower", scene.lower},
          {"upper", scene.upper},
          {"walls_move", scene.walls_move},
          {"walls_change", scene.walls_change},
          {"points", scene.points.size()},
          {"walls", scene.walls.size()},
          {"wall_corners", corner_count(scene.walls)},
          {"floor", scene.floor.size()},
          {"floor_corners", corner_count(scene.floor)},
          {"lines", scene.lines.size()},
          {"particles", scene.particles},
          {"edges", scene.edges.size()},
          {"faces", scene.faces.size()},
          {"decisions", decision_names},
          {"bodies", bodies}};
}

void write_loops(Byte_sink& file, const std::vector<std::vector<std::uint32_t>>& loops) {
  std::vector<std::uint32_t> sizes, corners;
  for (const auto& loop : loops) {
    sizes.push_back(static_cast<std::uint32_t>(loop.size()));
    corners.insert(corners.end(), loop.begin(), loop.end());
  }
  file.write(bytes_of(sizes));
  file.write(bytes_of(corners));
}

void write_changed_loops(Byte_sink& file, const Loops_change& change) {
  const std::vector<std::uint32_t> sizes{static_cast<std::uint32_t>(change.toggled.size()),
                                         static_cast<std::uint32_t>(change.added.size()),
                                         static_cast<std::uint32_t>(corner_count(change.added))};
  file.write(bytes_of(sizes));
  file.write(bytes_of(change.toggled));
  write_loops(file, change.added);
}

void write_change(Byte_sink& file, const Walls_change& change) {
  const std::vector<std::uint32_t> points{static_cast<std::uint32_t>(change.points.size())};
  file.write(bytes_of(points));
  file.write(bytes_of(change.points));
  for (const Loops_change* loops : {&change.walls, &change.floor, &change.lines})
    write_changed_loops(file, *loops);
}

/// Encodes numbers of either sign near zero as small ones: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
template <class Unsigned>
Unsigned folded(Unsigned difference) {
  constexpr int top_bit = 8 * sizeof(Unsigned) - 1;
  return static_cast<Unsigned>(difference << 1) ^ static_cast<Unsigned>(-(difference >> top_bit));
}

/// First the lowest bytes of all numbers, then the next ones, so that small numbers compress well.
template <class Unsigned>
void append_planes(std::string& out, const std::vector<Unsigned>& values) {
  for (std::size_t byte = 0; byte < sizeof(Unsigned); ++byte)
    for (const Unsigned value : values) out.push_back(static_cast<char>(value >> 8 * byte & 0xff));
}

}  // namespace

Recording_writer::Recording_writer(std::filesystem::path path, Recording_scene scene)
    : Recording_writer(std::make_unique<Gzip_file>(std::move(path)), std::move(scene)) {}

Recording_writer::Recording_writer(std::unique_ptr<Byte_sink> file, Recording_scene scene, bool is_continued)
    : file_(std::move(file)),
      scene_(std::move(scene)),
      wall_points_(scene_.points.size()),
      last_cells_(scene_.moving_count()) {
  for (int axis = 0; axis < scene_.dimension; ++axis)
    last_.emplace_back(scene_.moving_count() + (scene_.walls_move ? wall_points_ : 0));
  before_last_ = last_;
  if (!is_continued) write_head();
}

void Recording_writer::write_head() {
  std::string head = head_of(scene_).dump();
  const std::size_t before = recording_magic.size() + sizeof(std::uint32_t);
  while ((before + head.size()) % head_alignment != 0) head.push_back(' ');
  const auto size = static_cast<std::uint32_t>(head.size());
  file_->write(recording_magic);
  file_->write({reinterpret_cast<const char*>(&size), sizeof size});
  file_->write(head);
  file_->write(bytes_of(scene_.points));
  write_loops(*file_, scene_.walls);
  write_loops(*file_, scene_.floor);
  file_->write(bytes_of(scene_.lines));
  file_->write(bytes_of(scene_.edges));
  file_->write(bytes_of(scene_.faces));
}

std::uint16_t Recording_writer::rounded(double x, std::size_t axis) const {
  const double low = scene_.lower[axis], size = scene_.upper[axis] - low;
  return static_cast<std::uint16_t>(std::lround(std::clamp((x - low) / size, 0.0, 1.0) * steps_of_16_bits));
}

/// New points of walls are expected where they appear.
void Recording_writer::add_points(const std::vector<Point<3>>& points) {
  wall_points_ += points.size();
  if (!scene_.walls_move) return;
  for (std::size_t axis = 0; axis < last_.size(); ++axis)
    for (const Point<3>& x : points)
      for (auto* places : {&last_[axis], &before_last_[axis]}) places->push_back(rounded(x[axis], axis));
}

void Recording_writer::add(const Recording_frame& record) {
  const std::size_t count = record.cells.size();
  const Walls_change nothing;
  const Walls_change& change = record.change != nullptr ? *record.change : nothing;
  const std::size_t points = wall_points_ + change.points.size();
  if (record.positions.size() != count + (scene_.walls_move ? points : 0) || count != scene_.moving_count() ||
      record.decisions.size() != scene_.bodies.size() || (record.change != nullptr && !scene_.walls_change))
    throw Error(Error_code::usage, "a record of motion has other numbers of points than its scene");
  if (scene_.walls_change) write_change(*file_, change);
  add_points(change.points);
  std::vector<std::uint16_t> left;
  for (std::size_t axis = 0; axis < last_.size(); ++axis) {
    std::vector<std::uint16_t> now;
    for (const Point<3>& x : record.positions) now.push_back(rounded(x[axis], axis));
    std::vector<std::uint16_t>&last = last_[axis], &before_last = before_last_[axis];
    // Uniform motion gives zeros; the first frame is stored as it is.
    for (std::size_t i = 0; i < now.size(); ++i) {
      const int expected = records_ > 1 ? 2 * last[i] - before_last[i] : last[i];
      left.push_back(folded(static_cast<std::uint16_t>(now[i] - expected)));
    }
    before_last = std::exchange(last, std::move(now));
  }
  std::vector<std::uint32_t> changes;
  for (std::size_t i = 0; i < count; ++i) changes.push_back(folded(record.cells[i] - last_cells_[i]));
  std::string bytes;
  append_planes(bytes, left);
  append_planes(bytes, changes);
  for (const Decision decision : record.decisions) bytes.push_back(static_cast<char>(decision));
  file_->write(bytes);
  last_cells_.assign(record.cells.begin(), record.cells.end());
  ++records_;
}

void Recording_writer::commit() {
  if (records_ != scene_.frame_count())
    throw Error(Error_code::usage, fmt::format("a motion of {} records was announced, and {} were written",
                                               scene_.frame_count(), records_));
  file_->commit();
}

}  // namespace cellwalk::io
