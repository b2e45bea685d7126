// SPDX-License-Identifier: LGPL-3.0-or-later
// The same geometry in two listings, with the same things in it, which are registered in other cells of the
// same sides: whatever changes must change alike.
#ifndef CELLWALK_TESTS_RESHAPE_LISTING_TWINS_H
#define CELLWALK_TESTS_RESHAPE_LISTING_TWINS_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "edge/relisted.h"

namespace cellwalk::test {

/// How the second listing differs.
enum class Listing { other_order, mirrored };

template <int D>
Point<D> listed(Point<D> x, Listing listing) {
  if (listing == Listing::mirrored) x[0] = -x[0];
  return x;
}

/// Points keep their names.
template <int D>
Cell_soup<D> listed(const Cell_soup<D>& soup, Listing listing, std::uint64_t seed) {
  if (listing == Listing::other_order) return relisted(soup, seed, true).soup;
  Cell_soup<D> result;
  for (const Point<D>& x : soup.points) result.points.push_back(listed<D>(x, listing));
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    // Facets and loops run backwards.
    for (std::uint32_t f = soup.cell_begin[c + 1]; f-- > soup.cell_begin[c];) {
      const auto loop = soup.facet(f);
      result.add_facet(std::vector<std::uint32_t>(loop.rbegin(), loop.rend()), soup.impassable[f] != 0);
    }
    result.end_cell(soup.solid[c] != 0);
  }
  return result;
}

template <int D>
struct Listed_world {
  explicit Listed_world(const Cell_soup<D>& soup) : environment(Environment<D>::build(soup)) {}

  Residents<D> residents() {
    Residents<D> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }
  const Snapshot<D>& snapshot() const { return environment.snapshot(); }

  /// The cell with some points, ascending.
  std::optional<Cell> find(const std::vector<std::uint32_t>& points) {
    for (const Cell c : environment.cells_around(points[0]))
      if (points_of(c) == points) return c;
    return {};
  }
  std::vector<std::uint32_t> points_of(Cell c) const {
    const auto vertices = snapshot().view(c).vertices;
    std::vector<std::uint32_t> points(vertices.begin(), vertices.end());
    std::sort(points.begin(), points.end());
    return points;
  }
  /// The facet of a simplex that lacks a point.
  Half_facet facet_off(Cell c, std::uint32_t point) const {
    for (std::size_t f = 0;; ++f) {
      const auto loop = snapshot().loop(Snapshot<D>::half_facet(c, f));
      if (std::ranges::find(loop, point) == loop.end()) return Snapshot<D>::half_facet(c, f);
    }
  }

  Environment<D> environment;
  std::vector<Particle<D>> particles;
  std::vector<std::unique_ptr<Body<D>>> bodies;
};

template <int D>
class Listing_twins {
 public:
  Listing_twins(const Cell_soup<D>& soup, Listing listing, std::uint64_t seed)
      : one(soup), other(listed(soup, listing, seed)), listing_(listing) {}

  /// Adds a particle if there is one side for it only.
  bool add_particle(const Point<D>& x) {
    const auto here = Locator<D>(one.snapshot()).particles_at(x);
    const auto there = Locator<D>(other.snapshot()).particles_at(listed<D>(x, listing_));
    if (here.size() != 1 || there.size() != 1) return false;
    one.particles.push_back(here[0]);
    other.particles.push_back(there[0]);
    in_other_cells += one.points_of(here[0].cell) != other.points_of(there[0].cell);
    return true;
  }

  /// Adds a body if there is one side for each vertex and edge only.
  bool add_body(const Body_soup<D>& soup) {
    Body_soup<D> mirrored = soup;
    for (Point<D>& x : mirrored.points) {
      if (Locator<D>(one.snapshot()).particles_at(x).size() != 1) return false;
      x = listed<D>(x, listing_);
    }
    for (const auto& [u, v] : soup.edges)
      if (lies_in_a_wall(soup.points[u], soup.points[v])) return false;
    try {
      auto body = std::make_unique<Body<D>>(one.snapshot(), Locator<D>(one.snapshot()), soup);
      other.bodies.push_back(
          std::make_unique<Body<D>>(other.snapshot(), Locator<D>(other.snapshot()), mirrored));
      one.bodies.push_back(std::move(body));
    } catch (const Error&) {  // across a wall
      return false;
    }
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      in_other_cells += one.points_of(one.bodies.back()->particles()[v].cell) !=
                        other.points_of(other.bodies.back()->particles()[v].cell);
    return true;
  }

  Listed_world<D> one, other;
  std::size_t in_other_cells = 0;

 private:
  bool lies_in_a_wall(const Point<D>& p, const Point<D>& q) const {
    const Snapshot<D>& s = one.snapshot();
    Walk_counts uncounted;
    for (std::size_t i = 0; i < s.cell_slots(); ++i)
      for (std::size_t f = 0; f < s.facet_count(s.cell(i)); ++f) {
        const Cell_view<D> view = s.view(s.cell(i));
        if (s.is_impassable(Snapshot<D>::half_facet(s.cell(i), f)) &&
            detail::side<Exact>(view, f, p, uncounted) == 0 &&
            detail::side<Exact>(view, f, q, uncounted) == 0)
          return true;
      }
    return false;
  }

  Listing listing_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_LISTING_TWINS_H
