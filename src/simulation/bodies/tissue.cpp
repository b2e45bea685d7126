// SPDX-License-Identifier: LGPL-3.0-or-later
// Constraints of edge lengths and volumes, projected in turn, and points that follow.
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/records/scene_shape.h>
#include <cellwalk/internal/simulation/tissue.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "contact_yield.h"
#include "neighbour_lists.h"
#include "simulation/traces/check_motion.h"

namespace cellwalk {
namespace {

/// A move that is a smaller share of the environment's diagonal is left for later.
constexpr double least_share_of_move = 0x1p-22;
/// The number of sweeps in which points between free cells go to the mean of the moves around them.
constexpr int follower_sweeps = 8;

/// D! times the volume of a simplex, and how it grows with each of its corners.
double volume(const std::array<Point<2>, 3>& x, std::array<Vector<2>, 3>& gradients) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector<2> across = x[(k + 2) % 3] - x[(k + 1) % 3];
    gradients[k] = {-across[1], across[0]};
  }
  return dot(gradients[0], x[0] - x[1]);
}

double volume(const std::array<Point<3>, 4>& x, std::array<Vector<3>, 4>& gradients) {
  const Vector<3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  gradients[1] = cross(b, c);
  gradients[2] = cross(c, a);
  gradients[3] = cross(a, b);
  gradients[0] = -1.0 * (gradients[1] + gradients[2] + gradients[3]);
  return dot(a, gradients[1]);
}

void check(bool holds, const char* what) {
  if (!holds) throw Error(Error_code::usage, std::string("tissue: the ") + what);
}

const Tissue_material& checked(const Tissue_material& material) {
  const auto is_share = [](double x) { return 0 <= x && x <= 1; };
  check(material.compliance >= 0 && std::isfinite(material.compliance),
        "compliance must be a finite number of at least 0");
  check(is_share(material.incompressible), "share \"incompressible\" must lie in [0,1]");
  check(0 <= material.tension && material.tension < 1, "tension must be at least 0 and less than 1");
  check(is_share(material.damping), "damping must lie in [0,1]");
  check(is_share(material.yield), "yield must lie in [0,1]");
  check(material.sweeps > 0, "sweeps must be at least 1");
  return material;
}

template <int D>
std::array<std::uint32_t, static_cast<std::size_t>(D) + 1> corners_of(const Cell_view<D>& cell) {
  std::array<std::uint32_t, static_cast<std::size_t>(D) + 1> corners;
  for (std::size_t v = 0; v < corners.size(); ++v) corners[v] = cell.point_index(v);
  return corners;
}

}  // namespace

template <int D>
Tissue<D>::Tissue(const Snapshot<D>& snapshot, const Tissue_material& material,
                  std::span<const Scene_shape<D>> fixed)
    : snapshot_(&snapshot),
      material_(checked(material)),
      fixed_(fixed.begin(), fixed.end()),
      rest_(snapshot.points().begin(), snapshot.points().end()),
      before_(rest_),
      wanted_(rest_),
      velocities_(rest_.size()) {
  detail::Box<D> box;
  for (const Point<D>& x : rest_) box.extend(x);
  least_move_ = least_share_of_move * length(box.high - box.low);
  find_constraints();
  if (simplices_.empty())
    throw Error(Error_code::input,
                "there is no solid cell, of which tissue is made: give the environment some");
  find_followers();
}

template <int D>
bool Tissue<D>::is_consistent() const {
  const std::size_t points = rest_.size();
  const auto are_points = [&](const auto& all) {
    return std::ranges::all_of(all, [&](std::uint32_t v) { return v < points; });
  };
  return before_.size() == points && wanted_.size() == points && velocities_.size() == points &&
         may_move_.size() == points && multipliers_.size() == edges_.size() &&
         std::ranges::all_of(edges_, [&](const Edge& edge) { return are_points(edge.ends); }) &&
         std::ranges::all_of(simplices_, [&](const Simplex& s) { return are_points(s.corners); }) &&
         are_points(followers_) && detail::are_lists(first_, neighbours_, followers_.size(), points);
}

