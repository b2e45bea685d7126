// SPDX-License-Identifier: LGPL-3.0-or-later
// Odd surfaces through both meshers: a mesh, or a refusal with its place. Nothing dies, hangs or is left.
#include <cellwalk/internal/meshing/mesh3.h>
#include <cellwalk/meshing/tetrahedralize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <regex>
#include <thread>
#include <vector>

#include "meshing/odd_surfaces.h"
#include "meshing/traces.h"

namespace cellwalk {
namespace {

using test::Traces;

/// The count of a test of CI length times CELLWALK_TEST_LENGTH.
std::size_t times_length(std::size_t count) {
  const char* const length = std::getenv("CELLWALK_TEST_LENGTH");
  return std::max<std::size_t>(
      20, static_cast<std::size_t>(static_cast<double>(count) * (length != nullptr ? std::atof(length) : 1)));
}

struct Tally {
  std::size_t meshed = 0, refused_before = 0, refused = 0, with_tolerance = 0, late = 0;
};

/// One line, and a place in it.
void expect_place(const std::string& name, const Error& error) {
  static const std::regex named("(vertex|vertices|facet|facets) [0-9]+");
  const std::string message = error.what();
  EXPECT_TRUE(error.code() == Error_code::input || error.code() == Error_code::not_certified)
      << name << ": " << message;
  EXPECT_TRUE(std::regex_search(message, named)) << name << ": " << message;
  EXPECT_EQ(message.find('\n'), message.npos) << name << ": " << message;
}

/// The longest side of the box around it.
double size_of(const Surface_soup& surface) {
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] =
        std::minmax_element(surface.points.begin(), surface.points.end(),
                            [k](const Point<3>& a, const Point<3>& b) { return a[k] < b[k]; });
    size = std::max(size, (*high)[k] - (*low)[k]);
  }
  return size;
}

/// Calls `mesh` with surfaces 0 to n, by several threads.
template <class Mesh>
Tally try_all(std::size_t n, const Mesh& mesh) {
  const Traces before;
  Tally tally;
  std::mutex turn;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i; (i = next++) < n;) {
      const test::Odd_surface odd = test::odd_surface(i);
      try {
        const bool needed_tolerance = mesh(odd);
        const std::lock_guard lock(turn);
        ++tally.meshed;
        tally.with_tolerance += needed_tolerance;
      } catch (const Error& error) {
        const std::lock_guard lock(turn);
        expect_place(odd.name, error);
        ++(error.code() == Error_code::input ? tally.refused_before : tally.refused);
        tally.late += std::string(error.what()).find("the limit of time") != std::string::npos;
      }
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  before.expect_unchanged();
  EXPECT_EQ(tally.meshed + tally.refused_before + tally.refused, n);
  std::printf(
      "%zu meshed (%zu with a finer tolerance), %zu refused before, %zu by the mesher, %zu too late\n",
      tally.meshed, tally.with_tolerance, tally.refused_before, tally.refused, tally.late);
  return tally;
}

TEST(OddSurfaces, AreMeshedByTetGenOrRefusedWithAPlace) {
  const std::size_t n = times_length(100);
  const Tally tally = try_all(n, [](const test::Odd_surface& odd) {
    Tetrahedralize_options options;
    options.limits.seconds = 100;  // it ends, if others run beside it or not
    Tetrahedralize_report report;
    const Cell_soup<3> soup = tetrahedralize(odd.surface, {}, options, &report);
    EXPECT_GT(soup.cell_count(), 0u) << odd.name;
    EXPECT_GE(report.boundary_facets, odd.surface.facets.size()) << odd.name;
    return !report.tolerance.empty();
  });
  EXPECT_GT(tally.meshed, n / 2);
  EXPECT_GE(tally.with_tolerance, n / 20);
  EXPECT_GE(tally.refused_before, n / 20);
}

TEST(OddSurfaces, AreMeshedByMesh3OrRefusedWithAPlace) {
  const std::size_t n = times_length(100);
  const Tally tally = try_all(n, [](const test::Odd_surface& odd) {
    Mesh3_options options;
    options.limits.seconds = 1;
    options.cell_size = size_of(odd.surface) / 3;
    options.facet_distance = size_of(odd.surface) / 30;
    EXPECT_GT(mesh3(odd.surface, {}, options).cell_count(), 0u) << odd.name;
    return false;
  });
  // On some Mesh_3 does not end, so that their time is up; how many these are depends on the machine.
  EXPECT_GT(tally.meshed + tally.late, n / 4);
  EXPECT_GE(tally.refused_before, n / 20);
}

/// CGAL prints an assertion and where it dumps, before it throws.
TEST(OddSurfaces, AreRefusedByMesh3ForItsReason) {
  const Traces before;
  Surface_soup spike;
  for (std::size_t v = 0; v < 8; ++v)
    spike.points.push_back({v < 4 ? 0.0 : 1.0, v % 4 < 2 ? 0.0 : 1.0,
                            v == 7       ? 1e12
                            : v % 2 == 0 ? 0.0
                                         : 1.0});
  spike.facets = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                  {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  const std::string said = test::refusal([&] { mesh3(spike); });
  EXPECT_EQ(said.rfind("4: Mesh_3 failed: (", 0), 0u) << said;
  EXPECT_NE(said.find(" is already inserted on surface; vertices "), said.npos) << said;
  before.expect_unchanged();
}

}  // namespace
}  // namespace cellwalk
