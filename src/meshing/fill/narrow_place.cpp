// SPDX-License-Identifier: GPL-3.0-or-later
// The search for near features at growing distances, with a limit of pairs.
#include "narrow_place.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "narrow_distance.h"
#include "scale.h"

namespace cellwalk::detail {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
using Corners = std::array<std::size_t, 3>;

/// Features are near if their distance is below this part of the size: ten times TetGen's tolerance. Where
/// none are, the search goes on with the next part.
constexpr std::array<double, 3> near{1e-7, 1e-4, 1e-1};
/// Pairs of features that are compared, at most: two seconds. More of them are near each other only where a
/// fine part lies beside something very large.
constexpr std::size_t most_pairs = 2'000'000;
/// A second place is worth a word if it is narrower than the first by this factor.
constexpr double much = 0.5;

struct Enough {};

/// All surfaces in one, with coordinates below 1.
class Search {
 public:
  explicit Search(const std::vector<Surface_soup>& surfaces) : exponent_(exponent_of(surfaces)) {
    for (const Surface_soup& s : surfaces) {
      const std::size_t first = points_.size();
      for (const Point<3>& p : s.points) points_.push_back(scaled(p, -exponent_));
      for (const auto& f : s.facets) facets_.push_back({first + f[0], first + f[1], first + f[2]});
    }
    Point<3> low = points_[0], high = low;
    for (const Point<3>& p : points_)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    size_ = apart(low, high);
  }

  std::vector<Narrow_place> run() {
    Narrow_place vertices = shortest_edge();
    std::vector<Narrow_place> places;
    for (const double part : near) {
      const double reach = part * size_;
      nearer_vertices(vertices, std::min(reach, vertices.distance));
      if (vertices.distance < reach) places.push_back(vertices);
      const auto facets = nearest_facets(std::min(reach, vertices.distance));
      if (facets && (places.empty() || facets->distance < much * vertices.distance))
        places.push_back(*facets);
      if (!places.empty()) break;
    }
    if (places.empty()) {
      const Narrow_place fold = sharpest_fold();
      places.push_back(fold.distance < vertices.distance ? fold : vertices);
    }
    for (Narrow_place& place : places) {
      place.distance /= size_;
      place.at = scaled(place.at, exponent_);
    }
    return places;
  }

 private:
  Triangle_corners corners(std::size_t f) const {
    return {points_[facets_[f][0]], points_[facets_[f][1]], points_[facets_[f][2]]};
  }
  void count_pair() {
    if (++pairs_ > most_pairs) throw Enough{};
  }

  Narrow_place shortest_edge() const {
    Narrow_place best;
    best.distance = std::numeric_limits<double>::infinity();
    for (const Corners& f : facets_)
      for (std::size_t k = 0; k < 3; ++k) take_if_nearer(best, f[k], f[(k + 1) % 3]);
    return best;
  }

  void take_if_nearer(Narrow_place& best, std::size_t a, std::size_t b) const {
    if (const double d = apart(points_[a], points_[b]); d < best.distance)
      best = {true, {std::min(a, b), std::max(a, b)}, 0, d, points_[std::min(a, b)]};
  }

  /// Boxes that meet where their contents may be nearer than `reach`.
  template <class Corner_list>
  Box box(const Corner_list& corners, double reach, std::size_t info) const {
    CGAL::Bbox_3 b;
    for (const Point<3>& p : corners)
      b += CGAL::Bbox_3(p[0] - reach, p[1] - reach, p[2] - reach, p[0] + reach, p[1] + reach, p[2] + reach);
    return {b, info};
  }

  template <class Visit>
  void for_each_pair(std::vector<Box> boxes, const Visit& visit) {
    pairs_ = 0;
    try {
      CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        count_pair();
        visit(std::min(a.info(), b.info()), std::max(a.info(), b.info()));
      });
    } catch (const Enough&) {
    }
  }

  void nearer_vertices(Narrow_place& best, double reach) {
    std::vector<Box> boxes;
    for (std::size_t v = 0; v < points_.size(); ++v)
      boxes.push_back(box(std::array<Point<3>, 1>{points_[v]}, reach / 2, v));
    for_each_pair(std::move(boxes), [&](std::size_t a, std::size_t b) { take_if_nearer(best, a, b); });
  }

  /// The two nearest facets without a common edge that are nearer than `reach`.
  std::optional<Narrow_place> nearest_facets(double reach) {
    std::vector<Box> boxes;
    for (std::size_t f = 0; f < facets_.size(); ++f) boxes.push_back(box(corners(f), reach / 2, f));
    std::optional<Narrow_place> best;
    for_each_pair(std::move(boxes), [&](std::size_t f, std::size_t g) {
      const Near_triangles found = distance(f, g);
      if (found.common_corners < 2 && found.distance < (best ? best->distance : reach))
        best = Narrow_place{false, {f, g}, found.common_corners, found.distance, found.at};
    });
    return best;
  }

  Near_triangles distance(std::size_t f, std::size_t g) const {
    return distance_of(corners(f), corners(g), facets_[f], facets_[g]);
  }

  /// The two facets with a common edge of which a corner of one is nearest to the other.
  Narrow_place sharpest_fold() const {
    struct Side {
      std::array<std::size_t, 2> edge;
      std::size_t facet;
    };
    std::vector<Side> sides;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(facets_[f][k], facets_[f][(k + 1) % 3]);
        sides.push_back({{low, high}, f});
      }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.edge, a.facet) < std::tie(b.edge, b.facet);
    });
    Narrow_place best;
    best.distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].edge != sides[i + 1].edge) continue;
      const std::size_t f = sides[i].facet, g = sides[i + 1].facet;
      if (const Near_triangles found = distance(f, g); found.distance < best.distance)
        best = {false, {f, g}, found.common_corners, found.distance, found.at};
    }
    return best;
  }

  int exponent_;
  std::vector<Point<3>> points_;
  std::vector<Corners> facets_;
  double size_ = 0;
  std::size_t pairs_ = 0;
};

}  // namespace

std::vector<Narrow_place> narrow_places(const std::vector<Surface_soup>& surfaces) {
  return Search(surfaces).run();
}

std::string describe(const Point<3>& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]); }

std::string describe(const std::vector<Narrow_place>& places, const Feature_names& names) {
  constexpr double least = 1e-150;  // whose square is a double
  std::string text;
  for (const Narrow_place& place : places) {
    const auto [a, b] = place.features;
    const std::string distance =
        place.distance < least ? "less than 1e-150" : fmt::format("{:.3g}", place.distance);
    const char* how = place.common_corners == 0   ? ""
                      : place.common_corners == 1 ? ", with a common corner,"
                                                  : ", with a common edge,";
    text += fmt::format("{}{}{} are {} of the size apart, at {}", text.empty() ? "" : "; ",
                        place.are_vertices ? names.vertices(a, b) : names.facets(a, b), how, distance,
                        describe(place.at));
  }
  return text;
}

}  // namespace cellwalk::detail
