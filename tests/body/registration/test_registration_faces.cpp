// SPDX-License-Identifier: LGPL-3.0-or-later
// A body is registered if it can be on some sides of walls, faces included: compared with all combinations of
// sides and chains.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/edge/all_chains.h>
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "oracle/seed.h"

namespace cellwalk::test {
namespace {

/// Membranes in a room of 3 x 3 x 3 cells: ridges in which several of them meet.
Environment<3> room_of_membranes(Random& random) {
  auto environment = Environment<3>::build(hex_grid({.cells = {3, 3, 3}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  for (std::size_t c = 0; c < snapshot.cell_count(); ++c)
    for (std::size_t i = 0; i < 6; ++i) {
      const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(c), i);
      if (snapshot.neighbour(f) != Cell::none && random.below(8) == 0) environment.set_impassable(f, true);
    }
  return environment;
}

/// A tetrahedron, or two triangles with a common side; one edge and most corners in planes and lines of
/// walls.
Body_soup<3> small_body(Random& random) {
  Body_soup<3> soup;
  const std::uint64_t axis = random.below(3);
  for (int v = 0; v < 4; ++v) {
    Point<3> x;
    for (double& c : x) {
      const bool is_off = random.below(3) == 0;
      c = (is_off ? 0.25 : 0.5) * static_cast<double>(1 + random.below(is_off ? 11 : 5));
    }
    // The first two in a line of ridges.
    if (v < 2)
      for (std::uint64_t i = 1; i < 3; ++i) x[(axis + i) % 3] = 1;
    soup.points.push_back(x);
  }
  if (random.below(2) == 0) {
    soup.edges = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    soup.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  } else {
    soup.edges = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
    soup.faces = {{0, 1, 2}, {1, 2, 3}};
  }
  return soup;
}

/// Whether the body can be somewhere, by trying all combinations; and whether the first of them will do.
class By_brute_force {
 public:
  By_brute_force(const Snapshot<3>& snapshot, const Locator<3>& locator, const Body_soup<3>& soup)
      : snapshot_(snapshot), soup_(soup), chains_(soup.edges.size()) {
    for (const Point<3>& x : soup.points) {
      sides_.push_back(locator.particles_at(x));
      if (sides_.back().empty()) return;
    }
    try_vertices(0);
  }

  bool is_possible() const { return found_ > 0; }
  /// Each edge has a chain, and yet no wall may come between the faces.
  bool has_only_pierced() const { return found_ == 0 && tried_ > 0; }
  bool are_some_pierced() const { return found_ > 0 && found_ < tried_; }

 private:
  void try_vertices(std::size_t v) {
    if (v == sides_.size()) return try_edges(0);
    for (const Particle<3>& side : sides_[v]) {
      particles_.push_back(side);
      try_vertices(v + 1);
      particles_.pop_back();
    }
  }
  void try_edges(std::size_t e) {
    if (e == soup_.edges.size()) {
      ++tried_;
      found_ += std::all_of(soup_.faces.begin(), soup_.faces.end(), [&](const auto& f) { return passes(f); });
      return;
    }
    const auto [u, v] = soup_.edges[e];
    for (const Chain& chain : detail::all_chains(snapshot_, particles_[u], particles_[v], walks_).chains) {
      chains_[e] = chain;
      try_edges(e + 1);
    }
  }
  bool passes(const std::array<std::uint32_t, 3>& face) {
    const auto side = [&](std::uint32_t from, std::uint32_t to) {
      for (std::size_t e = 0; e < soup_.edges.size(); ++e)
        if (soup_.edges[e] == std::array{std::min(from, to), std::max(from, to)})
          return Side_chain{&chains_[e], from > to};
      throw std::logic_error("a side without an edge");
    };
    const auto [u, v, w] = face;
    return register_face(snapshot_, particles_[u], particles_[v], particles_[w],
                         {side(u, v), side(v, w), side(w, u)}, counts_)
               .piercing == Half_facet::none;
  }

  const Snapshot<3>& snapshot_;
  const Body_soup<3>& soup_;
  std::vector<std::vector<Particle<3>>> sides_;
  std::vector<Particle<3>> particles_;
  std::vector<Chain> chains_;
  std::size_t tried_ = 0, found_ = 0;
  Walk_counts walks_;
  Face_counts counts_;
};

TEST(RegistrationOfFaces, AcceptsBodiesThatCanBeOnSomeSides) {
  Random random(oracle::reseeded(20'261'130));
  std::size_t accepted = 0, refused = 0, some_pierced = 0, only_pierced = 0;
  for (int world = 0; world < 150; ++world) {
    const Environment<3> environment = room_of_membranes(random);
    const Locator<3> locator(environment.snapshot());
    for (int k = 0; k < 40; ++k) {
      const Body_soup<3> soup = small_body(random);
      const By_brute_force truth(environment.snapshot(), locator, soup);
      some_pierced += truth.are_some_pierced();
      only_pierced += truth.has_only_pierced();
      std::string refusal;
      try {
        const Body<3> body(environment.snapshot(), locator, soup);
        body.validate();
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), Error_code::outside);
        refusal = error.what();
      }
      ASSERT_EQ(refusal.empty(), truth.is_possible()) << refusal << ", world " << world << ", body " << k;
      ++(refusal.empty() ? accepted : refused);
    }
  }
  std::cout << accepted << " bodies accepted, " << some_pierced << " of them pierced on other sides; "
            << refused << " refused, " << only_pierced << " of them for their faces alone\n";
  EXPECT_GT(accepted, 200u);
  EXPECT_GT(refused, 200u);
  EXPECT_GT(some_pierced, 20u);
  EXPECT_GT(only_pierced, 10u);
}

/// Two walls meet in a line, in which an edge lies; its face lies in the angle between them. The walk along
/// the edge prefers a way outside.
TEST(RegistrationOfFaces, AnEdgeInTheLineOfTwoWallsGoesWithItsFace) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    auto environment = Environment<3>::build(hex_grid({.cells = {2, 2, 3}}));
    const Snapshot<3>& snapshot = environment.snapshot();
    for (std::size_t c = 0; c < snapshot.cell_count(); ++c)
      for (std::size_t i = 0; i < 6; ++i) {
        const Half_facet f = Snapshot<3>::half_facet(snapshot.cell(c), i);
        if (snapshot.neighbour(f) == Cell::none) continue;
        // In the middle third: the half-planes x = 1 and y = 1 beside the quarter in which the face lies.
        bool is_wall = false;
        for (const std::size_t axis : {0u, 1u}) {
          bool lies_in = true;
          for (const std::uint32_t p : snapshot.loop(f)) {
            const Point<3>& x = snapshot.point(p);
            const double other = x[1 - axis];
            lies_in = lies_in && x[axis] == 1 && x[2] >= 1 && x[2] <= 2 &&
                      (((quarter >> (1 - axis)) & 1) ? other >= 1 : other <= 1);
          }
          is_wall |= lies_in;
        }
        if (is_wall) environment.set_impassable(f, true);
      }
    const double x = quarter & 1 ? 1.5 : 0.5, y = quarter >> 1 & 1 ? 1.5 : 0.5;
    const Body_soup<3> soup{{{1, 1, 0.5}, {1, 1, 2.5}, {x, y, 1.5}}, {{0, 1}, {0, 2}, {1, 2}}, {{0, 1, 2}}};
    const Body<3> body(environment, soup);
    EXPECT_NO_THROW(body.validate()) << quarter;
  }
}

}  // namespace
}  // namespace cellwalk::test
