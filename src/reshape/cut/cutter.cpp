// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells labelled by sides of the blade, edges split, and vertices parted one after the other.
#include "cutter.h"

#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "simplices.h"

namespace cellwalk::detail {
namespace {

/// The number of times that the way of a parted vertex is halved where there is no room.
constexpr int most_halvings = 24;
/// A blade so near, in half sides of the frame of planes, needs no look at all points.
constexpr double near_enough = 0x1p18;
/// Steps towards a direction that is inside of all facets.
constexpr int most_turns = 200;

}  // namespace

template <int D>
void Cutter<D>::check_reach() const {
  // All points lie in the frame, whose half side is less than twice the size of the environment.
  const Plane_frame<D>& frame = snapshot().frame();
  const double reach = near_enough / frame.scale;
  bool is_near = true;
  for (std::size_t k = 0; k < D; ++k)
    is_near = is_near && std::abs(blade_.box().low[k] - frame.centre[k]) <= reach &&
              std::abs(blade_.box().high[k] - frame.centre[k]) <= reach;
  if (is_near) return;
  const auto points = snapshot().points();
  Box<D> box;
  for (std::uint32_t p = 0; p < points.size(); ++p)
    if (snapshot().is_point(p)) box.extend(points[p]);
  blade_.check_reach(box);
}

template <int D>
std::vector<Cell> Cutter<D>::near_cells() const {
  const Snapshot<D>& s = snapshot();
  std::vector<Cell> near = s.tissue_boxes().find(s, [&](const Box<D>& box) { return blade_.may_pass(box); });
  std::erase_if(near, [&](Cell c) { return !s.is_solid(c) || s.view(c).vertex_count() != D + 1; });
  return near;
}

/// Which vertices the cut passes, and which edges are to be split.
template <int D>
void Cutter<D>::label(std::span<const Cell> near) {
  const Snapshot<D>& s = snapshot();
  std::map<std::uint32_t, bool> looked_at;  // vertices: whether the blade has them
  std::map<std::array<std::uint32_t, 2>, std::optional<double>> shares;
  for (const Cell c : near) {
    const auto vertices = s.view(c).vertices;
    bool is_met = false;
    for (const std::uint32_t u : vertices) {
      const auto [own, is_new] = looked_at.try_emplace(u, false);
      if (is_new) own->second = blade_.has(s.point(u));
      if (own->second) sides_[u] = Side::on;
      is_met |= own->second;
      for (const std::uint32_t v : vertices) {
        if (u >= v) continue;
        const auto [pair, is_new_pair] = shares.try_emplace({u, v});
        if (is_new_pair) pair->second = blade_.passes(s.point(u), s.point(v));
        is_met |= pair->second.has_value();
      }
    }
    report_.cells += is_met;
  }
  std::map<std::array<std::uint32_t, 2>, double> passed;
  for (const auto& [pair, share] : shares)
    if (share) passed[pair] = *share;
  report_.edges += passed.size();
  for (const auto& [edge, share] : passed)
    if (share < options_.snap || share > 1 - options_.snap) sides_[edge[share < 0.5 ? 0 : 1]] = Side::on;
  const auto is_on = [&](std::uint32_t v) {
    const auto side = sides_.find(v);
    return side != sides_.end() && side->second == Side::on;
  };
  for (const auto& [edge, share] : passed) {
    if (is_on(edge[0]) || is_on(edge[1]))
      ++report_.snapped;
    else
      edges_[edge] = share;
  }
}

template <int D>
bool Cutter<D>::split_edge(std::uint32_t u, std::uint32_t v, double share) {
  const Point<D> middle = point_on<D>(snapshot().point(u), snapshot().point(v), share);
  const auto point = splitter_.split_edge(u, v, middle, Splitter<D>::Walls::retreat);
  if (!point) return false;
  sides_[*point] = Side::on;
  report_.points.push_back({*point, {u, v}, share});
  return true;
}

template <int D>
void Cutter<D>::split() {
  for (const auto& [edge, share] : edges_) report_.split += split_edge(edge[0], edge[1], share);
}

template <int D>
typename Cutter<D>::Side Cutter<D>::side_of(std::uint32_t vertex) {
  const auto [side, is_new] = sides_.try_emplace(vertex, Side::back);
  if (is_new && blade_.side(snapshot().point(vertex)) > 0) side->second = Side::front;
  return side->second;
}

/// The side of all vertices of a cell that the cut does not pass; Side::on if these lie on both. A cell all
/// of whose vertices it passes lies behind it.
template <int D>
typename Cutter<D>::Side Cutter<D>::side_of(Cell cell) {
  bool is_front = false, is_back = false;
  for (const std::uint32_t v : snapshot().view(cell).vertices) {
    const Side side = side_of(v);
    is_front |= side == Side::front;
    is_back |= side == Side::back;
  }
  if (is_front && is_back) return Side::on;
  return is_front ? Side::front : Side::back;
}

template <int D>
typename Cutter<D>::Key Cutter<D>::key_of(Half_facet facet) const {
  const auto loop = snapshot().loop(facet);
  Key key;
  std::copy_n(loop.begin(), key.size(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/// Facets between solid cells on either side, all of whose vertices the cut passes.
template <int D>
void Cutter<D>::find_facets() {
  const Snapshot<D>& s = snapshot();
  std::vector<std::uint32_t> on;
  for (const auto& [vertex, side] : sides_)
    if (side == Side::on) on.push_back(vertex);
  for (const std::uint32_t vertex : on)
    for (const Cell c : environment_.cells_around(vertex)) {
      const Cell_view<D> view = s.view(c);
      if (!s.is_solid(c) || view.vertex_count() != D + 1 || side_of(c) != Side::front) continue;
      for (std::size_t f = 0; f < view.facet_count(); ++f) {
        const Half_facet facet = Snapshot<D>::half_facet(c, f);
        const Cell other = s.neighbour(facet);
        const auto loop = s.loop(facet);
        if (other != Cell::none && s.is_solid(other) && s.view(other).vertex_count() == D + 1 &&
            std::all_of(loop.begin(), loop.end(), [&](std::uint32_t v) { return side_of(v) == Side::on; }) &&
            side_of(other) == Side::back)
          facets_.insert(key_of(facet));
      }
    }
  report_.facets = facets_.size();
}

/// Solid cells around a vertex that hang together through facets at it which are not of the cut.
template <int D>
std::vector<std::vector<Cell>> Cutter<D>::solid_parts(std::uint32_t vertex) {
  const Snapshot<D>& s = snapshot();
  std::vector<Cell> left = environment_.cells_around(vertex);
  std::erase_if(left, [&](Cell c) { return !s.is_solid(c); });
  std::sort(left.begin(), left.end());
  std::vector<std::vector<Cell>> parts;
  while (!left.empty()) {
    std::vector<Cell>& part = parts.emplace_back(1, left.front());
    left.erase(left.begin());
    for (std::size_t next = 0; next < part.size(); ++next) {
      const Cell_view<D> view = s.view(part[next]);
      for (std::size_t f = 0; f < view.facet_count(); ++f) {
        const Half_facet facet = Snapshot<D>::half_facet(part[next], f);
        const auto other = std::ranges::find(left, s.neighbour(facet));
        if (other == left.end() || !has_point(view, f, vertex)) continue;
        if (view.vertex_count() == D + 1 && facets_.contains(key_of(facet))) continue;
        part.push_back(*other);
        left.erase(other);
      }
    }
  }
  return parts;
}

template <int D>
bool Cutter<D>::is_held(std::uint32_t vertex) {
  const Snapshot<D>& s = snapshot();
  for (const Cell c : environment_.cells_around(vertex)) {
    const Cell_view<D> view = s.view(c);
    for (std::size_t f = 0; f < view.facet_count(); ++f)
      if (has_point(view, f, vertex) && s.neighbour(Snapshot<D>::half_facet(c, f)) == Cell::none) return true;
  }
  return false;
}

/// A direction into some solid cells from a vertex, away from all their facets to others; zero if none is
/// found.
template <int D>
Vector<D> Cutter<D>::direction(std::uint32_t vertex, std::span<const Cell> solid) const {
  const Snapshot<D>& s = snapshot();
  std::vector<Vector<D>> normals;
  for (const Cell c : solid) {
    const Cell_view<D> view = s.view(c);
    for (std::size_t f = 0; f < view.facet_count(); ++f) {
      const Half_facet facet = Snapshot<D>::half_facet(c, f);
      if (has_point(view, f, vertex) && std::ranges::find(solid, s.neighbour(facet)) == solid.end())
        normals.push_back(inward_normal(s, facet));
    }
  }
  Vector<D> sum{};
  for (const Vector<D>& n : normals) sum = sum + n;
  for (int turn = 0; turn < most_turns; ++turn) {
    const Vector<D> unit = normalized(sum, Vector<D>{});
    const auto worst =
        std::ranges::min_element(normals, {}, [&](const Vector<D>& n) { return dot(n, unit); });
    constexpr double steep_enough = 0.2;
    if (worst == normals.end() || dot(*worst, unit) > steep_enough) return unit;
    sum = sum + *worst;
  }
  const Vector<D> unit = normalized(sum, Vector<D>{});
  const bool is_inside = std::ranges::all_of(normals, [&](const Vector<D>& n) { return dot(n, unit) > 0; });
  return is_inside ? unit : Vector<D>{};
}

/// The longest edge at a vertex of simplices, rounded.
template <int D>
double Cutter<D>::longest_edge(std::uint32_t vertex, std::span<const Cell> cells) const {
  double longest = 0;
  for (const Cell c : cells)
    for (const std::uint32_t v : snapshot().view(c).vertices)
      longest = std::max(longest, length(snapshot().point(v) - snapshot().point(vertex)));
  return longest;
}

template <int D>
void Cutter<D>::part(std::uint32_t vertex) {
  const auto parts = solid_parts(vertex);
  const bool has_back = std::ranges::any_of(parts, [&](const auto& part) {
    return std::ranges::any_of(part, [&](Cell c) { return side_of(c) != Side::front; });
  });
  bool is_parted = false, is_tried = false;
  for (const std::vector<Cell>& part : parts) {
    if (!std::ranges::all_of(part, [&](Cell c) { return side_of(c) == Side::front; })) continue;
    if (!has_back) continue;
    is_tried = true;
    if (!std::ranges::all_of(part, [&](Cell c) { return snapshot().view(c).vertex_count() == D + 1; }))
      continue;
    const Vector<D> into = direction(vertex, part);
    if (into == Vector<D>{}) continue;
    const Point<D> from = snapshot().point(vertex);
    // No way that stays inside of simplices at the vertex is longer than their edges.
    double way = options_.opening;
    for (const double longest = longest_edge(vertex, part); way > longest;) way /= 2;
    std::string reason;
    for (int k = 0; k < most_halvings; ++k) {
      const auto point = splitter_.split_vertex(vertex, part, from + std::ldexp(way, -k) * into, reason);
      if (!point) continue;
      sides_[*point] = Side::front;
      report_.points.push_back({*point, {vertex, vertex}, 0});
      is_parted = true;
      break;
    }
  }
  if (is_parted)
    ++report_.opened;
  else
    ++(is_tried ? report_.held : report_.rim);
}

template <int D>
void Cutter<D>::part() {
  std::set<std::uint32_t> vertices;
  for (const Key& key : facets_) vertices.insert(key.begin(), key.end());
  for (const std::uint32_t vertex : vertices) {
    if (is_held(vertex))
      ++report_.rim;
    else
      part(vertex);
  }
}

template <int D>
void Cutter<D>::prepare() {
  check_reach();
  label(near_cells());
  for (const auto& [edge, share] : edges_) splitter_.open_groups(edge[0], edge[1]);
}

template <int D>
Cut_report Cutter<D>::run(Cut_report before) {
  report_ = std::move(before);
  sides_.clear();
  edges_.clear();
  label(near_cells());
  split();
  find_facets();
  part();
  return std::move(report_);
}

template class Cutter<2>;
template class Cutter<3>;

}  // namespace cellwalk::detail
