// SPDX-License-Identifier: LGPL-3.0-or-later
// PLY, as text and binary. CGAL's reader trusts header and list lengths: a damaged byte makes it read for
// minutes, or behave in undefined ways.
#include <cellwalk/internal/io/numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "io/files/binary.h"
#include "io/files/text.h"
#include "ply_header.h"
#include "surface_parsers.h"

namespace cellwalk::io {
namespace {

/// A source of values, one after the other.
class Source {
 public:
  virtual ~Source() = default;
  virtual double next(Ply_type type, const char* what) = 0;
  /// A bound of the number of remaining values.
  virtual std::size_t left() const = 0;
  /// What is left at the end: "3 lines"; empty if nothing is.
  virtual std::string rest() = 0;
  [[noreturn]] virtual void fail(const std::string& what) const = 0;
};

class Text_source : public Source {
 public:
  Text_source(const std::string& name, std::string_view bytes, const Ply_header& header)
      : in_(name, bytes.substr(header.size), '\0'), header_lines_(header.lines), name_(name) {}

  double next(Ply_type, const char* what) override {
    while (in_.at_line_end())
      if (!in_.next_line()) fail(fmt::format("the file ends where {} should be: it is cut short", what));
    const std::string_view word = in_.word();
    const auto value = parse_decimal(word);
    if (!value) fail(fmt::format("{}: '{}' is not a number", what, word.substr(0, 40)));
    return *value;
  }
  std::size_t left() const override { return in_.rest().size() + in_.remaining().size(); }
  std::string rest() override {
    std::size_t lines = in_.at_line_end() ? 0 : 1;
    while (in_.next_line()) ++lines;
    return lines > 0 ? fmt::format("{} lines", lines) : "";
  }
  [[noreturn]] void fail(const std::string& what) const override {
    io::fail(name_, header_lines_ + in_.line(), what);
  }

 private:
  Line_reader in_;
  std::size_t header_lines_;
  const std::string& name_;
};

class Binary_source : public Source {
 public:
  Binary_source(const std::string& name, std::string_view bytes, const Ply_header& header)
      : in_(name, bytes.substr(header.size), header.encoding == Ply_encoding::big_endian) {}

  double next(Ply_type type, const char* what) override {
    switch (type) {
      case Ply_type::int8:
        return in_.take<std::int8_t>(what);
      case Ply_type::uint8:
        return in_.take<std::uint8_t>(what);
      case Ply_type::int16:
        return in_.take<std::int16_t>(what);
      case Ply_type::uint16:
        return in_.take<std::uint16_t>(what);
      case Ply_type::int32:
        return in_.take<std::int32_t>(what);
      case Ply_type::uint32:
        return in_.take<std::uint32_t>(what);
      case Ply_type::float32:
        return in_.take<float>(what);
      case Ply_type::float64:
        break;
    }
    return in_.take<double>(what);
  }
  std::size_t left() const override { return in_.left(); }
  std::string rest() override { return left() > 0 ? fmt::format("{} bytes", left()) : ""; }
  [[noreturn]] void fail(const std::string& what) const override { in_.fail(what); }

 private:
  Binary_reader in_;
};

class Ply_reader {
 public:
  Ply_reader(std::unique_ptr<Source> source, Body_elements* body) : in_(std::move(source)), body_(body) {}

  Surface_soup read(const Ply_header& header, Read_report& report) {
    for (const Ply_element& element : header.elements) {
      if (element.name == "vertex")
        vertices(element);
      else if (element.name == "face")
        faces(element);
      else if (element.name == "tristrips")
        strips(element, report);
      else if (element.name == "edge" && body_)
        edges(element);
      else if (element.count > 0)
        report.notes.push_back(fmt::format("{} elements '{}' ignored", element.count, shown(element.name))),
            skip(element);
    }
    for (std::size_t f = 0; f < soup_.facets.size(); ++f)
      for (std::uint32_t v : soup_.facets[f])
        if (v >= soup_.points.size())
          in_->fail(fmt::format("facet {} names vertex {}, of {}", f, v, soup_.points.size()));
    if (body_) check_edges();
    if (const std::string rest = in_->rest(); !rest.empty())
      report.notes.push_back(fmt::format("{} after the last element ignored", rest));
    return std::move(soup_);
  }

