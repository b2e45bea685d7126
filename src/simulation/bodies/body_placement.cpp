// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the bodies of a scene start.
#include <cellwalk/generators/transform.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <utility>

#include "random_start.h"

namespace cellwalk {
namespace {

template <int D>
Moving_body<D> throw_body(Body<D> body, const Body_start<D>& start, const Vector<D>& velocity) {
  if (start.material) return Deformable<D>(std::move(body), *start.material, velocity, start.spin);
  return Rigid_body<D>(std::move(body), velocity, start.spin);
}

/// The shape at its place, with the radius of the scene.
template <int D>
Body_soup<D> placed(const Body_soup<D>& shape, const Body_placement<D>& placement,
                    const Body_start<D>& start) {
  Body_soup<D> result = transformed(shape, placement);
  if (start.edge_radius) result.radii = {*start.edge_radius};
  return result;
}

}  // namespace

template <int D>
void World<D>::place_bodies(const Locator<D>& locator) {
  if (shapes_.size() != scene_.bodies.size())
    throw Error(Error_code::usage, fmt::format("{} shapes for the {} bodies of a scene; give one for each",
                                               shapes_.size(), scene_.bodies.size()));
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const Body_start<D>& start = scene_.bodies[i];
    try {
      if (start.cloud)
        place_copies(start, shapes_[i], locator);
      else
        place_body(start, shapes_[i], locator);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("bodies[{}]: {}", i, error.what()));
    }
    entry_of_.resize(bodies_.size(), i);
  }
}

template <int D>
void World<D>::place_body(const Body_start<D>& start, const Body_soup<D>& shape, const Locator<D>& locator) {
  Body_placement<D> placement = start.placement;
  if (start.guided) placement.position = start.guided->path.front();
  Body<D> body(*snapshot_, locator, placed(shape, placement, start));
  if (start.guided)
    bodies_.emplace_back(Rigid_body<D>(std::move(body), *start.guided, start.spin));
  else
    bodies_.push_back(throw_body(std::move(body), start, start.velocity));
}

template <int D>
void World<D>::place_copies(const Body_start<D>& start, const Body_soup<D>& shape,
                            const Locator<D>& locator) {
  const detail::Free_space<D> space(*snapshot_);
  if (space.is_empty()) throw Error(Error_code::usage, "the environment has no free cell");
  Random random(start.cloud->seed);
  Body_placement<D> placement = start.placement;
  const auto has_place = [&] {
    for (int i = 0; i < most_tries; ++i) {
      placement.position = space.draw(random).position;
      const Body_soup<D> there = placed(shape, placement, start);
      try {
        Body<D> body(*snapshot_, locator, there);
        const Vector<D> velocity = start.cloud->speed * detail::random_direction<D>(random);
        bodies_.push_back(throw_body(std::move(body), start, velocity));
        return true;
      } catch (const Error& error) {
        if (error.code() != Error_code::outside) throw;
      }
    }
    return false;
  };
  for (std::uint32_t copy = 1; copy <= start.cloud->count; ++copy)
    if (!has_place())
      throw Error(
          Error_code::outside,
          fmt::format("no room for copy {} of {}: it meets walls at each of {} random places; make the body "
                      "smaller, or the free space larger",
                      copy, start.cloud->count, int{most_tries}));
}

#define CELLWALK_INSTANTIATE(D)                                                                     \
  template void World<D>::place_bodies(const Locator<D>&);                                          \
  template void World<D>::place_body(const Body_start<D>&, const Body_soup<D>&, const Locator<D>&); \
  template void World<D>::place_copies(const Body_start<D>&, const Body_soup<D>&, const Locator<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
