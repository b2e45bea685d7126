// SPDX-License-Identifier: LGPL-3.0-or-later
// The zones of vertices in which facets are parted, and the renewal of those that are left.
#include <cellwalk/internal/environment/boundary_index.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cellwalk::detail {
namespace {

/// Rounds the bounds of a ball outwards, with a margin.
constexpr double outwards = 0x1p-50;
/// The zone of a vertex lies ahead of it by this share of the radius of the one before, but at most this
/// number of steps.
constexpr double share_ahead = 0.6, most_steps_ahead = 4;
/// All facets at a vertex are parted from another one at once if that leaves this share of the radius.
constexpr double at_once_share = 0.5;

template <int D>
Box<D> bounds_of(const Zone<D>& zone) {
  Box<D> box{zone.centre, zone.centre};
  if (zone.radius == 0) return box;
  for (std::size_t k = 0; k < D; ++k) {
    const double reach = zone.radius + outwards * (std::abs(zone.centre[k]) + zone.radius);
    box.low[k] -= reach;
    box.high[k] += reach;
  }
  return box;
}

}  // namespace

template <int D>
Box<D> box_of(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  Box<D> box;
  for (const Cell c : cells) {
    const Cell_view<D> view = snapshot.view(c);
    for (std::size_t v = 0; v < view.vertex_count(); ++v) box.extend(view.point(v));
  }
  return box;
}

template <int D>
std::vector<Half_facet> Boundary_index<D>::facets(const Snapshot<D>& snapshot, std::span<const Cell> cells) {
  std::vector<Half_facet> result;
  for (const Cell c : cells)
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i)
      if (const Half_facet f = snapshot.half_facet(c, i); snapshot.neighbour(f) == Cell::none)
        result.push_back(f);
  return result;
}

template <int D>
Boundary_index<D>::Boundary_index(const Snapshot<D>& snapshot) {
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (snapshot.cell(i) != Cell::none) cells.push_back(snapshot.cell(i));
  for (const Half_facet f : facets(snapshot, cells)) add(snapshot, f);
}

template <int D>
void Boundary_index<D>::add(const Snapshot<D>& snapshot, Half_facet name) {
  number_.resize(snapshot.points().size(), none);
  std::uint32_t place = static_cast<std::uint32_t>(facets_.size());
  if (free_.empty()) {
    facets_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  Facet& facet = facets_[place];
  facet.name = name;
  facet.corners.clear();
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(name));
  for (const std::uint16_t v : cell.loop(snapshot.facet_of(name))) {
    const std::uint32_t point = cell.point_index(v);
    facet.corners.push_back(point);
    if (number_[point] == none) {
      number_[point] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.emplace_back();
    }
    Vertex& corner = vertex(point);
    if (corner.facets.empty()) corner.zone = {snapshot.point(point), 0};
    corner.facets.push_back(place);
    corner.is_clear = false;
  }
  facet_of_name_[to_index(name)] = place;
  grid_.set(place, zone_box(facet));
}

template <int D>
void Boundary_index<D>::remove(Half_facet name) {
  const auto entry = facet_of_name_.find(to_index(name));
  const std::uint32_t place = entry->second;
  for (const std::uint32_t point : facets_[place].corners) {
    Names& at = vertex(point).facets;
    at.erase(std::find(at.begin(), at.end(), place));
  }
  grid_.remove(place);
  free_.push_back(place);
  facet_of_name_.erase(entry);
}

template <int D>
void Boundary_index<D>::replace(const Snapshot<D>& snapshot, std::span<const Half_facet> old,
                                std::span<const Half_facet> now) {
  is_way_known_ = false;
  for (const Half_facet f : old) remove(f);
  for (const Half_facet f : now) add(snapshot, f);
  for (const Half_facet f : now) {
    near_.clear();
    grid_.find(grid_.box(facet_of_name_.at(to_index(f))), near_);
    for (const std::uint32_t g : near_) doubt(g);
  }
}

