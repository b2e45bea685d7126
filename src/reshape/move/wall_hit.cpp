// SPDX-License-Identifier: LGPL-3.0-or-later
// The rounded time, place and direction of a hit, and the lowest features that meet.
#include "wall_hit.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <vector>

namespace cellwalk::detail {
namespace {

/// Rounded, of sum 1.
std::vector<double> rounded(const std::vector<Ring>& weights) {
  Ring sum = 0;
  for (const Ring& w : weights) sum += w;
  std::vector<double> result;
  result.reserve(weights.size());
  for (const Ring& w : weights) result.push_back(to_double(Fraction(w, sum)));
  return result;
}

std::vector<std::size_t> places_used(const std::vector<Ring>& weights) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!CGAL::is_zero(weights[i])) result.push_back(i);
  return result;
}

Body_feature kind_of(const Collision& collision) {
  return static_cast<Body_feature>(collision.feature_weights.size() - 1);
}

/// The points that span the feature that was hit.
template <int D>
std::vector<std::uint32_t> spanning(const Resident_group<D>& group, Body_feature feature,
                                    std::uint32_t number) {
  if (feature == Body_feature::vertex) return {number};
  if (feature == Body_feature::edge) return {group.edges[number].begin(), group.edges[number].end()};
  return {group.faces[number].begin(), group.faces[number].end()};
}

/// The lowest vertex, edge or face that holds the point of a hit.
template <int D>
std::pair<Body_feature, std::uint32_t> lowest(const Resident_group<D>& group,
                                              const std::vector<std::uint32_t>& vertices,
                                              const Collision& collision) {
  const std::vector<std::size_t> parts = places_used(collision.feature_weights);
  if (parts.size() == 1) return {Body_feature::vertex, vertices[parts[0]]};
  if (parts.size() == 2 && vertices.size() == 3)
    for (std::uint32_t e = 0; e < group.edges.size(); ++e)
      if (std::is_permutation(group.edges[e].begin(), group.edges[e].end(),
                              std::array{vertices[parts[0]], vertices[parts[1]]}.begin()))
        return {Body_feature::edge, e};
  return {kind_of(collision), collision.feature};
}

/// Perpendicular to the features that meet, and where that leaves a choice, along the motion; else to the
/// wall.
Vector<2> direction(std::span<const Point<2>> wall, std::size_t of_wall, std::span<const Point<2>> feature,
                    const Vector<2>&) {
  return of_wall == 1 && feature.size() == 2 ? unit_normal(feature[0], feature[1])
                                             : unit_normal(wall[0], wall[1]);
}

Vector<3> direction(std::span<const Point<3>> wall, std::size_t of_wall, std::span<const Point<3>> feature,
                    const Vector<3>& motion) {
  if (of_wall == 1 && feature.size() == 3) return unit_normal(feature[0], feature[1], feature[2]);
  if (of_wall == 1 && feature.size() == 2) {
    const Vector<3> along = feature[1] - feature[0];
    const Vector<3> across = motion - (dot(motion, along) / dot(along, along)) * along;
    // An edge along the motion has no side to which it can be passed.
    if (const double size = length(across); size > 0x1p-30 * length(motion)) return (1 / size) * across;
  }
  if (of_wall == 2 && feature.size() == 2) {
    const Vector<3> across = cross(wall[1] - wall[0], feature[1] - feature[0]);
    if (const double size = length(across); size > 0) return (1 / size) * across;
  }
  return unit_normal(wall[0], wall[1], wall[2]);
}

}  // namespace

template <int D>
Wall_hit<D> to_wall_hit(const Collision& collision, const Moving_star<D>& star,
                        const Resident_groups<D>& groups) {
  const Moving_wall<D>& wall = star.walls()[collision.wall];
  const Resident_group<D>& group = groups.all()[collision.group];
  const auto vertices = spanning(group, kind_of(collision), collision.feature);
  const auto [feature, number] = lowest(group, vertices, collision);

  Wall_hit<D> hit;
  hit.set_time(to_time(collision.time));
  hit.facet = wall.facet;
  hit.vertex = star.vertex();
  hit.resident = groups.at({collision.group, number}, feature);
  hit.body = hit.resident.feature;
  hit.feature = hit.resident.number;
  const std::vector<std::size_t> of_wall = places_used(collision.wall_weights);
  hit.kind = of_wall.size() == 1             ? Contact_kind::vertex
             : D == 3 && of_wall.size() == 2 ? Contact_kind::edge
                                             : Contact_kind::facet;
  std::copy_n(rounded(collision.wall_weights).begin(), hit.weights.size(), hit.weights.begin());
  const std::vector<double> shares = rounded(collision.feature_weights);
  std::vector<Point<D>> lowest_points;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point<D>& x = group.particles[vertices[i]].position;
    hit.point = hit.point + shares[i] * x;
    if (shares[i] != 0 || kind_of(collision) == Body_feature::face) lowest_points.push_back(x);
  }
  const auto lowest_vertices = spanning(group, feature, number);
  for (std::size_t k = 0; k < lowest_vertices.size(); ++k)
    hit.resident_weights[k] =
        shares[static_cast<std::size_t>(std::ranges::find(vertices, lowest_vertices[k]) - vertices.begin())];
  // The wall at that time, the corners that meet first.
  const auto& corners = wall.swept.corners();
  std::vector<Point<D>> now{point_on<D>(corners[0], corners[1], hit.time)};
  now.insert(now.end(), corners.begin() + 2, corners.end());
  std::vector<Point<D>> ordered;
  ordered.reserve(now.size());
  for (const std::size_t k : of_wall) ordered.push_back(now[k]);
  for (std::size_t k = 0; k < now.size(); ++k)
    if (std::find(of_wall.begin(), of_wall.end(), k) == of_wall.end()) ordered.push_back(now[k]);
  const Vector<D> motion = corners[1] - corners[0];
  hit.normal = direction(ordered, of_wall.size(), lowest_points, motion);
  if (dot(hit.normal, motion) < 0) hit.normal = -1.0 * hit.normal;
  return hit;
}

template Wall_hit<2> to_wall_hit<2>(const Collision&, const Moving_star<2>&, const Resident_groups<2>&);
template Wall_hit<3> to_wall_hit<3>(const Collision&, const Moving_star<3>&, const Resident_groups<3>&);

}  // namespace cellwalk::detail
