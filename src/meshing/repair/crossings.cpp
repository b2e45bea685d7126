// SPDX-License-Identifier: GPL-3.0-or-later
// Constrained triangulations of the triangles that cross, with exact constructions.
#include "crossings.h"

#include <CGAL/intersections.h>
#include <boost/variant.hpp>

#include <algorithm>
#include <deque>
#include <map>
#include <unordered_map>
#include <variant>

#include "cut_plane.h"
#include "edges.h"
#include "near_points.h"
#include "sides.h"

namespace cellwalk::detail {
namespace {

using E = Exact_kernel;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr int most_rounds = 12, most_passes = 12;
/// Later rounds have far fewer pairs than the first one, unless rounded parts cross more and more.
constexpr std::size_t most_growth = 4;
/// Corners are in a plane within this part of the distance at which points are joined, so that the points in
/// which two triangles see the same place become one.
constexpr double part_of_joined = 0.01;

/// Results of CGAL::intersection: boost's variants up to CGAL 5, those of the standard from 6 on.
template <class Visitor, class... T>
void visit_found(const Visitor& visitor, const boost::variant<T...>& value) {
  boost::apply_visitor(visitor, value);
}
template <class Visitor, class... T>
void visit_found(const Visitor& visitor, const std::variant<T...>& value) {
  std::visit(visitor, value);
}

/// The traces of an intersection.
struct Collect {
  using result_type = void;
  std::vector<Trace>* traces;

  void operator()(const E::Point_3& p) const { traces->push_back({p, p}); }
  void operator()(const E::Segment_3& s) const { traces->push_back({s.source(), s.target()}); }
  void operator()(const E::Triangle_3& t) const {
    for (int i = 0; i < 3; ++i) traces->push_back({t[i], t[(i + 1) % 3]});
  }
  void operator()(const std::vector<E::Point_3>& loop) const {
    for (std::size_t i = 0; i < loop.size(); ++i) traces->push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
};

double round(const E::FT& x) { return CGAL::to_double(CGAL::exact(x)); }  // equal numbers alike

/// One round of cuts.
class Round {
 public:
  /// \param apart corners nearer to the plane of another triangle are in it: pairs in a plane up to rounding
  ///        are cut as such, and do not cross again in each round
  Round(Facets& surface, double apart) : surface_(surface), apart_(apart) {
    for (std::uint32_t v = 0; v < surface.points.size(); ++v) number_.insert({surface.points[v], v});
  }

  void cut(const Pairs& pairs) {
    make_planes(pairs);
    for (const auto& [f, g] : pairs) {
      if (planes_of_.at(f).plane == planes_of_.at(g).plane) continue;  // their sides cut both
      const E::Triangle_3 s = exact(f), t = exact(g);
      Cut_plane &at_f = plane(f), &at_g = plane(g);
      insert(CGAL::intersection(s, at_f.snapped(t, apart_)), at_f);
      insert(CGAL::intersection(at_g.snapped(s, apart_), t), at_g);
    }
    cut_neighbours();
    std::vector<Facet> result;
    const auto number = [this](const E::Point_3& p) {
      return point({round(p.x()), round(p.y()), round(p.z())});
    };
    for (std::uint32_t f = 0; f < surface_.facets.size(); ++f) {
      const Facet& facet = surface_.facets[f];
      const auto at = planes_of_.find(f);
      if (at == planes_of_.end()) {
        result.push_back(facet);
        continue;
      }
      for (const Triangle& part : planes_[at->second.plane].parts(at->second.member, number))
        result.push_back({part, facet.part, facet.number});
    }
    surface_.facets = std::move(result);
  }

 private:
  static E::Point_3 exact(const Point<3>& p) { return {p[0], p[1], p[2]}; }
  E::Triangle_3 exact(std::uint32_t f) const {
    const Facet& t = surface_.facets[f];
    return {exact(surface_.corner(t, 0)), exact(surface_.corner(t, 1)), exact(surface_.corner(t, 2))};
  }
  Side side(std::uint32_t f, int k) const {
    const Triangle& t = surface_.facets[f].corners;
    return std::minmax({t[k], t[(k + 1) % 3]});
  }

  /// Where a facet is.
  struct Place {
    std::size_t plane, member;
  };

  void add_to(std::size_t plane, std::uint32_t f) {
    planes_of_.insert({f, {plane, planes_[plane].add(exact(f), surface_.facets[f].corners)}});
  }
  void add_alone(std::uint32_t f) {
    planes_.emplace_back(exact(f));
    add_to(planes_.size() - 1, f);
  }
  Cut_plane& plane(std::uint32_t f) {
    if (!planes_of_.contains(f)) add_alone(f);
    return planes_[planes_of_.at(f).plane];
  }

