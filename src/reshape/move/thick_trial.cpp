// SPDX-License-Identifier: LGPL-3.0-or-later
// Each wall of a star against each resident with a radius near it.
#include "thick_trial.h"

#include <cellwalk/internal/edge/thick_wall.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cellwalk::detail {
namespace {

/// Weights of the corners of a feature at a point of it, of sum 1.
template <int D>
std::array<double, 3> weights_at(std::span<const Point<D>> feature, const Point<D>& x) {
  if (feature.size() == 1) return {1, 0, 0};
  const Vector<D> e = feature[1] - feature[0], u = x - feature[0];
  if (feature.size() == 2) {
    const double t = std::clamp(dot(u, e) / dot(e, e), 0.0, 1.0);
    return {1 - t, t, 0};
  }
  const Vector<D> f = feature[2] - feature[0];
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), ue = dot(u, e), uf = dot(u, f);
  const double area = ee * ff - ef * ef;
  const double s = std::clamp((ue * ff - uf * ef) / area, 0.0, 1.0);
  const double t = std::clamp((uf * ee - ue * ef) / area, 0.0, 1 - s);
  return {1 - s - t, s, t};
}

/// True if a direction from a place on a facet leads into its cell, a simplex.
template <int D>
bool leads_inside(const Snapshot<D>& snapshot, Half_facet facet, const Point<D>& place,
                  const Vector<D>& direction) {
  const auto loop = snapshot.loop(facet);
  for (const std::uint32_t p : snapshot.view(snapshot.cell_of(facet)).vertices)
    if (std::ranges::find(loop, p) == loop.end()) return dot(snapshot.point(p) - place, direction) > 0;
  return false;
}

/// A wall, or one in the same place, seen from the side to which a direction leads; from any if it leads
/// along the wall.
template <int D>
Half_facet facet_towards(const Moving_star<D>& star, const Moving_wall<D>& wall, const Point<D>& place,
                         const Vector<D>& direction) {
  const Snapshot<D>& snapshot = star.snapshot();
  const auto& corners = wall.swept.corners();
  for (const Moving_wall<D>& other : star.walls()) {
    if (!std::is_permutation(corners.begin(), corners.end(), other.swept.corners().begin())) continue;
    for (const Half_facet f : {other.facet, snapshot.opposite(other.facet)})
      if (f != Half_facet::none && !snapshot.is_solid(snapshot.cell_of(f)) &&
          leads_inside(snapshot, f, place, direction))
        return f;
  }
  return wall.facet;
}

/// A wall that is in the way of a member.
template <int D>
struct Blocked {
  const Moving_wall<D>* wall;
  const Thick_member<D>* member;
  Thick_meeting<D> meeting;
};

template <int D>
Wall_hit<D> to_hit(const Blocked<D>& first, const Moving_star<D>& star, const Resident_groups<D>& groups) {
  const auto& [wall, member, meeting] = first;
  Wall_hit<D> hit;
  hit.set_time(meeting.time);
  hit.vertex = star.vertex();
  hit.point = meeting.on_wall;
  hit.normal = meeting.normal;
  hit.kind = meeting.of_wall.size == 1             ? Contact_kind::vertex
             : D == 3 && meeting.of_wall.size == 2 ? Contact_kind::edge
                                                   : Contact_kind::facet;
  hit.facet = facet_towards(star, *wall, hit.point, hit.normal);

  const auto& corners = wall->swept.corners();
  std::vector<Point<D>> now{point_on<D>(corners[0], corners[1], hit.time)};
  now.insert(now.end(), corners.begin() + 2, corners.end());
  const auto spread = [](const Feature& feature, std::span<const Point<D>> points, const Point<D>& x,
                         auto& weights) {
    std::vector<Point<D>> used;
    for (std::size_t i = 0; i < feature.size; ++i) used.push_back(points[feature.corners[i]]);
    const std::array<double, 3> at = weights_at<D>(used, x);
    for (std::size_t i = 0; i < feature.size; ++i) weights[feature.corners[i]] = at[i];
  };
  spread(meeting.of_wall, now, meeting.on_wall, hit.weights);
  // The lowest feature of the resident: an edge may be met at an end.
  Member lowest = member->member;
  hit.body = member->feature;
  if (hit.body == Body_feature::edge && meeting.of_feature.size == 1) {
    lowest.number = member->corners[meeting.of_feature.corners[0]];
    hit.body = Body_feature::vertex;
    hit.resident_weights[0] = 1;
  } else {
    spread(meeting.of_feature, member->hull(), meeting.on_feature, hit.resident_weights);
  }
  hit.feature = lowest.number;
  hit.resident = groups.at(lowest, hit.body);
  return hit;
}

}  // namespace

template <int D>
std::optional<Wall_hit<D>> first_near_hit(const Moving_star<D>& star, Resident_groups<D>& groups, bool any) {
  if (star.walls().empty()) return {};
  std::optional<Blocked<D>> first;
  Distance_counts uncounted;
  for (const Thick_member<D>* member : groups.thick().near(star.box()))
    for (const Moving_wall<D>& wall : star.walls()) {
      Vector<D> direction{};
      const auto& swept = wall.swept.corners();
      if (is_apart<D>(swept, member->hull(), member->radius, direction, uncounted)) continue;
      if (any) return Wall_hit<D>{};
      auto meeting = first_meeting<D>(swept, member->hull(), member->radius,
                                      first ? std::optional(first->meeting.time) : std::nullopt);
      if (meeting && (!first || is_before(*meeting, first->meeting)))
        first = Blocked<D>{&wall, member, *std::move(meeting)};
    }
  if (!first) return {};
  return to_hit(*first, star, groups);
}

template std::optional<Wall_hit<2>> first_near_hit(const Moving_star<2>&, Resident_groups<2>&, bool);
template std::optional<Wall_hit<3>> first_near_hit(const Moving_star<3>&, Resident_groups<3>&, bool);

}  // namespace cellwalk::detail
