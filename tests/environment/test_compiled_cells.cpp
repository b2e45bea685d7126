// SPDX-License-Identifier: LGPL-3.0-or-later
// Images whose cells do not fit each other, with checksums that fit: each kind is refused when it is opened,
// by its reason.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "environment/images.h"
#include "environment/sample_soups.h"

namespace cellwalk {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t wall_bit = 1u << 31, link_mask = wall_bit - 1, solid_bit = 1u << 31,
                        continuation_bit = 1u << 30;

template <int D>
Bytes image_of(Cell_soup<D> soup) {
  const auto environment = Environment<D>::build(std::move(soup));
  return compile_to_bytes<D>(environment, environment.certify(), {});
}

/// The entries of a section.
template <class T>
std::vector<T> entries(Bytes& image, const char* section) {
  const auto bytes = test::section_of(image, section);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// Why an image is refused in which entries were changed; empty if it is opened.
template <class T>
std::string refusal(Bytes image, const char* section, const std::vector<T>& values) {
  const auto bytes = test::section_of(image, section);
  std::memcpy(bytes.data(), values.data(), bytes.size());
  test::seal(image);
  try {
    open_compiled_copy(image);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::input) << error.what();
    return error.what();
  }
}

/// How often each reason was given.
using Reasons = std::map<std::string, int>;

template <class T>
void count_refusals(Reasons& reasons, const Bytes& image, const char* section,
                    const std::function<bool(std::vector<T>&, std::size_t)>& change) {
  Bytes copy = image;
  const auto values = entries<T>(copy, section);
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto changed = values;
    if (change(changed, i)) ++reasons[refusal(image, section, changed)];
  }
}

/// All refusals for one reason, and so many.
void expect_all(const Reasons& reasons, const std::string& part, int least) {
  int count = 0;
  for (const auto& [reason, times] : reasons) {
    EXPECT_NE(reason.find(part), std::string::npos) << times << " times: " << reason;
    count += times;
  }
  EXPECT_GE(count, least);
}

template <int D>
std::vector<Bytes> sample_images() {
  std::vector<Bytes> images;
  for (auto& [name, soup] : test::sample_soups<D>()) images.push_back(image_of<D>(soup));
  return images;
}

bool is_link(std::uint32_t word) { return (word & link_mask) != link_mask; }

template <int D>
void expect_links_are_mutual() {
  Reasons swapped, one_sided, lost;
  for (const Bytes& image : sample_images<D>()) {
    // Two facets of a cell have each other's neighbours: each cell is still the neighbour of its neighbour.
    count_refusals<std::uint32_t>(swapped, image, "links", [](auto& links, std::size_t i) {
      if (i % 4 == 3 || !is_link(links[i]) || !is_link(links[i + 1])) return false;
      if ((links[i] & link_mask) == (links[i + 1] & link_mask)) return false;
      std::swap(links[i], links[i + 1]);
      return true;
    });
    count_refusals<std::uint32_t>(one_sided, image, "links", [](auto& links, std::size_t i) {
      if (is_link(links[i])) links[i] ^= wall_bit;
      return is_link(links[i]);
    });
    count_refusals<std::uint32_t>(lost, image, "links", [](auto& links, std::size_t i) {
      const bool was_link = is_link(links[i]);
      links[i] = link_mask | wall_bit;
      return was_link;
    });
  }
  expect_all(swapped, "a cell is not the neighbour of its neighbour", 20);
  expect_all(one_sided, "a facet has two sides that differ", 100);
  expect_all(lost, "a cell is not the neighbour of its neighbour", 100);
}

TEST(CompiledCells, LinksAreMutual2) { expect_links_are_mutual<2>(); }
TEST(CompiledCells, LinksAreMutual3) { expect_links_are_mutual<3>(); }

template <int D>
void expect_other_neighbours_are_refused() {
  Reasons reasons;
  for (const Bytes& image : sample_images<D>())
    for (const std::uint32_t by : {1u, ~0u, 1u << 29, 1u << 30})
      count_refusals<std::uint32_t>(reasons, image, "links", [&](auto& links, std::size_t i) {
        const std::uint32_t bits = links[i] & ~link_mask;
        if (is_link(links[i])) links[i] = bits | ((links[i] + by) & link_mask);
        return is_link(links[i]);
      });
  expect_all(reasons, "neighbour", 100);
}

TEST(CompiledCells, OtherNeighboursAreRefused2) { expect_other_neighbours_are_refused<2>(); }
TEST(CompiledCells, OtherNeighboursAreRefused3) { expect_other_neighbours_are_refused<3>(); }

