// SPDX-License-Identifier: LGPL-3.0-or-later
// Round surfaces, whose volume is that of their triangles, damaged at random: they come back with it.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/meshing/repair_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "repaired.h"

namespace cellwalk {
namespace {

using Triangles = std::vector<std::array<Point<3>, 3>>;

/// Rings of points, each joined with the next one, the last with the first.
Triangles torus(std::uint32_t along, std::uint32_t around, double radius) {
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    const double a = 2 * std::numbers::pi * (i % along) / along,
                 b = 2 * std::numbers::pi * (j % around) / around;
    const double r = 3 + radius * std::cos(b);
    return Point<3>{r * std::cos(a), r * std::sin(a), radius * std::sin(b)};
  };
  Triangles triangles;
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return triangles;
}

/// A tube along a bent line, with flat ends.
Triangles tube(std::uint32_t along, std::uint32_t around, double bend, bool is_open) {
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    const double t = 6.0 * i / along, b = 2 * std::numbers::pi * (j % around) / around;
    return Point<3>{std::cos(b) + bend * std::sin(t), std::sin(b), t};
  };
  Triangles triangles;
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  for (std::uint32_t j = 2; j < around && !is_open; ++j) {
    triangles.push_back({at(0, 0), at(0, j), at(0, j - 1)});
    triangles.push_back({at(along, 0), at(along, j - 1), at(along, j)});
  }
  return triangles;
}

double volume_of(const Triangles& triangles) {
  double volume = 0;
  const Point<3> o = triangles[0][0];
  for (const auto& t : triangles) volume += dot(t[0] - o, cross(t[1] - o, t[2] - o)) / 6;
  return std::abs(volume);
}

/// Leaves out triangles that share no point with another one left out, nor with the open ends: a cap restores
/// each.
void leave_out(Triangles& triangles, Random& random, bool is_open) {
  std::set<Point<3>> borders;
  for (const auto& t : triangles)
    for (const Point<3>& p : t)
      if (is_open && (p[2] == 0 || p[2] == 6)) borders.insert(p);
  std::erase_if(triangles, [&](const auto& t) {
    for (const Point<3>& p : t)
      if (borders.contains(p)) return false;
    if (!random.chance(0.05)) return false;
    borders.insert(t.begin(), t.end());
    return true;
  });
}

/// Splits triangles at a point inside, near a corner at times: needles.
void add_needles(Triangles& triangles, Random& random) {
  for (std::size_t f = triangles.size(); f-- > 0;) {
    if (!random.chance(0.05)) continue;
    const auto t = triangles[f];
    const double near = std::pow(10, random.real(-6, -1));
    const Point<3> p = t[0] + near * (t[1] - t[0]) + near * (t[2] - t[0]);
    triangles[f] = {t[0], t[1], p};
    triangles.push_back({t[1], t[2], p});
    triangles.push_back({t[2], t[0], p});
  }
}

/// Moves corners of some triangles off their places: seams.
void part(Triangles& triangles, Random& random, double distance) {
  for (auto& t : triangles)
    for (Point<3>& p : t)
      if (random.chance(0.1))
        for (double& x : p) x += random.real(-distance, distance);
}

TEST(DamagedRings, ComeBackWithTheirVolume) {
  constexpr std::uint64_t cases = 60;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto along = static_cast<std::uint32_t>(6 + random.below(10));
    const auto around = static_cast<std::uint32_t>(5 + random.below(8));
    const bool is_torus = random.chance(0.5), is_open = random.chance(0.5);
    const double bend = random.real(0, 0.5), radius = random.real(0.3, 1.5);
    Triangles triangles = is_torus ? torus(along, around, radius) : tube(along, around, bend, is_open);
    const double volume = volume_of(is_torus ? triangles : tube(along, around, bend, false));
    const auto apply = [&](double chance, const auto& damage) {
      if (random.chance(chance)) damage();
    };
    bool is_parted = false;
    apply(0.4, [&] { leave_out(triangles, random, is_open && !is_torus); });
    apply(0.3, [&] { add_needles(triangles, random); });
    apply(0.5, [&] {
      for (auto& t : triangles)
        if (random.chance(0.3)) std::swap(t[0], t[1]);
    });
    apply(0.3, [&] {
      for (int i = 0; i < 5; ++i) {
        auto copy = triangles[random.below(triangles.size())];
        if (random.chance(0.5)) std::swap(copy[0], copy[1]);
        triangles.push_back(copy);
      }
    });
    apply(0.3, [&] {
      part(triangles, random, 1e-7);
      is_parted = true;
    });
    random.shuffle(triangles);
    Surface_soup soup;
    for (const auto& t : triangles) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      soup.points.insert(soup.points.end(), t.begin(), t.end());
      soup.facets.push_back({first, first + 1, first + 2});
    }
    if (random.chance(0.5)) soup = test::turned_by_angles(soup, random.real(0, 3));
    try {
      const test::Repaired repaired = test::repair(soup);
      EXPECT_NEAR(repaired.certificate.free_volume, volume, (is_parted ? 1e-5 : 1e-9) * volume);
      EXPECT_EQ(repaired.certificate.components, 1u);
      // A copy parted from its triangle is a flap.
      EXPECT_TRUE(is_parted || repaired.step("sheets").empty()) << repaired.step("sheets");
      EXPECT_EQ(repaired.step("lumen"), "");
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

}  // namespace
}  // namespace cellwalk
