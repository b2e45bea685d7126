// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of recordings, which tests every count and number of a file.
#include <cellwalk/internal/io/recording_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <utility>

#include "io/files/binary.h"
#include "recording_format.h"

namespace cellwalk::io {
namespace {

/// Reads the parts of a recording one after the other.
class Motion_parser {
 public:
  Motion_parser(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}

  Recording_scene parse() {
    if (!bytes_.starts_with(recording_magic))
      fail(name_,
           fmt::format("is no motion: it does not begin with {}; run the scene again", recording_magic));
    Binary_reader in(name_, bytes_.substr(recording_magic.size()), false);
    const auto size = in.take<std::uint32_t>("the head");
    const std::size_t before = recording_magic.size() + sizeof size;
    if (size > bytes_.size() - before) damaged("its head is cut short");
    try {
      read_head(nlohmann::json::parse(bytes_.substr(before, size)));
    } catch (const nlohmann::json::exception&) {
      damaged("its head cannot be read");
    }
    bytes_.remove_prefix(before + size);
    check_size();
    read_arrays();
    return std::move(scene_);
  }

 private:
  [[noreturn]] void damaged(const std::string& what) const {
    fail(name_, "is damaged: " + what + "; run the scene again");
  }

  /// A count in the head.
  std::uint32_t counted(const nlohmann::json& value) const {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) damaged("its head cannot be read");
    return value.get<std::uint32_t>();
  }

  void read_head(const nlohmann::json& head) {
    scene_.dimension = static_cast<int>(std::min(counted(head.at("dimension")), 4u));
    scene_.time_step = head.at("time_step");
    scene_.steps = counted(head.at("steps"));
    scene_.every = counted(head.at("every"));
    scene_.cells = counted(head.at("cells"));
    scene_.particles = counted(head.at("particles"));
    scene_.lower = head.at("lower");
    scene_.upper = head.at("upper");
    // Older files do not contain it.
    scene_.walls_move = head.value("walls_move", false);
    scene_.walls_change = head.value("walls_change", false);
    for (const nlohmann::json& body : head.at("bodies"))
      scene_.bodies.push_back({body.at("kind") == "catheter", counted(body.at("vertices")),
                               counted(body.at("edges")), counted(body.at("faces")),
                               body.value("radius", 0.0)});
    if ((scene_.dimension != 2 && scene_.dimension != 3) || scene_.every == 0 ||
        counted(head.at("records")) != frame_count())
      damaged("the counts of its head do not fit each other");
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] = counted(head.at(count_names[i]));
  }

  /// The same as Recording_scene::frame_count(), in 64 bits, since 2^32 - 1 steps have one frame more.
  std::uint64_t frame_count() const {
    return 1 + std::uint64_t{scene_.steps} / scene_.every + (scene_.steps % scene_.every != 0);
  }

  std::uint64_t count(std::string_view name) const {
    std::size_t i = 0;
    while (count_names[i] != name) ++i;
    return counts_[i];
  }

  void check_size() const {
    std::uint64_t edges = 0, faces = 0;
    for (const Recording_body& body : scene_.bodies) edges += body.edges, faces += body.faces;
    if (edges != count("edges") || faces != count("faces"))
      damaged("the counts of its head do not fit each other");
    const std::uint64_t arrays =
        sizeof(Point<3>) * count("points") +
        sizeof(std::uint32_t) * (count("walls") + count("wall_corners") + count("floor") +
                                 count("floor_corners") + 2 * count("lines") + 2 * edges + 3 * faces);
    const std::uint64_t record = recording_frame_size(scene_, count("points")),
                        most = std::numeric_limits<std::uint64_t>::max();
    const bool is_countable = record == 0 || frame_count() <= (most - arrays) / record;
    const std::uint64_t expected = is_countable ? arrays + frame_count() * record : most;
    // Frames with lists of walls that come and go have any size.
    if (scene_.walls_change ? bytes_.size() < arrays : bytes_.size() != expected)
      damaged(
          fmt::format("after its head there are {} bytes, and {} were announced", bytes_.size(), expected));
  }

