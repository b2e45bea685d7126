// SPDX-License-Identifier: LGPL-3.0-or-later
// Random replacements of cells near what lies in an environment, and their inverses.
#ifndef CELLWALK_TESTS_RESHAPE_REPLACING_H
#define CELLWALK_TESTS_RESHAPE_REPLACING_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/reshape/reshaping.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <span>

namespace cellwalk::test {

/// How often each kind was tried, and made.
struct Replacement_tally {
  static constexpr std::array<const char*, 5> names{"insert", "split", "flip", "remove", "collapse"};
  std::array<std::uint64_t, 5> tried{}, made{};

  std::uint64_t all() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : made) sum += n;
    return sum;
  }
  void print() const {
    for (std::size_t k = 0; k < names.size(); ++k)
      std::printf("%s %llu/%llu ", names[k], static_cast<unsigned long long>(made[k]),
                  static_cast<unsigned long long>(tried[k]));
    std::printf("\n");
  }
};

/// A replacement to be tried, by its place among the names of a tally.
template <int D>
struct Replacement_request {
  std::size_t kind;
  Cell cell;
  Half_facet facet;
  std::uint32_t u, v;
  Point<D> position;
};

/// A random replacement in a cell or around it. Every second new point has few digits.
/// \param may_grow if not, points are removed rather than added
template <int D>
Replacement_request<D> some_replacement(const Snapshot<D>& snapshot, Cell cell, Random& random,
                                        bool may_grow) {
  const Cell_view<D> view = snapshot.view(cell);
  std::size_t kind = random.below(5);
  if (kind < 2 && !may_grow) kind = 4;
  if (kind == 3 && D == 2) kind = 2;
  const std::size_t i = random.below(D + 1), j = (i + 1 + random.below(D)) % (D + 1);
  const std::uint32_t u = view.point_index(i), v = view.point_index(j);
  const auto between = [&] {
    const double t = random.chance(0.5) ? 0.5 : random.real(0.2, 0.8);
    return snapshot.point(u) + t * (snapshot.point(v) - snapshot.point(u));
  };
  const auto inside = [&] {
    Point<D> x = view.point(0);
    for (std::size_t k = 1; k <= D; ++k) {
      const double t = random.chance(0.5) ? 0.25 : random.real(0.1, 0.6) / (1.0 + static_cast<double>(k));
      x = x + t * (view.point(k) - x);
    }
    return x;
  };
  Replacement_request<D> request{kind, cell, Snapshot<D>::half_facet(cell, i), u, v, {}};
  if (kind == 0) request.position = inside();
  if (kind == 1) {
    request.position = between();
    if (random.chance(0.5)) request.position = request.position + 0.125 * (inside() - request.position);
  }
  return request;
}

template <int D>
Replacement replace(Reshaping<D>& reshaping, const Replacement_request<D>& request) {
  switch (request.kind) {
    case 0:
      return reshaping.insert_point(request.cell, request.position);
    case 1:
      return reshaping.split_edge(request.u, request.v, request.position);
    case 2:
      return reshaping.flip(request.facet);
    case 3:
      return reshaping.remove_edge(request.u, request.v);
    default:
      return reshaping.collapse(request.u, request.v);
  }
}

/// Tries a random replacement in a cell or around it.
/// \param most_cells if there are more, points are removed rather than added
template <int D>
Replacement replace_at(Reshaping<D>& reshaping, const Snapshot<D>& snapshot, Cell cell, Random& random,
                       std::size_t most_cells, Replacement_tally& tally) {
  const auto request = some_replacement<D>(snapshot, cell, random, snapshot.cell_count() < most_cells);
  ++tally.tried[request.kind];
  const Replacement result = replace(reshaping, request);
  tally.made[request.kind] += result.is_made;
  return result;
}

/// The cell of a resident in most cases.
template <class World>
Cell cell_near_residents(const World& world, Random& random) {
  const auto& snapshot = world.snapshot;
  if (!world.bodies.empty() && random.chance(0.6)) {
    const auto& body = *world.bodies[random.below(world.bodies.size())];
    return body.particles()[random.below(body.vertex_count())].cell;
  }
  if (!world.particles.empty() && random.chance(0.6))
    return world.particles[random.below(world.particles.size())].cell;
  for (;;)
    if (const Cell c = snapshot.cell(random.below(snapshot.cell_slots())); c != Cell::none) return c;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_REPLACING_H