/// Lanes that have no facet, and facets of the boundary, have no bits that they cannot have.
TEST(CompiledCells, BitsOfNoFacetAreRefused) {
  Reasons unused, boundary;
  for (const Bytes& image : sample_images<2>()) {
    count_refusals<std::uint32_t>(unused, image, "links", [](auto& links, std::size_t i) {
      if (links[i] != link_mask) return false;
      links[i] |= wall_bit;
      return true;
    });
    count_refusals<std::uint32_t>(boundary, image, "links", [](auto& links, std::size_t i) {
      if (links[i] != (link_mask | wall_bit)) return false;
      links[i] ^= wall_bit;
      return true;
    });
  }
  expect_all(unused, "a neighbour belongs to no facet", 5);
  expect_all(boundary, "a facet of the boundary is no wall", 20);
}

/// Of each block, whether a cell begins there.
std::vector<bool> first_blocks(Bytes image) {
  std::vector<bool> are_first;
  for (const std::uint32_t word : entries<std::uint32_t>(image, "shape"))
    are_first.push_back(!(word & continuation_bit));
  return are_first;
}

template <int D>
void expect_corners_differ() {
  Reasons twice, elsewhere, unread;
  for (Bytes image : sample_images<D>()) {
    const std::vector<bool> is_first_block = first_blocks(image);
    const auto begins = entries<std::uint32_t>(image, "vertex_begin");
    std::set<std::size_t> first_vertices;
    for (std::size_t b = 0; b < begins.size(); ++b)
      if (is_first_block[b]) first_vertices.insert(begins[b]);
    count_refusals<std::uint32_t>(twice, image, "vertices", [&](auto& vertices, std::size_t i) {
      if (first_vertices.contains(i)) return false;  // the vertex before is one of another cell
      vertices[i] = vertices[i - 1];
      return true;
    });
    count_refusals<std::uint32_t>(elsewhere, image, "vertex_begin", [&](auto& begin, std::size_t i) {
      if (i == 0 || !is_first_block[i]) return false;
      begin[i] = begin[i - 1];
      return true;
    });
    count_refusals<std::uint32_t>(unread, image, "vertex_begin", [&](auto& begin, std::size_t i) {
      begin[i] = ~begin[i];
      return !is_first_block[i];
    });
  }
  expect_all(twice, "a cell ", 100);  // is not convex, or has a point twice
  EXPECT_FALSE(elsewhere.contains(""));
  expect_all(elsewhere, "", 20);
  // Nobody reads the entries of blocks after the first of a cell.
  EXPECT_EQ(unread.size(), 1u);
  EXPECT_GE(unread[""], 20);
}

TEST(CompiledCells, CornersDiffer2) { expect_corners_differ<2>(); }
TEST(CompiledCells, CornersDiffer3) { expect_corners_differ<3>(); }

/// Each facet of a shape is a polygon, and each edge belongs to two facets: one that does not is refused, and
/// one that belongs to other facets is found where cells meet.
template <int D>
void expect_shapes_are_closed() {
  Reasons reasons;
  for (const Bytes& image : sample_images<D>())
    for (const int by : {1, -1, 255})
      count_refusals<std::uint16_t>(reasons, image, "shapes", [&](auto& shapes, std::size_t i) {
        shapes[i] = static_cast<std::uint16_t>(shapes[i] + by);
        return true;
      });
  EXPECT_FALSE(reasons.contains(""));
  EXPECT_GE(reasons.size(), 2u);
}

TEST(CompiledCells, ShapesAreClosed2) { expect_shapes_are_closed<2>(); }
TEST(CompiledCells, ShapesAreClosed3) { expect_shapes_are_closed<3>(); }

/// A solid cell is walled off.
TEST(CompiledCells, SolidCellsHaveWalls) {
  Reasons reasons;
  for (const Bytes& image :
       {image_of(hex_grid({.cells = {2, 1, 1}})), image_of(triangle_grid({.cells = {2, 2}}))})
    count_refusals<std::uint32_t>(reasons, image, "shape", [](auto& shape, std::size_t i) {
      if (shape[i] & continuation_bit) return false;
      shape[i] |= solid_bit;
      return true;
    });
  expect_all(reasons, "a facet is passable that cannot be", 8);
}

/// Cells that are flat or turned inside out: what relies on a vertex off each plane would look for ever.
template <int D>
void expect_cells_are_convex() {
  Reasons reasons;
  for (const Bytes& image : sample_images<D>()) {
    Bytes copy = image;
    const auto points = entries<double>(copy, "points");
    for (std::size_t i = 0; i + D <= points.size(); i += D) {
      auto changed = points;
      for (std::size_t k = 0; k < D; ++k) changed[i + k] = points[(i + D + k) % points.size()];
      ++reasons[refusal(image, "points", changed)];
    }
  }
  EXPECT_GE(reasons["this compiled environment is damaged: a cell is not convex; make it again, by `cellwalk "
                    "import`"],
            20);
}

TEST(CompiledCells, CellsAreConvex2) { expect_cells_are_convex<2>(); }
TEST(CompiledCells, CellsAreConvex3) { expect_cells_are_convex<3>(); }

}  // namespace
}  // namespace cellwalk