  /// Pairs that lie in a plane, each in that of the other, share it: that of the largest triangle.
  void make_planes(const Pairs& pairs) {
    Joined_sets sets(surface_.facets.size());
    for (const auto& [f, g] : pairs) {
      const E::Triangle_3 s = exact(f), t = exact(g);
      if (Cut_plane(s).contains(t, apart_) && Cut_plane(t).contains(s, apart_)) sets.join(f, g);
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> together;
    for (const auto& [f, g] : pairs)
      for (const std::uint32_t facet : {f, g}) together[sets.find(facet)].push_back(facet);
    for (auto& [root, facets] : together) {
      std::sort(facets.begin(), facets.end());
      facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
      const std::uint32_t largest =
          *std::max_element(facets.begin(), facets.end(), [&](std::uint32_t f, std::uint32_t g) {
            return area(surface_, surface_.facets[f]) < area(surface_, surface_.facets[g]);
          });
      const std::size_t own = planes_.size();
      add_alone(largest);
      for (const std::uint32_t f : facets) {
        if (f == largest) continue;
        if (planes_[own].contains(exact(f), apart_))
          add_to(own, f);
        else
          add_alone(f);
      }
    }
  }

  template <class Found>
  static void insert(const Found& found, Cut_plane& plane) {
    if (!found) return;
    std::vector<Trace> traces;
    visit_found(Collect{&traces}, *found);
    for (const Trace& trace : traces) plane.insert(trace);
  }

  /// Points on sides belong to all triangles with that side.
  void cut_neighbours() {
    std::map<Side, std::vector<E::Point_3>> points;
    for (const auto& [f, place] : planes_of_)
      for (int k = 0; k < 3; ++k)
        for (const E::Point_3& p : planes_[place.plane].points_on_side(place.member, k))
          points[side(f, k)].push_back(p);
    for (std::uint32_t f = 0; f < surface_.facets.size() && !points.empty(); ++f)
      for (int k = 0; k < 3; ++k)
        if (const auto at = points.find(side(f, k)); at != points.end())
          for (const E::Point_3& p : at->second) plane(f).insert({p, p});
  }

  std::uint32_t point(const Point<3>& p) {
    const auto [at, is_new] = number_.insert({p, static_cast<std::uint32_t>(surface_.points.size())});
    if (is_new) surface_.points.push_back(p);
    return at->second;
  }

  Facets& surface_;
  double apart_;
  std::map<Point<3>, std::uint32_t> number_;
  std::deque<Cut_plane> planes_;
  std::map<std::uint32_t, Place> planes_of_;
};

/// Makes corners that lie on the side of another triangle, up to rounding, corners of all triangles with that
/// side: seen from one of them they may lie inside, from the next one outside, so that neither is cut there.
/// \param first_made points from this one on were made by cuts
void split_sides_near_cuts(Facets& surface, const Pairs& pairs, std::size_t first_made, double apart) {
  std::vector<bool> is_near(surface.points.size(), false), is_used(surface.points.size(), false);
  std::fill(is_near.begin() + static_cast<std::ptrdiff_t>(first_made), is_near.end(), true);
  for (const auto& [f, g] : pairs)
    for (const std::uint32_t facet : {f, g})
      for (const std::uint32_t v : surface.facets[facet].corners) is_near[v] = true;
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<Side> sides;
    std::vector<bool> is_near_now = is_near;
    for (const Facet& f : surface.facets) {
      const Triangle& t = f.corners;
      for (const std::uint32_t v : t) is_used[v] = true;
      if (!is_near[t[0]] && !is_near[t[1]] && !is_near[t[2]]) continue;
      for (int k = 0; k < 3; ++k) {  // of slivers, the longest side, too
        sides.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
        is_near_now[t[k]] = true;
      }
    }
    is_near = is_near_now;
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    std::vector<std::uint32_t> points;
    for (std::uint32_t v = 0; v < is_used.size(); ++v)
      if (is_used[v]) points.push_back(v);
    if (split_sides(surface, sides, points, apart).count == 0) return;
  }
}

}  // namespace

Cut cut_crossings(Facets& surface, Pairs pairs, double joined_within, const std::function<void()>& between) {
  Cut result;
  for (const auto& [f, g] : pairs) result.pairs.add(centre(surface, surface.facets[f]));
  const std::size_t points = surface.points.size();
  std::size_t facets_after_one = 0;
  const double apart = part_of_joined * joined_within;
  const auto leave_out = [&] {
    leave_out_collinear(surface);
    keep_one_in_each_place(surface);
    pairs = crossing_pairs(surface);
  };
  for (;;) {
    // The first round comes before: the sides of the file are split only where that does not suffice.
    if (result.rounds > 0) {
      split_sides_near_cuts(surface, pairs, points, apart);
      leave_out();
    }
    if (pairs.empty()) break;
    if (result.rounds == 1) facets_after_one = surface.facets.size();
    const bool explodes = pairs.size() > most_growth * result.pairs.count + most_rounds ||
                          (result.rounds > 1 && surface.facets.size() > 2 * most_growth * facets_after_one);
    if (explodes || result.rounds++ == most_rounds)
      throw Still_crossing(fmt::format(
          "surface crosses itself: {} still cross after {} rounds of cuts, the first at {}; "
          "repair it there",
          counted(pairs.size(), "pair of facets", "pairs of facets"), std::min(result.rounds, most_rounds),
          describe(centre(surface, surface.facets[pairs[0].first]))));
    between();
    Round(surface, apart).cut(pairs);
    const Found joined = weld(surface, joined_within, false);
    result.joined.add(joined);
    leave_out();
  }
  result.added_points = surface.points.size() - points;
  return result;
}

}  // namespace cellwalk::detail
