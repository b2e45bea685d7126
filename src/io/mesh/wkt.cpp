// SPDX-License-Identifier: LGPL-3.0-or-later
// Well-known text: POLYGON and MULTIPOLYGON. Not by Boost.Geometry, whose reader reports no position in the
// text, so that errors could not name the line.
#include <cellwalk/internal/io/numbers.h>
#include <cellwalk/internal/io/planar_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hole_points.h"
#include "io/files/text.h"

namespace cellwalk::io {
namespace {

class Parser {
 public:
  Parser(const std::string& name, std::string_view text) : name_(name), text_(text) {
    if (text.starts_with("\xef\xbb\xbf")) position_ = 3;  // a byte order mark
  }

  Planar_domain parse(Read_report& report) {
    std::size_t polygons = 0;
    while (!at_end()) {
      const std::string keyword = lower(word());
      if (keyword != "polygon" && keyword != "multipolygon")
        fail(fmt::format("'{}' where POLYGON or MULTIPOLYGON should begin", keyword.substr(0, 20)));
      std::string modifier = lower(peek_word());
      if (modifier == "z" || modifier == "m" || modifier == "zm") {
        word();
        report.notes.push_back("coordinates after x and y left out");
        modifier = lower(peek_word());
      }
      if (modifier == "empty") {
        word();
      } else if (keyword == "polygon") {
        polygon();
        ++polygons;
      } else {
        list([&] { polygon(), ++polygons; });
      }
      while (peek() == ';') ++position_;
    }
    if (polygons == 0) io::fail(name_, "holds no polygon");
    return finish(report, polygons);
  }

 private:
  void polygon() {
    bool outer = true;
    list([&] {
      ring(!outer);
      outer = false;
    });
  }

  void ring(bool is_hole) {
    peek();
    ring_lines_.push_back(position_);
    Point_ring ring;
    list([&] {
      Point<2> p;
      for (double& x : p) x = number();
      while (peek() != ',' && peek() != ')') number();
      ring.push_back(index(p));
    });
    if (ring.size() < 2 || ring.front() != ring.back())
      fail("this ring is not closed: its last point is not its first");
    ring.pop_back();
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3) fail("this ring has fewer than three different points");
    if (is_hole) holes_.push_back(rings_.size());
    rings_.push_back(std::move(ring));
  }

  Planar_domain finish(Read_report& report, std::size_t polygons) {
    Planar_domain domain;
    for (std::size_t hole : holes_) {
      const auto found = hole_points(points_, rings_, hole);
      position_ = ring_lines_[hole];
      if (found.empty())
        fail("no point can be found inside this hole: its ring crosses itself or another one");
      domain.holes.insert(domain.holes.end(), found.begin(), found.end());
    }
    std::set<std::array<std::uint32_t, 2>> seen;
    for (const Point_ring& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
        if (seen.insert({std::min(a, b), std::max(a, b)}).second) domain.segments.push_back({a, b});
      }
    domain.points = std::move(points_);
    report.format = "WKT";
    report.points = domain.points.size();
    report.facets = domain.segments.size();
    report.notes.push_back(fmt::format("{} polygons with {} holes", polygons, holes_.size()));
    return domain;
  }

  /// `(` item `,` item ... `)`
  template <class Item>
  void list(Item item) {
    expect('(');
    item();
    while (peek() == ',') {
      ++position_;
      item();
    }
    expect(')');
  }

  std::uint32_t index(Point<2> p) {
    for (double& x : p) x += 0.0;  // -0 and 0 are one position
    const auto [it, is_new] = index_.try_emplace(p, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return it->second;
  }

  bool at_end() {
    peek();
    return position_ == text_.size();
  }

  /// The next character that is not blank, 0 at the end. Comments run from # to the end of a line.
  char peek() {
    while (position_ < text_.size()) {
      if (text_[position_] == '#')
        position_ = std::min(text_.find('\n', position_), text_.size());
      else if (std::string_view(" \t\r\n").find(text_[position_]) != std::string_view::npos)
        ++position_;
      else
        return text_[position_];
    }
    return 0;
  }

  std::string_view peek_word() {
    peek();
    return text_.substr(position_,
                        std::min(text_.find_first_of(" \t\r\n,();", position_), text_.size()) - position_);
  }

  std::string_view word() {
    const std::string_view w = peek_word();
    position_ += w.size();
    return w;
  }

  double number() {
    const std::string_view w = peek_word();
    const auto value = parse_decimal(w);
    if (!value || !std::isfinite(*value))
      fail(w.empty() ? "a coordinate is missing" : fmt::format("'{}' is not a coordinate", w.substr(0, 40)));
    position_ += w.size();
    return *value;
  }

  void expect(char c) {
    if (peek() != c)
      fail(at_end() ? fmt::format("the text ends where '{}' should be", c)
                    : fmt::format("'{}' where '{}' should be", peek(), c));
    ++position_;
  }

  [[noreturn]] void fail(const std::string& what) {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(position_);
    io::fail(name_, 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n')), what);
  }

  const std::string& name_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::vector<Point<2>> points_;
  std::map<Point<2>, std::uint32_t> index_;
  std::vector<Point_ring> rings_;
  std::vector<std::size_t> holes_, ring_lines_;
};

}  // namespace

Planar_domain parse_wkt(const std::string& name, std::string_view text, Read_report* report) {
  Read_report own;
  Planar_domain domain = Parser(name, text).parse(own);
  if (report) *report = std::move(own);
  return domain;
}

Planar_domain read_wkt(const std::filesystem::path& path, Read_report* report) {
  return parse_wkt(path.string(), load(path), report);
}

}  // namespace cellwalk::io
