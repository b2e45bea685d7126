// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edge/thick_oracle.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cellwalk::test {
namespace {

template <int D>
std::array<Point<D>, 2> box_of(std::span<const Point<D>> points) {
  std::array<Point<D>, 2> box{points[0], points[0]};
  for (const Point<D>& x : points)
    for (std::size_t k = 0; k < D; ++k) {
      box[0][k] = std::min(box[0][k], x[k]);
      box[1][k] = std::max(box[1][k], x[k]);
    }
  return box;
}

/// Not above the distance of two boxes, by a margin that covers all roundings.
template <int D>
double at_least(const std::array<Point<D>, 2>& box, const Thick_wall<D>& wall) {
  constexpr double margin = 1e-9;
  double square = 0;
  for (std::size_t k = 0; k < D; ++k) {
    const double gap = std::max({0., wall.low[k] - box[1][k], box[0][k] - wall.high[k]});
    const double size =
        std::max({std::abs(wall.low[k]), std::abs(wall.high[k]), std::abs(box[0][k]), std::abs(box[1][k])});
    const double sure = std::max(0., gap - margin * size);
    square += sure * sure;
  }
  return (1 - margin) * std::sqrt(square);
}

}  // namespace

template <int D>
Thick_oracle<D>::Thick_oracle(const Snapshot<D>& snapshot) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || snapshot.is_solid(c)) continue;
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      if (!snapshot.is_impassable(f)) continue;
      const Cell other = snapshot.neighbour(f);
      const bool is_free_on_both = other != Cell::none && !snapshot.is_solid(other);
      if (is_free_on_both && snapshot.opposite(f) < f) continue;  // a membrane counts once
      Wall wall;
      wall.facet = f;
      for (const std::uint32_t v : snapshot.loop(f)) wall.corners.push_back(snapshot.point(v));
      wall.hull = to_hull<D>(wall.corners);
      const auto box = box_of<D>(wall.corners);
      wall.low = box[0];
      wall.high = box[1];
      walls_.push_back(std::move(wall));
    }
  }
}

template <int D>
Fraction Thick_oracle<D>::square_to_walls(std::span<const Point<D>> points) const {
  const auto box = box_of<D>(points);
  const Hull<D> hull = to_hull<D>(points);
  std::vector<std::pair<double, const Wall*>> order;
  for (const Wall& wall : walls_) order.emplace_back(at_least<D>(box, wall), &wall);
  std::sort(order.begin(), order.end());
  std::optional<Fraction> least;
  for (const auto& [bound, wall] : order) {
    if (least && !root_is_at_least(*least, bound)) break;
    const Fraction square = shortest_vector<D>(hull, wall->hull).square;
    if (!least || square < *least) least = square;
    if (*least == 0) break;
  }
  return *least;
}

template <int D>
auto Thick_oracle<D>::nearer_than(double r, std::span<const Point<D>> points) const
    -> std::vector<const Wall*> {
  const auto box = box_of<D>(points);
  const Hull<D> hull = to_hull<D>(points);
  std::vector<const Wall*> found;
  for (const Wall& wall : walls_)
    if (at_least<D>(box, wall) <= r && !root_is_at_least(shortest_vector<D>(hull, wall.hull).square, r))
      found.push_back(&wall);
  return found;
}

template <int D>
bool Thick_oracle<D>::is_free_until(const Fraction& time, const Thick_motion<D>& motion,
                                    const std::vector<const Wall*>& walls) {
  Hull<D> swept = to_hull<D>(before(motion));
  swept.push_back(at_time(motion.p, motion.target, time));
  return std::all_of(walls.begin(), walls.end(), [&](const Wall* wall) {
    return root_is_at_least(shortest_vector<D>(swept, wall->hull).square, motion.radius);
  });
}

template <int D>
Shortest<D> Thick_oracle<D>::from_part_at(const Fraction& time, const Thick_motion<D>& motion,
                                          const Hull<D>& hull) {
  Hull<D> part = to_hull<D>(still_corners(motion));
  part.push_back(at_time(motion.p, motion.target, time));
  return shortest_vector<D>(part, hull);
}

template class Thick_oracle<2>;
template class Thick_oracle<3>;

}  // namespace cellwalk::test