template <int D>
Box<D> Boundary_index<D>::zone_box(const Facet& facet) const {
  Box<D> box;
  for (const std::uint32_t point : facet.corners) box.extend(bounds_of<D>(vertex(point).zone));
  return box;
}

template <int D>
typename Boundary_index<D>::Corners Boundary_index<D>::corners(std::uint32_t facet) const {
  Corners result;
  for (std::size_t k = 0; k < result.size(); ++k) {
    const std::uint32_t point = facets_[facet].corners[k];
    result[k] = {point, vertex(point).zone};
  }
  return result;
}

/// Nothing is certified of the corners of a facet.
template <int D>
void Boundary_index<D>::doubt(std::uint32_t facet) {
  for (const std::uint32_t point : facets_[facet].corners) vertex(point).is_clear = false;
}

template <int D>
std::vector<Half_facet> Boundary_index<D>::meeting(std::span<const Point<D>> points,
                                                   const Box<D>& box) const {
  std::vector<std::uint32_t> found;
  grid_.find(box, found);
  std::vector<Half_facet> result;
  for (const std::uint32_t f : found) {
    Box<D> own;
    for (const std::uint32_t point : facets_[f].corners) own.extend(points[point]);
    if (own.meets(box)) result.push_back(facets_[f].name);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Parts the hulls of two sets of corners, if need be with corners that stay where they are instead of in
/// their zones, and lessens the radius of the way accordingly.
template <int D>
bool Boundary_index<D>::part(std::span<const Point<D>> points, const Zoned_move<D>& move,
                             std::span<const Corner> low, std::span<const Corner> high, bool is_one_facet) {
  double radius = parting_radius<D>(low, high, move, way_.zone.radius, is_one_facet);
  if (radius < 0 && is_one_facet) {
    std::vector<Corner> still_low(low.begin(), low.end()), still_high(high.begin(), high.end());
    for (auto* corners : {&still_low, &still_high})
      for (Corner& c : *corners) c.zone = {points[c.name], 0};
    radius = parting_radius<D>(still_low, still_high, move, way_.zone.radius, true);
    if (radius >= 0)
      for (const auto& corners : {low, high})
        for (const Corner& c : corners)
          if (c.name != move.vertex) way_.shrunk.push_back(c.name);
  }
  if (radius < 0 || (!is_one_facet && radius < at_once_share * way_.zone.radius)) return false;
  way_.zone.radius = std::min(way_.zone.radius, radius);
  return true;
}

/// Parts the facets at a vertex from all others on its way, and within a radius of its end.
/// \param stops if true, the search ends once facets were found that cannot be parted
template <int D>
void Boundary_index<D>::find_way(std::span<const Point<D>> points, const Zoned_move<D>& move, bool stops) {
  way_.point = move.vertex;
  way_.shrunk.clear();
  way_.met.clear();
  const Names& own = vertex(move.vertex).facets;
  boost::container::small_vector<Corner, most_corners> star{{move.vertex, {}}};  // all their corners
  double shortest = std::numeric_limits<double>::infinity();
  Box<D> box;
  bool are_simplices = true;
  for (const std::uint32_t f : own) {
    are_simplices &= is_simplex(f);
    for (const std::uint32_t point : facets_[f].corners) {
      if (std::any_of(star.begin(), star.end(), [&](const Corner& c) { return c.name == point; })) continue;
      const Zone<D>& zone = vertex(point).zone;
      star.push_back({point, zone});
      shortest = std::min(shortest, length(zone.centre - move.to));
      box.extend(bounds_of<D>(zone));
    }
  }
  way_.zone = {move.to, std::isfinite(shortest) ? shortest / 2 : 0};
  box.extend(bounds_of<D>(way_.zone));
  box.extend(move.from);
  near_.clear();
  grid_.find(box, near_);
  boost::container::small_vector<Box<D>, 8> boxes;  // in which facets stay that have the vertex
  for (const std::uint32_t f : own) {
    Box<D>& of_facet = boxes.emplace_back(bounds_of<D>(way_.zone));
    of_facet.extend(move.from);
    for (const std::uint32_t point : facets_[f].corners)
      if (point != move.vertex) of_facet.extend(bounds_of<D>(vertex(point).zone));
  }
  const auto have_common_corner = [&](std::uint32_t f, std::uint32_t g) {
    return std::any_of(facets_[f].corners.begin(), facets_[f].corners.end(), [&](std::uint32_t point) {
      return std::find(facets_[g].corners.begin(), facets_[g].corners.end(), point) !=
             facets_[g].corners.end();
    });
  };

  const auto meets = [&](std::uint32_t f, std::uint32_t g) {
    way_.met.push_back({{f, g}});
    return stops;
  };
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!(are_simplices && part(points, move, corners(own[i]), corners(own[j]), true)) &&
          meets(own[i], own[j]))
        return;
  for (const std::uint32_t g : near_) {
    if (std::find(own.begin(), own.end(), g) != own.end()) continue;
    const Names& of_g = facets_[g].corners;
    const bool has_common_corner = std::any_of(star.begin(), star.end(), [&](const Corner& c) {
      return std::find(of_g.begin(), of_g.end(), c.name) != of_g.end();
    });
    if (!has_common_corner && std::none_of(boxes.begin(), boxes.end(),
                                           [&](const Box<D>& of_own) { return of_own.meets(grid_.box(g)); }))
      continue;
    const bool is_known = are_simplices && is_simplex(g);
    if (is_known && star.size() <= most_corners &&
        part(points, move, {star.data(), star.size()}, corners(g), false))
      continue;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (!boxes[i].meets(grid_.box(g)) && !have_common_corner(own[i], g)) continue;
      if (!(is_known && part(points, move, corners(own[i]), corners(g), true)) && meets(own[i], g)) return;
    }
  }
}

