// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments that are made by several threads: the same to the bit as by one. The worlds are large enough
// to be shared out, which those of other tests are not.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "environment/images.h"

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

/// An image of tetrahedra in which a cell is damaged.
struct Damage {
  std::uint32_t lowest;  ///< the first cell in which it shows
  std::string reason;
};

/// Damages a cell in one of the ways that are found when cells are tested, or when links are.
Damage damage(Bytes& image, bool is_of_links, std::uint32_t cell, bool first_way) {
  constexpr std::uint32_t of_wall = 1u << 31, of_cell = of_wall - 1;  // bits of links
  const auto entry = [&](const char* section, std::size_t i) -> std::uint32_t& {
    return reinterpret_cast<std::uint32_t*>(test::section_of(image, section).data())[i];
  };
  if (!is_of_links) {
    const std::uint32_t v = entry("vertex_begin", cell) + 1;
    entry("vertices", v) = first_way ? ~0u : entry("vertices", v - 1);
    return {cell, first_way ? "a cell has a point that is not there" : "a cell is not convex"};
  }
  for (std::size_t i = 4 * std::size_t{cell}; i < 4 * std::size_t{cell} + 4; ++i) {
    std::uint32_t& word = entry("links", i);
    const bool is_boundary = word == (of_cell | of_wall);
    if (first_way != is_boundary) continue;
    const std::uint32_t link = word & of_cell;
    word ^= of_wall;
    return {std::min(cell, link),
            first_way ? "a facet of the boundary is no wall" : "a facet has two sides that differ"};
  }
  return {0, ""};  // no facet is of this kind
}

TEST(EnvironmentThreads, RefuseImagesForTheirLowestCell) {
  Random random(3);
  const auto environment = Environment<3>::build(tetrahedral_grid({.cells = {12, 12, 12}, .jitter = 0.1}));
  const Bytes sound = compile_to_bytes<3>(environment, environment.certify(), {});
  const auto cells = static_cast<std::uint32_t>(environment.snapshot().cell_count());
  std::map<std::string, int> reasons;
  for (int images = 0; images < 150;) {
    Bytes image = sound;
    const bool is_of_links = images % 2, first_way = random.chance(0.5);
    const Damage one = damage(image, is_of_links, static_cast<std::uint32_t>(random.below(cells)), first_way);
    const Damage other =
        damage(image, is_of_links, static_cast<std::uint32_t>(random.below(cells)), !first_way);
    if (one.reason.empty() || other.reason.empty() || one.lowest == other.lowest) continue;
    ++images;
    test::seal(image);
    const std::string& expected = one.lowest < other.lowest ? one.reason : other.reason;
    ++reasons[expected];
    for (const int threads : {1, 2, 4})
      on_threads(threads, [&] {
        try {
          open_compiled_copy(image);
          ADD_FAILURE() << "was opened: " << expected;
        } catch (const Error& error) {
          EXPECT_NE(std::string(error.what()).find(expected), std::string::npos)
              << error.what() << " with " << threads << " threads, and not: " << expected;
        }
      });
  }
  EXPECT_EQ(reasons.size(), 4u);
  for (const auto& [reason, times] : reasons) EXPECT_GE(times, 20) << reason;
}

}  // namespace
}  // namespace cellwalk