 private:
  void vertices(const Ply_element& element) {
    std::array<std::size_t, 3> axes;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto place = element.find(std::string_view("xyz").substr(k, 1), false);
      if (!place) in_->fail(fmt::format("the header gives vertices no property '{}'", "xyz"[k]));
      axes[k] = *place;
    }
    std::vector<double> row(element.properties.size());
    soup_.points.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(element.count, in_->left())));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = value(element.properties[j], "a vertex");
      soup_.points.push_back({row[axes[0]], row[axes[1]], row[axes[2]]});
      if (!is_finite(soup_.points.back()))
        in_->fail(fmt::format("vertex {} has a coordinate that is not finite", i));
      check_planar(*in_, body_, soup_.points.back());
    }
  }

  void faces(const Ply_element& element) {
    auto list = element.find("vertex_indices", true);
    if (!list) list = element.find("vertex_index", true);
    if (!list) in_->fail("the header gives faces no list 'vertex_indices': a surface is needed");
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (std::size_t j = 0; j < element.properties.size(); ++j) {
        if (j == *list)
          facet(i, element.properties[j]);
        else
          value(element.properties[j], "a face");
      }
  }

  /// Strips of triangles, ended by -1: each vertex after the second makes a triangle with the two before it.
  void strips(const Ply_element& element, Read_report& report) {
    const auto list = element.find("vertex_indices", true);
    if (!list) in_->fail("the header gives strips of triangles no list 'vertex_indices'");
    const std::size_t before = soup_.facets.size();
    std::size_t flat = 0;
    std::vector<std::uint32_t> strip;
    for (std::uint64_t i = 0; i < element.count; ++i, strip.clear())
      for (std::size_t j = 0; j < element.properties.size(); ++j) {
        if (j != *list) {
          value(element.properties[j], "a strip");
          continue;
        }
        for (std::size_t n = length(element.properties[j]); n > 0; --n) {
          const double v = in_->next(element.properties[j].type, "a strip");
          if (v == -1 || v == static_cast<double>(std::numeric_limits<std::uint32_t>::max())) {
            strip.clear();
            continue;
          }
          strip.push_back(index("strip", i, v));
          if (strip.size() >= 3) flat += !triangle(strip);
        }
      }
    report.notes.push_back(
        fmt::format("strips read as {} triangles{}", soup_.facets.size() - before,
                    flat > 0 ? fmt::format("; {} that repeat a vertex left out", flat) : ""));
  }

  /// Adds the last triangle of a strip, every second of which is turned round. False if it repeats a vertex,
  /// as those do that join two strips.
  bool triangle(const std::vector<std::uint32_t>& strip) {
    const std::size_t n = strip.size();
    const std::uint32_t a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
    if (a == b || b == c || c == a) return false;
    soup_.facets.push_back(n % 2 == 1 ? std::vector{a, b, c} : std::vector{b, a, c});
    return true;
  }

  void facet(std::uint64_t i, const Ply_property& property) {
    std::vector<std::uint32_t> loop(length(property));
    if (loop.size() < 3)
      in_->fail(fmt::format("facet {} has {} vertices: at least 3 are needed", i, loop.size()));
    for (std::uint32_t& v : loop) v = index("facet", i, in_->next(property.type, "a facet"));
    soup_.facets.push_back(std::move(loop));
  }

  /// The edges of a body: properties vertex1 and vertex2.
  void edges(const Ply_element& element) {
    const auto first = element.find("vertex1", false), second = element.find("vertex2", false);
    if (!first || !second) in_->fail("the header gives edges no properties 'vertex1' and 'vertex2'");
    const auto radius = element.find("radius", false);
    std::vector<double> row(element.properties.size());
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = value(element.properties[j], "an edge");
      body_->edges.push_back({index("edge", i, row[*first]), index("edge", i, row[*second])});
      body_->radii.push_back(radius ? row[*radius] : 0);
      if (const std::string problem = radius_problem(body_->radii.back()); !problem.empty())
        in_->fail(fmt::format("edge {}: {}", i, problem));
    }
  }

  void check_edges() const {
    for (std::size_t i = 0; i < body_->edges.size(); ++i)
      for (std::uint32_t v : body_->edges[i])
        if (v >= soup_.points.size())
          in_->fail(fmt::format("edge {} names vertex {}, of {}", i, v, soup_.points.size()));
  }

  std::uint32_t index(const char* kind, std::uint64_t i, double value) const {
    constexpr double most = 0xfffffffe;  // the largest index of 32 bits
    if (!(value >= 0 && value <= most && value == static_cast<std::uint32_t>(value)))
      in_->fail(fmt::format("{} {} names vertex {}", kind, i, value));
    return static_cast<std::uint32_t>(value);
  }

  /// The length of a list, not more than the file can contain.
  std::size_t length(const Ply_property& property) {
    const double n = in_->next(*property.count_type, "the length of a list");
    if (!(n >= 0 && n <= static_cast<double>(in_->left()) &&
          n == static_cast<double>(static_cast<std::size_t>(n))))
      in_->fail(fmt::format("a list of {} values: the file is cut short or broken", n));
    return static_cast<std::size_t>(n);
  }

  /// A value, or the last value of a list; unused values only have to be skipped.
  double value(const Ply_property& property, const char* what) {
    if (!property.count_type) return in_->next(property.type, what);
    double last = 0;
    for (std::size_t n = length(property); n > 0; --n) last = in_->next(property.type, what);
    return last;
  }

  void skip(const Ply_element& element) {
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
      for (const Ply_property& property : element.properties) value(property, "an element");
  }

  std::unique_ptr<Source> in_;
  Body_elements* body_;
  Surface_soup soup_;
};

}  // namespace

Surface_soup parse_ply(const std::string& name, std::string_view bytes, Read_report& report,
                       Body_elements* body) {
  const Ply_header header = read_ply_header(name, bytes);
  const bool text = header.encoding == Ply_encoding::text;
  report.format = text ? "PLY" : "PLY (binary)";
  if (text) return Ply_reader(std::make_unique<Text_source>(name, bytes, header), body).read(header, report);
  return Ply_reader(std::make_unique<Binary_source>(name, bytes, header), body).read(header, report);
}

}  // namespace cellwalk::io