template <int D>
void Boundary_index<D>::set_zone(std::uint32_t point, const Zone<D>& zone) {
  Vertex& v = vertex(point);
  v.zone = zone;
  for (const std::uint32_t f : v.facets) grid_.set(f, zone_box(facets_[f]));
}

template <int D>
bool Boundary_index<D>::is_way_free(std::span<const Point<D>> points, std::uint32_t point,
                                    const Point<D>& target) {
  is_way_known_ = false;
  const Vertex& v = vertex(point);
  if (v.is_clear && v.zone.contains(target)) return true;
  // A vertex that goes on in its direction stays longer in a zone that lies ahead.
  const Point<D>& from = points[point];
  const Vector<D> step = target - from;
  const double ahead = std::min(share_ahead * v.zone.radius, most_steps_ahead * length(step));
  way_.target = target;
  if (ahead > 0) {
    find_way(points, {point, from, target + (ahead / length(step)) * step}, true);
    is_way_known_ = way_.met.empty() && way_.zone.contains(target);
  }
  if (!is_way_known_) {
    find_way(points, {point, from, target}, true);
    is_way_known_ = way_.met.empty();
  }
  return is_way_known_;
}

template <int D>
void Boundary_index<D>::follow(std::span<const Point<D>> points, std::uint32_t point) {
  const Point<D>& position = points[point];
  const bool is_known = is_way_known_ && way_.point == point && way_.target == position;
  is_way_known_ = false;
  if (!is_known) {
    if (vertex(point).zone.contains(position)) return;
    find_way(points, {point, position, position}, false);
  }
  for (const std::uint32_t p : way_.shrunk) set_zone(p, {points[p], 0});
  set_zone(point, way_.zone);
  vertex(point).is_clear = true;
  for (const auto& [f, g] : way_.met) doubt(f), doubt(g);
}

template Box<2> box_of<2>(const Snapshot<2>&, std::span<const Cell>);
template Box<3> box_of<3>(const Snapshot<3>&, std::span<const Cell>);
template class Boundary_index<2>;
template class Boundary_index<3>;

}  // namespace cellwalk::detail
