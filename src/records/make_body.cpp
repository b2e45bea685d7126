// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons cut into triangles, their edges without repetition, and unused points dropped.
#include <cellwalk/kernel/error.h>
#include <cellwalk/records/body_soup.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace cellwalk {
namespace {

using Edge = std::array<std::uint32_t, 2>;
using Triangle = std::array<std::uint32_t, 3>;

template <int D>
void check(const Body_parts<D>& parts) {
  const auto refuse = [](const std::string& what) { throw Error(Error_code::input, "body: " + what); };
  const std::size_t n = parts.points.size();
  if (n > std::numeric_limits<std::uint32_t>::max())
    refuse(fmt::format("{} points: more than indices of 32 bits can name", n));
  for (std::size_t i = 0; i < n; ++i)
    if (!is_finite(parts.points[i])) refuse(fmt::format("point {} has a coordinate that is not finite", i));
  const auto check_indices = [&](const char* kind, std::size_t i, std::span<const std::uint32_t> indices) {
    for (std::uint32_t v : indices)
      if (v >= n) refuse(fmt::format("{} {} names point {}, of {}", kind, i, v, n));
  };
  for (std::size_t i = 0; i < parts.polygons.size(); ++i) check_indices("polygon", i, parts.polygons[i]);
  for (std::size_t i = 0; i < parts.segments.size(); ++i) check_indices("segment", i, parts.segments[i]);
  if (!parts.radii.empty() && parts.radii.size() != parts.segments.size())
    refuse(fmt::format("{} radii for {} segments: give one for each, or none", parts.radii.size(),
                       parts.segments.size()));
  for (std::size_t i = 0; i < parts.radii.size(); ++i)
    if (!(parts.radii[i] >= 0 && std::isfinite(parts.radii[i])))
      refuse(fmt::format("the radius of segment {} takes a finite number of at least 0, not {}", i,
                         parts.radii[i]));
}

/// The radii of edges in ascending order; none if all are 0.
std::vector<double> radii_of(const std::vector<Edge>& edges, const std::vector<Edge>& segments,
                             const std::vector<double>& given) {
  if (std::ranges::all_of(given, [](double r) { return r == 0; })) return {};
  std::vector<double> radii(edges.size(), 0.0);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Edge edge{std::min(segments[i][0], segments[i][1]), std::max(segments[i][0], segments[i][1])};
    if (edge[0] == edge[1]) continue;
    double& radius = radii[static_cast<std::size_t>(std::ranges::lower_bound(edges, edge) - edges.begin())];
    radius = std::max(radius, given[i]);
  }
  return radii;
}

/// Collects the parts of a body.
template <int D>
class Maker {
 public:
  void segment(std::uint32_t a, std::uint32_t b) {
    if (a == b)
      ++made_.null_edges;
    else
      edges_.push_back({std::min(a, b), std::max(a, b)});
  }

  void polygon(const std::vector<std::uint32_t>& loop) {
    const std::size_t n = loop.size();
    if (n == 2) segment(loop[0], loop[1]);
    if (n < 3) return;
    for (std::size_t i = 0; i < n; ++i) segment(loop[i], loop[(i + 1) % n]);
    if (D == 2) return;
    if (n > 3) ++made_.cut_polygons;
    const auto first = static_cast<std::size_t>(std::min_element(loop.begin(), loop.end()) - loop.begin());
    const auto corner = [&](std::size_t i) { return loop[(first + i) % n]; };
    for (std::size_t i = 1; i + 1 < n; ++i) triangle({corner(0), corner(i), corner(i + 1)});
  }

  Made_body<D> result(std::vector<Point<D>> points) {
    drop_repeated_faces();
    for (const Triangle& t : made_.body.faces)
      for (std::size_t i = 0; i < 3; ++i) segment(t[i], t[(i + 1) % 3]);
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    std::vector<bool> used(points.size());
    for (const Edge& e : edges_) used[e[0]] = used[e[1]] = true;
    made_.unused_points = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    made_.body.edges = std::move(edges_);
    made_.body.points = std::move(points);
    return std::move(made_);
  }

 private:
  void triangle(const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      ++made_.degenerate_faces;
    else
      made_.body.faces.push_back(t);
  }

  /// Keeps the first of triangles with the same corners.
  void drop_repeated_faces() {
    std::vector<Triangle>& faces = made_.body.faces;
    std::vector<std::pair<Triangle, std::size_t>> sorted;  // corners in order, position
    sorted.reserve(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      Triangle t = faces[i];
      std::sort(t.begin(), t.end());
      sorted.emplace_back(t, i);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> repeated(faces.size());
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first) repeated[sorted[i].second] = true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (!repeated[i]) faces[kept++] = faces[i];
    made_.repeated_faces = faces.size() - kept;
    faces.resize(kept);
  }

  Made_body<D> made_;
  std::vector<Edge> edges_;
};

}  // namespace

template <int D>
Made_body<D> make_body(Body_parts<D> parts) {
  check(parts);
  Maker<D> maker;
  for (const auto& loop : parts.polygons) maker.polygon(loop);
  for (const Edge& s : parts.segments) maker.segment(s[0], s[1]);
  Made_body<D> made = maker.result(std::move(parts.points));
  made.body.radii = radii_of(made.body.edges, parts.segments, parts.radii);
  return made;
}

template Made_body<2> make_body(Body_parts<2>);
template Made_body<3> make_body(Body_parts<3>);

}  // namespace cellwalk