template <int D>
void Tissue<D>::find_constraints() {
  const Snapshot<D>& snapshot = *snapshot_;
  edges_.clear();
  simplices_.clear();
  may_move_.assign(rest_.size(), 0);
  std::vector<char> is_held(rest_.size(), 0);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      if (snapshot.neighbour(facet) != Cell::none) continue;
      for (const std::uint32_t v : snapshot.loop(facet)) is_held[v] = 1;
    }
    if (!snapshot.is_solid(cell)) continue;
    const Cell_view<D> view = snapshot.view(cell);
    if (view.vertex_count() != D + 1)
      throw Error(Error_code::input,
                  "cell " + std::to_string(i) + " is not a simplex: tissue is made of them");
    Simplex& simplex = simplices_.emplace_back(Simplex{corners_of<D>(view), 0});
    std::array<Point<D>, static_cast<std::size_t>(D) + 1> x;
    std::array<Vector<D>, static_cast<std::size_t>(D) + 1> gradients;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = rest_[simplex.corners[k]];
    simplex.rest = volume(x, gradients);
    for (std::size_t k = 0; k < x.size(); ++k) {
      const std::uint32_t u = simplex.corners[k];
      may_move_[u] = 1;
      for (std::size_t l = 0; l < k; ++l) {
        const std::uint32_t v = simplex.corners[l];
        pairs.push_back({std::min(u, v), std::max(u, v)});
      }
    }
  }
  const std::span<const Scene_shape<D>> fixed(fixed_);
  for (std::uint32_t v = 0; v < rest_.size(); ++v)
    if (is_held[v] || detail::distance<D>(fixed, rest_[v]) == 0) may_move_[v] = 0;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [u, v] : pairs)
    if (may_move_[u] || may_move_[v])
      edges_.push_back({{u, v}, (1 - material_.tension) * length(rest_[v] - rest_[u])});
  multipliers_.resize(edges_.size());
}

/// Points of free cells only, with their neighbours along edges.
template <int D>
void Tissue<D>::find_followers() {
  const Snapshot<D>& snapshot = *snapshot_;
  std::vector<char> is_at_solid(rest_.size(), 0), is_held(rest_.size(), 0);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const std::vector<std::uint32_t> loop = snapshot.loop(facet);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t u = loop[k], v = loop[(k + 1) % loop.size()];
        is_at_solid[u] |= snapshot.is_solid(cell);
        is_held[u] |= snapshot.neighbour(facet) == Cell::none;
        if (snapshot.is_solid(cell)) continue;
        pairs.push_back({u, v});
        pairs.push_back({v, u});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  followers_.clear();
  neighbours_.clear();
  first_.assign(1, 0);
  for (auto pair = pairs.begin(); pair != pairs.end();) {
    const std::uint32_t u = (*pair)[0];
    const bool follows = !is_at_solid[u] && !is_held[u] &&
                         detail::distance<D>(std::span<const Scene_shape<D>>(fixed_), rest_[u]) > 0;
    if (follows) followers_.push_back(u);
    for (; pair != pairs.end() && (*pair)[0] == u; ++pair)
      if (follows) neighbours_.push_back((*pair)[1]);
    if (follows) first_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

/// Edges return to their lengths, as their compliance allows.
template <int D>
void Tissue<D>::keep_lengths() {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto& [ends, rest] = edges_[e];
    const auto [u, v] = ends;
    const double weight = may_move_[u] + may_move_[v];
    const Vector<D> along = wanted_[v] - wanted_[u];
    const double now = length(along);
    if (!(now > 0)) continue;
    const double by = (rest - now - material_.compliance * multipliers_[e]) / (weight + material_.compliance);
    multipliers_[e] += by;
    if (may_move_[u]) wanted_[u] = wanted_[u] + (-by / now) * along;
    if (may_move_[v]) wanted_[v] = wanted_[v] + (by / now) * along;
  }
}

template <int D>
void Tissue<D>::keep_volumes() {
  std::array<Point<D>, static_cast<std::size_t>(D) + 1> x;
  std::array<Vector<D>, static_cast<std::size_t>(D) + 1> gradients;
  for (const auto& [corners, rest] : simplices_) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = wanted_[corners[k]];
    const double change = rest - volume(x, gradients);
    double squares = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (may_move_[corners[k]]) squares += dot(gradients[k], gradients[k]);
    if (!(squares > 0)) continue;
    const double by = material_.incompressible * change / squares;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (may_move_[corners[k]]) wanted_[corners[k]] = x[k] + by * gradients[k];
  }
}

