// SPDX-License-Identifier: LGPL-3.0-or-later
// Worlds of simplices with particles and small bodies in them, and moves of their vertices, at least half of
// them degenerate.
#ifndef CELLWALK_TESTS_RESHAPE_RESHAPE_WORLD_H
#define CELLWALK_TESTS_RESHAPE_RESHAPE_WORLD_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "walk/oracle_worlds.h"

namespace cellwalk::test {

template <int D>
class Reshape_world {
 public:
  /// \param number of the world, see oracle::make_world()
  Reshape_world(std::uint64_t number, bool generic)
      : Reshape_world(oracle::make_world<D>(number), number, generic) {}
  Reshape_world(oracle::World<D> world, std::uint64_t number, bool generic)
      : world_(std::move(world)),
        environment(Environment<D>::build(
            world_.soup,
            {.duplicates = Duplicate_vertices::keep, .simplicial = true, .keep_map = number % 2 == 0})),
        snapshot(environment.snapshot()),
        random(number),
        generic_(generic),
        source_(world_, number) {
    Point<D> low = snapshot.point(0), high = low;
    for (const Point<D>& p : snapshot.points())
      for (int k = 0; k < D; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    unit_ = std::ldexp(1.0, std::ilogb(high[0] - low[0]) - 8);
  }
  Reshape_world(const Reshape_world&) = delete;
  Reshape_world& operator=(const Reshape_world&) = delete;

  const std::string& name() const { return world_.name; }

  /// Puts particles and bodies of one to four vertices into free space.
  void populate(std::size_t particle_count, std::size_t body_count) {
    const Locator<D> locator(snapshot);
    for (int tries = 0; particles.size() < particle_count && tries < 500; ++tries) {
      const auto sides = locator.particles_at(place());
      if (!sides.empty()) particles.push_back(sides[random.below(sides.size())]);
    }
    for (int tries = 0; bodies.size() < body_count && tries < 300; ++tries) {
      Body_soup<D> soup;
      const std::size_t n = 2 + random.below(3);
      soup.points.push_back(place());
      for (std::size_t i = 1; i < n; ++i) soup.points.push_back(beside(soup.points.back()));
      for (std::uint32_t i = 1; i < n; ++i) soup.edges.push_back({i - 1, i});
      // In 3D half of those with three corners have a face.
      if (D == 3 && n > 2 && random.chance(0.5)) {
        soup.edges.insert(soup.edges.begin() + 1, {0, 2});
        soup.faces.push_back({0, 1, 2});
        // So that walls may land on it.
        if (!generic_ && random.chance(0.6)) {
          const auto axis = static_cast<std::size_t>(random.below(3));
          for (Point<D>& x : soup.points) x[axis] = soup.points[0][axis];
        }
      }
      try {
        bodies.push_back(std::make_unique<Body<D>>(snapshot, locator, soup));
      } catch (const Error&) {  // across a wall
      }
    }
  }

  Residents<D> residents() {
    Residents<D> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }

  /// A vertex, near a resident in most cases.
  std::uint32_t vertex() {
    if (random.chance(0.2) || particles.empty())
      return static_cast<std::uint32_t>(random.below(snapshot.points().size()));
    Cell c = particles[random.below(particles.size())].cell;
    if (!bodies.empty() && random.chance(0.6)) {
      const auto of_body = bodies[random.below(bodies.size())]->particles();
      c = of_body[random.below(of_body.size())].cell;
    }
    const auto vertices = snapshot.view(c).vertices;
    return vertices[random.below(vertices.size())];
  }

  /// Where it may go.
  Point<D> target(std::uint32_t v) {
    const Point<D>& from = snapshot.point(v);
    if (random.chance(0.1) && !particles.empty()) {  // through a particle
      const Point<D>& x = particles[random.below(particles.size())].position;
      return rounded(from + (random.chance(0.5) ? 1.0 : 1.25) * (x - from));
    }
    const std::vector<Cell> star = environment.cells_around(v);
    const auto other = [&] {
      const auto vertices = snapshot.view(star[random.below(star.size())]).vertices;
      return snapshot.point(vertices[random.below(vertices.size())]) - from;
    };
    if (generic_) {
      Point<D> x = from;
      for (int i = 0; i < 2; ++i) x = x + random.real(-0.5, 0.6) * other();
      return x;
    }
    Point<D> x = from;
    const std::size_t terms = 1 + random.below(2);
    for (std::size_t i = 0; i < terms; ++i) {
      const double share = static_cast<double>(random.below(9)) / 8 - 0.5;
      x = x + share * other();
    }
    if (!bodies.empty() && random.chance(0.15)) {  // to the level of a body
      const auto& body = *bodies[random.below(bodies.size())];
      const auto axis = static_cast<std::size_t>(random.below(D));
      x[axis] = body.positions()[0][axis];
    }
    return rounded(x);
  }

 private:
  Point<D> rounded(Point<D> x) const {
    if (!generic_)
      for (double& c : x) c = std::round(c / unit_) * unit_;
    return x;
  }
  Point<D> place() { return source_.start(kind()); }
  Point<D> beside(const Point<D>& x) { return source_.target(kind(), x, x); }
  oracle::Motion_kind kind() {
    for (;;) {
      const oracle::Motion_kind k = source_.kind(generic_);
      if (k != oracle::Motion_kind::in_wall_plane && k != oracle::Motion_kind::along_edge) return k;
    }
  }

  oracle::World<D> world_;

 public:
  Environment<D> environment;
  const Snapshot<D>& snapshot;
  Random random;
  std::vector<Particle<D>> particles;
  std::vector<std::unique_ptr<Body<D>>> bodies;

 protected:
  double unit_ = 1;  ///< of the lattice on which targets lie

 private:
  bool generic_;
  oracle::Motion_source<D> source_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_RESHAPE_WORLD_H
