// SPDX-License-Identifier: LGPL-3.0-or-later
// Both sides of a cut are apart, and nothing else has changed: judged in rational numbers.
#include <cellwalk/reshape/reshaping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

#include "reshape/cut_judge.h"
#include "reshape/tissue_block.h"

namespace cellwalk {
namespace {

/// The points of the boundary.
template <int D>
std::set<std::uint32_t> boundary_points(const Snapshot<D>& snapshot) {
  std::set<std::uint32_t> result;
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    for (std::size_t f = 0; f < snapshot.facet_count(c); ++f)
      if (const Half_facet facet = Snapshot<D>::half_facet(c, f); snapshot.neighbour(facet) == Cell::none)
        for (const std::uint32_t p : snapshot.loop(facet)) result.insert(p);
  }
  return result;
}

/// A block whose boundary is flat, so that edges there can be split exactly.
template <int D>
Environment<D> flat_block(std::uint32_t size, double height, bool is_lattice) {
  auto environment = test::tissue<D>(size, height, 0);
  const Snapshot<D>& snapshot = environment.snapshot();
  Random random(3);
  const auto boundary = boundary_points(snapshot);
  for (std::uint32_t p = 0; p < snapshot.points().size() && !is_lattice; ++p) {
    Point<D> x = snapshot.point(p);
    for (double& c : x) c += random.real(-0.12, 0.12);
    if (!boundary.contains(p)) environment.move_vertex(p, x);
  }
  return environment;
}

void expect_sound(const test::Cut_findings& found) {
  EXPECT_TRUE(found.has_same_volume);
  EXPECT_EQ(found.flat, 0u);
  EXPECT_EQ(found.entered, 0u) << "solid has retreated only";
  EXPECT_EQ(found.unmarked, 0u);
  EXPECT_GT(found.front, 0u);
  EXPECT_GT(found.back, 0u);
}

struct Straight_cut {
  double at, lean;
  bool is_lattice;
  double opening;
};

/// A blade through all of a block: only at the boundary do both sides hold together.
template <int D>
void cut_through(const Straight_cut& with) {
  SCOPED_TRACE("at " + std::to_string(with.at) + ", lean " + std::to_string(with.lean) +
               (with.is_lattice ? ", lattice" : "") + ", opening " + std::to_string(with.opening));
  constexpr std::uint32_t size = D == 2 ? 6 : 3;
  auto environment = flat_block<D>(size, D == 2 ? 4 : 2, with.is_lattice);
  const Snapshot<D>& snapshot = environment.snapshot();
  const test::Cut_judge<D> judge(snapshot);
  std::vector<Point<D>> points;
  if constexpr (D == 2)
    points = {{with.at + with.lean, 8}, {with.at - with.lean, -2}};
  else
    points = {{with.at + with.lean, -2, 5},
              {with.at + with.lean, 5, 5},
              {with.at - with.lean, 5, -2},
              {with.at - with.lean, -2, -2}};
  Reshaping<D> reshaping(environment, {});
  const Cut_report report = reshaping.cut(test::blade<D>(points), {.opening = with.opening});
  reshaping.finish();
  EXPECT_NO_THROW(environment.certify());
  EXPECT_EQ(report.held, 0u);
  EXPECT_EQ(report.refused(), 0u);
  EXPECT_GT(report.opened, 1u);
  std::array<Point<D>, static_cast<std::size_t>(D)> plane;
  std::copy_n(points.begin(), D, plane.begin());
  const auto rim = boundary_points(snapshot);
  const test::Cut_findings found = judge.judge(plane, [&](std::uint32_t p) { return rim.contains(p); });
  expect_sound(found);
  EXPECT_EQ(found.both, 0u);
  EXPECT_EQ(found.touching, 0u);
  EXPECT_GE(found.gap_cells, report.opened);
  EXPECT_GE(found.parts, 2u);
}

TEST(CutSides, AreApartInThePlane) {
  for (const double at : {3.0, 3.1, 2.5, 2.45})
    for (const double lean : {0.0, 0.4})
      for (const double opening : {0.01, 0.2, 30.0})
        for (const bool is_lattice : {true, false}) cut_through<2>({at, lean, is_lattice, opening});
}

TEST(CutSides, AreApartInSpace) {
  cut_through<3>({1, 0, true, 0.05});
  cut_through<3>({1.5, 0.3, true, 2});
  cut_through<3>({1.45, 0, false, 0.05});
  cut_through<3>({1, 0.3, false, 2});
}

/// A cut that ends inside leaves the tissue in one part.
TEST(CutSides, HoldTogetherBeyondTheEnd) {
  for (const bool is_lattice : {true, false}) {
    auto environment = flat_block<2>(6, 4, is_lattice);
    const Snapshot<2>& snapshot = environment.snapshot();
    const test::Cut_judge<2> judge(snapshot);
    Reshaping<2> reshaping(environment, {});
    const Cut_report report = reshaping.cut(test::blade<2>({{3.1, 6}, {3.1, 1.5}}));
    reshaping.finish();
    EXPECT_EQ(report.rim, 1u);
    const test::Cut_findings found =
        judge.judge({{{3.1, 6}, {3.1, 1.5}}}, [](std::uint32_t) { return false; });
    expect_sound(found);
    EXPECT_EQ(found.parts, 1u);
    EXPECT_EQ(found.both, 1u);
  }
}

/// The judge finds what it is to find.
TEST(CutSides, WithoutACutAreNotApart) {
  auto environment = test::tissue<3>(3, 2, 0);
  const test::Cut_judge<3> judge(environment.snapshot());
  environment.fill(Locator<3>(environment.snapshot()).locate({0.3, 0.2, 2.7}).cells.front());
  const auto rim = boundary_points(environment.snapshot());
  const test::Cut_findings found =
      judge.judge({{{1, 0, 0}, {1, 1, 0}, {1, 0, 1}}}, [&](std::uint32_t p) { return rim.contains(p); });
  EXPECT_EQ(found.both, 1u);
  EXPECT_GT(found.touching, 0u);
  EXPECT_EQ(found.entered, 1u) << "the cell that was filled";
  EXPECT_TRUE(found.has_same_volume);
}

}  // namespace
}  // namespace cellwalk
