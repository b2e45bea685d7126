// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits of an environment at random, about a cell.
#ifndef CELLWALK_TESTS_BODY_RANDOM_EDITS_H
#define CELLWALK_TESTS_BODY_RANDOM_EDITS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <functional>
#include <optional>

namespace cellwalk::test {

/// Opens or closes a facet of a cell, moves one of its vertices, or inserts a point. Returns what takes the
/// change of walls back, or nothing if the edit was refused.
template <int D>
std::optional<std::function<void()>> edit_near(Environment<D>& environment, Cell cell, Random& random,
                                               bool generic) {
  const Snapshot<D>& snapshot = environment.snapshot();
  const Cell_view<D> view = snapshot.view(cell);
  const auto which = random.below(6);
  const auto facet = snapshot.half_facet(cell, random.below(view.facet_count()));
  const std::uint32_t point = view.vertices[random.below(view.vertex_count())];
  const Point<D> place = snapshot.point(point);
  try {
    if (which < 3) {
      const bool was_wall = snapshot.is_impassable(facet);
      environment.set_impassable(facet, !was_wall);
      return [&environment, facet, was_wall] { environment.set_impassable(facet, was_wall); };
    }
    if (which < 5) {
      const double size = length(view.point(1) - view.point(0));
      Point<D> target = place;
      for (double& x : target)
        x += size * (generic ? random.real(-0.2, 0.2) : (static_cast<double>(random.below(5)) - 2) / 8);
      if (target == place) return {};
      environment.move_vertex(point, target);
      return [&environment, point, place] { environment.move_vertex(point, place); };
    }
    Point<D> middle{};
    for (std::size_t v = 0; v < view.vertex_count(); ++v)
      middle = middle + 1 / static_cast<double>(view.vertex_count()) * view.point(v);
    environment.insert_point(cell, middle);
    return [] {};
  } catch (const Error&) {  // the result would not be certified, or the facet is of the boundary
    return {};
  }
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_RANDOM_EDITS_H
