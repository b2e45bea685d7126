// SPDX-License-Identifier: LGPL-3.0-or-later
// Lists of OpenFOAM: N(a b c), (a b c), N{a}, and N with a block of bytes.
#include "foam_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cellwalk::io {
namespace {

constexpr std::size_t text_bytes = 2;                   // of a label: a digit and what ends it
constexpr std::size_t point_text = 7;                   // "(0 0 0)"
constexpr std::size_t face_text = 4, face_corners = 3;  // "3()"

class Label_appender {
 public:
  Label_appender(Foam_reader& in, const Label_range& range, std::vector<std::uint32_t>& to)
      : in_(in), range_(range), to_(to), begin_(to.size()) {}

  void append(std::int64_t label) {
    if (label < range_.first || label >= range_.end)
      in_.fail(fmt::format("{}: number {} is {}, where {} to {} are possible", range_.what,
                           to_.size() - begin_, label, range_.first, range_.end - 1));
    if (to_.size() == end_of_labels) in_.fail("has more numbers than indices of 32 bits can count");
    to_.push_back(static_cast<std::uint32_t>(label));
  }

  void text(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (in_.takes(')'))
        in_.fail(fmt::format("{}: {} are announced, and the list holds {}", range_.what, count, i));
      append(in_.integer(range_.what));
    }
    in_.expect(')', range_.what);
  }

  void text_of_unknown_length() {
    while (!in_.takes(')')) append(in_.integer(range_.what));
  }

  void equal(std::size_t count, std::size_t most) {
    if (count > most)
      in_.fail(fmt::format("{}: {} equal ones, where at most {} are possible", range_.what, count, most));
    const std::int64_t label = in_.integer(range_.what);
    in_.expect('}', range_.what);
    for (std::size_t i = 0; i < count; ++i) append(label);
  }

  void binary(std::size_t count) {
    const std::string_view bytes = in_.labels(count, range_.what);
    const std::size_t each = in_.label_bytes();
    for (std::size_t i = 0; i < count; ++i) append(in_.label_at(bytes.data() + i * each));
  }

 private:
  Foam_reader& in_;
  const Label_range& range_;
  std::vector<std::uint32_t>& to_;
  std::size_t begin_;
};

void check_finite(const Foam_reader& in, const Point<3>& p, std::size_t i) {
  if (!is_finite(p)) in.fail(fmt::format("point {} has a coordinate that is not finite", i));
}

Foam_faces compact_faces(Foam_reader& in, const Label_range& points) {
  Foam_faces faces;
  faces.begin = read_labels(in, {"beginnings of faces", 0, end_of_labels}, 1);
  faces.points = read_labels(in, points, 1);
  if (faces.begin.empty()) faces.begin = {0};
  if (faces.begin.front() != 0 || !std::ranges::is_sorted(faces.begin) ||
      faces.begin.back() != faces.points.size())
    in.fail(fmt::format("its faces do not take the {} points that are listed: it is broken",
                        faces.points.size()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].size() < face_corners)
      in.fail(fmt::format("face {} has {} points: at least 3 are needed", f, faces[f].size()));
  return faces;
}

Foam_faces listed_faces(Foam_reader& in, const Label_range& points) {
  Foam_faces faces;
  const std::size_t count = in.count("faces");
  in.expect_room(count, "faces", face_text);
  in.expect('(', "the faces");
  for (std::size_t f = 0; f < count; ++f) {
    if (in.takes(')')) in.fail(fmt::format("announces {} faces, and holds {}", count, f));
    append_labels(in, points, 1, faces.points);
    faces.begin.push_back(static_cast<std::uint32_t>(faces.points.size()));
    if (faces[f].size() < face_corners)
      in.fail(fmt::format("face {} has {} points: at least 3 are needed", f, faces[f].size()));
  }
  in.expect(')', "the faces");
  return faces;
}

}  // namespace

void append_labels(Foam_reader& in, const Label_range& range, std::size_t most_equal,
                   std::vector<std::uint32_t>& to) {
  Label_appender labels(in, range, to);
  if (!in.is_binary() && in.takes('(')) return labels.text_of_unknown_length();
  const std::size_t count = in.count(range.what);
  if (in.is_binary()) return labels.binary(count);
  if (in.takes('{')) return labels.equal(count, most_equal);
  in.expect_room(count, range.what, text_bytes);
  if (count > 0)
    in.expect('(', range.what);
  else if (!in.takes('('))
    return;
  labels.text(count);
}

std::vector<std::uint32_t> read_labels(Foam_reader& in, const Label_range& range, std::size_t most_equal) {
  std::vector<std::uint32_t> labels;
  append_labels(in, range, most_equal, labels);
  return labels;
}

std::vector<Point<3>> read_foam_points(Foam_reader& in) {
  std::vector<Point<3>> points;
  const std::size_t count = in.count("points");
  if (in.is_binary()) {
    const std::string_view bytes = in.vectors(count, "points");
    const std::size_t each = in.scalar_bytes();
    points.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) points[i][k] = in.scalar_at(bytes.data() + (3 * i + k) * each);
      check_finite(in, points[i], i);
    }
    return points;
  }
  in.expect_room(count, "points", point_text);
  points.reserve(count);
  in.expect('(', "the points");
  while (points.size() < count) {
    if (in.takes(')')) in.fail(fmt::format("announces {} points, and holds {}", count, points.size()));
    in.expect('(', "a point");
    Point<3> p;
    for (double& x : p) x = in.real("a coordinate");
    in.expect(')', "a point");
    points.push_back(p);
  }
  in.expect(')', "the points");
  return points;
}

Foam_faces read_foam_faces(Foam_reader& in, std::size_t point_count) {
  const Label_range points{"points of a face", 0, static_cast<std::int64_t>(point_count)};
  return in.type() == "faceCompactList" ? compact_faces(in, points) : listed_faces(in, points);
}

}  // namespace cellwalk::io
