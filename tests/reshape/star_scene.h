// SPDX-License-Identifier: LGPL-3.0-or-later
// Small environments around one vertex, point 0, made of triangles, or in space of tetrahedra over and under
// them, with bodies in them. Each move of the vertex is judged by the oracles.
#ifndef CELLWALK_TESTS_RESHAPE_STAR_SCENE_H
#define CELLWALK_TESTS_RESHAPE_STAR_SCENE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "reshape/wall_judge.h"

namespace cellwalk::test {

/// A place in the plane, in space at a height above it.
template <int D>
Point<D> at(double x, double y, double z = 0) {
  if constexpr (D == 2)
    return {x, y};
  else
    return {x, y, z};
}

/// Triangles and, in space, the tetrahedra that two poles above and below the plane span with them.
template <int D>
struct Flat_soup {
  explicit Flat_soup(std::initializer_list<std::array<double, 2>> points) {
    for (const auto& [x, y] : points) soup.points.push_back(at<D>(x, y));
    if (D == 3)
      for (const double z : {8.0, -8.0}) soup.points.push_back(at<D>(0, 0, z));
  }
  std::uint32_t pole(std::uint32_t k) const { return static_cast<std::uint32_t>(soup.points.size()) - 2 + k; }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if constexpr (D == 2) {
      soup.add_facet({a, b});
      soup.add_facet({b, c});
      soup.add_facet({c, a});
      soup.end_cell();
    } else {
      add_tetrahedron(soup, a, b, c, pole(0));
      add_tetrahedron(soup, a, c, b, pole(1));
    }
  }
  /// The triangles of point 0 and the points from 1 to n around it.
  void add_fan(std::uint32_t n) {
    for (std::uint32_t k = 1; k <= n; ++k) add(0, k, k % n + 1);
  }
  void add_wall(std::uint32_t a, std::uint32_t b) {
    for (std::size_t f = 0; f < soup.facet_count(); ++f) {
      const auto loop = soup.facet(f);
      const auto has = [&](std::uint32_t p) { return std::ranges::find(loop, p) != loop.end(); };
      if (has(a) && has(b) && (D == 2 || has(pole(0)) || has(pole(1)))) soup.impassable[f] = 1;
    }
  }

  Cell_soup<D> soup;
};

template <int D>
class Star_scene {
 public:
  explicit Star_scene(const Cell_soup<D>& soup)
      : environment(Environment<D>::build(soup, {.duplicates = Duplicate_vertices::keep})),
        snapshot(environment.snapshot()) {}
  Star_scene(const Star_scene&) = delete;
  Star_scene& operator=(const Star_scene&) = delete;

  /// Adds a particle; of several sides that on which a point lies further on.
  void add_particle(const Point<D>& x, const Point<D>& towards) {
    for (const Particle<D>& p : Locator<D>(snapshot).particles_at(x)) {
      Particle<D> probe = p;
      Walk_counts counts;
      cellwalk::move(snapshot, probe, x + 0.0009765625 * (towards - x), counts);
      if (probe.position == x) continue;
      particles.push_back(p);
      return;
    }
    ADD_FAILURE() << "no particle there";
  }
  Body<D>& add_body(const std::vector<Point<D>>& points) {
    Body_soup<D> soup{points, {}, {}};
    for (std::uint32_t k = 1; k < points.size(); ++k) soup.edges.push_back({k - 1, k});
    bodies.push_back(std::make_unique<Body<D>>(snapshot, Locator<D>(snapshot), soup));
    return *bodies.back();
  }
  Residents<D> residents() {
    Residents<D> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }

  Vertex_result<D> move(const Point<D>& target, std::uint32_t vertex = 0) {
    typename Wall_judge<D, Star_scene>::Tally tally;
    Wall_judge<D, Star_scene> judge(*this, tally);
    Reshaping<D> reshaping(environment, residents(), {.at_contact = At_contact::hold});
    reshaping.test_move(vertex, target);
    Vertex_result<D> result = judge.judge(reshaping, vertex, target);
    reshaping.finish();
    EXPECT_EQ(tally.wrong(), 0) << "missed " << tally.missed << " and " << tally.fates.missed
                                << ", false blocks " << tally.false_blocks << " and "
                                << tally.fates.false_blocks << ", wrong times " << tally.wrong_times
                                << " and " << tally.fates.wrong_times << ", sides " << tally.wrong_sides
                                << ", ends " << tally.wrong_ends << ", registrations "
                                << tally.fates.wrong_registrations << ", tunnels " << tally.tunnels << ", to "
                                << target[0] << ", " << target[1];
    EXPECT_NO_THROW(environment.certify());
    for (const auto& body : bodies) EXPECT_NO_THROW(body->validate());
    return result;
  }
  Move_end end_of(const Point<D>& target, std::uint32_t vertex = 0) { return move(target, vertex).end; }
  void expect_hit(const Point<D>& target, int numerator, int denominator, std::uint32_t vertex = 0) {
    const Vertex_result<D> result = move(target, vertex);
    ASSERT_EQ(result.end, Move_end::contact);
    EXPECT_EQ(cellwalk::to_fraction(result.hit->exact_time()),
              cellwalk::Fraction(Ring(numerator), Ring(denominator)));
  }

  Environment<D> environment;
  const Snapshot<D>& snapshot;
  std::vector<Particle<D>> particles;
  std::vector<std::unique_ptr<Body<D>>> bodies;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_STAR_SCENE_H
