// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments that are made by several threads: the same to the bit as by one. The worlds are large enough
// to be shared out, which those of other tests are not.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/lattice_world.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/random.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk {
namespace {

using Bytes = std::vector<std::byte>;

template <class F>
auto on_threads(int threads, const F& f) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(f);
}

/// The bytes of an environment after each thing that threads share.
template <int D>
std::vector<Bytes> stages(const Cell_soup<D>& soup, const Build_options& options) {
  std::vector<Bytes> result;
  Build_report report;
  auto environment = Environment<D>::build(soup, options, &report);
  const auto keep = [&result](const Environment<D>& e) {
    result.push_back(compile_to_bytes<D>(e, e.certify(), {}));
  };
  keep(environment);
  environment.freeze();
  environment.thaw();
  keep(environment);
  // Gaps among the indices, which thawing and compacting see.
  Random random(9);
  const Snapshot<D>& snapshot = environment.snapshot();
  for (int i = 0; i < 50; ++i) {
    const Cell cell = snapshot.cell(random.below(snapshot.cell_count()));
    random.chance(0.5) ? environment.fill(cell) : environment.excavate(cell);
  }
  keep(environment);
  environment.freeze();
  environment.thaw();
  environment.compact();
  keep(environment);
  auto opened = std::get<Compiled_environment<D>>(open_compiled_copy(result.back()));
  check_compiled(opened.environment);
  keep(opened.environment);
  keep(Environment<D>::build(opened.environment.soup(),
                             {.duplicates = options.duplicates, .keep_map = false}));
  return result;
}

template <int D>
void expect_same_stages(const Cell_soup<D>& soup, const Build_options& options, std::size_t least_cells) {
  const auto made = [&] { return stages(soup, options); };
  const std::vector<Bytes> one = on_threads(1, made);
  const auto environment = std::get<Compiled_environment<D>>(open_compiled_copy(one.front()));
  EXPECT_GE(environment.certificate.cells, least_cells);
  for (const int threads : {2, 4}) {
    const std::vector<Bytes> several = on_threads(threads, made);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i)
      EXPECT_TRUE(several[i] == one[i]) << "stage " << i << " with " << threads << " threads";
  }
}

template <int D>
Cell_soup<D> world_with_everything() {
  Lattice_world_options<D> options = mixed_lattice_world<D>(3);
  options.cells.fill(D == 2 ? 80 : 14);
  options.slit_share = 0.05;
  return lattice_world(options);
}

TEST(EnvironmentThreads, MakeTheSameWorlds2) {
  expect_same_stages(world_with_everything<2>(), {.duplicates = Duplicate_vertices::keep}, 4000);
}

TEST(EnvironmentThreads, MakeTheSameWorlds3) {
  expect_same_stages(world_with_everything<3>(), {.duplicates = Duplicate_vertices::keep}, 2100);
}

Cell_soup<3> jittered_grid() {
  Cell_soup<3> soup = hex_grid({.cells = {11, 11, 11}});
  Random random(2);
  for (Point<3>& p : soup.points)
    for (double& x : p) x += random.real(-0.2, 0.2);
  return soup;
}

TEST(EnvironmentThreads, SplitTheSameCells) { expect_same_stages(jittered_grid(), {}, 5000); }

TEST(EnvironmentThreads, RefuseWithTheSameWords) {
  Cell_soup<3> soup = jittered_grid();
  const auto words = [&soup] {
    try {
      Environment<3>::build(soup, {.split = false});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string refusal = on_threads(1, words);
  EXPECT_NE(refusal.find("is not exactly planar"), std::string::npos) << refusal;
  for (const int threads : {2, 4}) EXPECT_EQ(on_threads(threads, words), refusal);
}

}  // namespace
}  // namespace cellwalk