/// Points between free cells move like the mean of those around them.
template <int D>
void Tissue<D>::drag_followers() {
  for (int sweep = 0; sweep < follower_sweeps; ++sweep)
    for (std::size_t i = 0; i < followers_.size(); ++i) {
      Vector<D> sum{};
      for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k)
        sum = sum + (wanted_[neighbours_[k]] - rest_[neighbours_[k]]);
      wanted_[followers_[i]] = rest_[followers_[i]] + (1.0 / (first_[i + 1] - first_[i])) * sum;
    }
}

template <int D>
std::vector<Vertex_move<D>> Tissue<D>::targets(const World<D>& world) {
  const auto points = snapshot_->points();
  if (points.size() != rest_.size())
    throw Error(Error_code::usage, "points were added since this Tissue was made: follow_changes() first");
  before_.assign(points.begin(), points.end());
  wanted_ = before_;
  for (std::size_t v = 0; v < wanted_.size(); ++v)
    if (may_move_[v]) wanted_[v] = wanted_[v] + (1 - material_.damping) * velocities_[v];
  detail::Yields<D> yields;
  for (const Run_contact<D>& met : world.contacts())
    detail::add_yields(*snapshot_, world, met, material_.yield, yields);
  for (const auto& [point, by] : yields)
    if (may_move_[point]) wanted_[point] = wanted_[point] + by;
  std::fill(multipliers_.begin(), multipliers_.end(), 0.0);
  for (std::uint32_t sweep = 0; sweep < material_.sweeps; ++sweep) {
    keep_lengths();
    keep_volumes();
  }
  drag_followers();
  for (std::uint32_t v = 0; v < wanted_.size(); ++v)
    if (!is_finite(wanted_[v])) detail::refuse_motion("tissue: the motion of point " + std::to_string(v));
  std::vector<Vertex_move<D>> moves;
  for (std::uint32_t v = 0; v < wanted_.size(); ++v)
    if (length(wanted_[v] - before_[v]) > least_move_) moves.push_back({v, wanted_[v]});
  return moves;
}

template <int D>
void Tissue<D>::follow() {
  for (std::uint32_t v = 0; v < velocities_.size(); ++v)
    velocities_[v] = may_move_[v] ? snapshot_->point(v) - before_[v] : Vector<D>{};
}

template <int D>
void Tissue<D>::follow_changes(std::span<const Cut_point> points) {
  const std::size_t count = snapshot_->points().size();
  // Where nothing else is known of new points.
  for (auto v = static_cast<std::uint32_t>(rest_.size()); v < count; ++v)
    rest_.push_back(snapshot_->point(v));
  before_.resize(count);
  wanted_.resize(count);
  velocities_.resize(count);
  for (const auto& [point, between, share] : points) {
    const auto [u, v] = between;
    rest_[point] = rest_[u] + share * (rest_[v] - rest_[u]);
    velocities_[point] = velocities_[u] + share * (velocities_[v] - velocities_[u]);
    before_[point] = snapshot_->point(point) - velocities_[point];
  }
  find_constraints();
  find_followers();
}

template <int D>
double Tissue<D>::largest_stretch() const {
  double result = 0;
  for (const auto& [ends, rest] : edges_)
    if (rest > 0)
      result = std::max(result, length(snapshot_->point(ends[1]) - snapshot_->point(ends[0])) / rest);
  return result;
}

template class Tissue<2>;
template class Tissue<3>;

}  // namespace cellwalk