  void read_arrays() {
    Binary_reader in(name_, bytes_, false);
    for (std::uint64_t i = 0; i < count("points"); ++i) {
      Point<3> x;
      for (double& value : x) value = in.take<double>("a point");
      scene_.points.push_back(x);
    }
    read_loops(in, count("walls"), count("wall_corners"), scene_.walls);
    read_loops(in, count("floor"), count("floor_corners"), scene_.floor);
    read_tuples(in, count("lines"), scene_.points.size(), scene_.lines);
    const std::size_t vertices = scene_.moving_count() - scene_.particles;
    read_tuples(in, count("edges"), vertices, scene_.edges);
    read_tuples(in, count("faces"), vertices, scene_.faces);
    if (scene_.walls_change) check_frames(in);
  }

  /// Frames of any size, whose loops are numbered on.
  void check_frames(Binary_reader& in) const {
    std::uint64_t points = scene_.points.size();
    std::array<std::uint64_t, 3> loops{scene_.walls.size(), scene_.floor.size(), scene_.lines.size()};
    for (std::uint64_t i = 0; i < frame_count(); ++i) {
      const std::uint64_t added = in.take<std::uint32_t>("a number of points");
      skip(in, sizeof(Point<3>) * added);
      points += added;
      for (std::uint64_t& known : loops) known += check_loops(in, points, known);
      skip(in, recording_frame_size(scene_, points));
    }
    if (in.left() != 0) damaged(fmt::format("after its last frame there are {} bytes", in.left()));
  }

  void skip(Binary_reader& in, std::uint64_t count) const {
    if (in.left() < count) damaged("a frame is cut short");
    in.skip(count);
  }

  /// Returns how many loops are new.
  std::uint64_t check_loops(Binary_reader& in, std::uint64_t points, std::uint64_t known) const {
    const auto toggled = in.take<std::uint32_t>("a number of loops"),
               added = in.take<std::uint32_t>("a number of loops"),
               corners = in.take<std::uint32_t>("a number of corners");
    for (std::uint32_t i = 0; i < toggled; ++i)
      if (const auto loop = in.take<std::uint32_t>("a loop"); loop >= known)
        damaged(fmt::format("it names loop {} of {}", loop, known));
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < added; ++i) sum += in.take<std::uint32_t>("a size");
    if (sum != corners) damaged("there are not as many corners as loops have");
    for (std::uint32_t i = 0; i < corners; ++i) take_index(in, points);
    return added;
  }

  std::uint32_t take_index(Binary_reader& in, std::size_t size) const {
    const auto index = in.take<std::uint32_t>("an index");
    if (index >= size) damaged(fmt::format("it names point {} of {}", index, size));
    return index;
  }

  void read_loops(Binary_reader& in, std::uint64_t count, std::uint64_t corners,
                  std::vector<std::vector<std::uint32_t>>& loops) const {
    std::vector<std::uint32_t> sizes;
    for (std::uint64_t i = 0; i < count; ++i) sizes.push_back(in.take<std::uint32_t>("a size"));
    for (const std::uint32_t size : sizes) {
      if (size > corners) damaged("a loop has more corners than there are");
      corners -= size;
      for (std::uint32_t i = 0; i < size; ++i) {
        if (i == 0) loops.emplace_back();
        loops.back().push_back(take_index(in, scene_.points.size()));
      }
    }
    if (corners != 0) damaged("there are more corners than loops have");
  }

  template <std::size_t N>
  void read_tuples(Binary_reader& in, std::uint64_t count, std::size_t size,
                   std::vector<std::array<std::uint32_t, N>>& tuples) const {
    for (std::uint64_t i = 0; i < count; ++i)
      for (std::uint32_t& index : tuples.emplace_back()) index = take_index(in, size);
  }

  static constexpr std::array<std::string_view, 8> count_names{
      "points", "walls", "wall_corners", "floor", "floor_corners", "lines", "edges", "faces"};

  std::string name_;
  std::string_view bytes_;
  Recording_scene scene_;
  std::array<std::uint32_t, count_names.size()> counts_{};
};

}  // namespace

Recording_scene parse_recording(const std::string& name, std::string_view bytes) {
  return Motion_parser(name, bytes).parse();
}

Recording read_recording(const std::filesystem::path& path) {
  const std::string name = path.string();
  Recording result;
  result.packed = load_packed(path);
  if (!is_gzip(result.packed))
    fail(name, "is no motion: it is not compressed with gzip; run the scene again");
  result.scene = parse_recording(name, unpack(name, result.packed));
  return result;
}

}  // namespace cellwalk::io
