// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments made of simplices only.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/generators/lattice_world.h>

#include <gtest/gtest.h>

namespace cellwalk {
namespace {

template <int D>
void expect_simplices() {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    auto options = mixed_lattice_world<D>(seed);
    options.cells.fill(D == 2 ? 6 : 3);
    options.merge_share = D == 3 && seed % 2 ? 0.3 : 0;
    const Cell_soup<D> soup = lattice_world(options);
    const Certificate before = Environment<D>::build(soup, {.keep_map = false}).certify();
    Build_report report;
    Environment<D> environment = Environment<D>::build(soup, {.split = false, .simplicial = true}, &report);
    const Snapshot<D>& snapshot = environment.snapshot();
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      EXPECT_EQ(snapshot.view(snapshot.cell(i)).vertex_count(), D + 1u);
      EXPECT_EQ(snapshot.facet_count(snapshot.cell(i)), D + 1u);
    }
    const Certificate after = report.certificate;
    EXPECT_GT(report.split.not_simplices, 0u);
    EXPECT_EQ(report.split.not_simplices, report.split.cells_split);
    EXPECT_EQ(after.cells, before.cells - report.split.cells_split + report.split.cells_made);
    EXPECT_EQ(report.origin.size(), after.cells);
    EXPECT_EQ(after.components, before.components);
    EXPECT_NEAR(after.volume, before.volume, 1e-9 * before.volume);
    EXPECT_NEAR(after.free_volume, before.free_volume, 1e-9 * before.volume);
    EXPECT_GE(after.walls, before.walls);
    // What is made of simplices already stays as it is.
    const Cell_soup<D> again = environment.soup();
    Build_report none;
    Environment<D>::build(again, {.simplicial = true}, &none);
    EXPECT_EQ(none.split.cells_split, 0u);
  }
}

TEST(SplitSimplices, LeavesNoOtherCells2) { expect_simplices<2>(); }
TEST(SplitSimplices, LeavesNoOtherCells3) { expect_simplices<3>(); }

}  // namespace
}  // namespace cellwalk
