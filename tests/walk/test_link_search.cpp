// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for linked cells: its order, its ways, and of which facets it asks.
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/star.h>

#include <gtest/gtest.h>

#include <functional>

#include "oracle/squares_and_cubes.h"

namespace cellwalk::detail {
namespace {

/// Four squares round (1, 1), which has this index; the two below are parted by a wall.
class LinkSearch : public testing::Test {
 protected:
  static Snapshot<2> four_squares() {
    Cell_soup<2> soup = oracle::make_squares(2, 2);
    oracle::set_wall(soup, 0, 1);
    return Snapshot<2>::compile(soup, glue(soup));
  }

  static constexpr std::uint32_t middle = 4;
  const Snapshot<2> snapshot_ = four_squares();
  const Cell start_ = snapshot_.cell(0);
  int asked_ = 0;
  const std::function<bool(const Cell_view<2>&, std::size_t)> holds_middle_ = [this](const Cell_view<2>& cell,
                                                                                     std::size_t i) {
    ++asked_;
    return facet_contains(cell, i, middle, middle);
  };
};

TEST_F(LinkSearch, FindsCellsInOrderAndTheWaysToThem) {
  Link_search<2> links(snapshot_, start_);
  std::vector<std::uint32_t> order;
  while (links.next()) {
    EXPECT_EQ(links.place(), order.size());
    order.push_back(snapshot_.index(links.cell()));
    links.expand(holds_middle_);
  }
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 2, 3, 1})) << "the wall is gone round";
  std::vector<Half_facet> way{Half_facet::none};
  links.append_path(2, way);
  ASSERT_EQ(way.size(), 3u) << "behind what was there";
  EXPECT_EQ(snapshot_.cell_of(way[1]), start_);
  EXPECT_EQ(snapshot_.neighbour(way[1]), links.cell(1));
  EXPECT_EQ(snapshot_.cell_of(way[2]), links.cell(1));
  EXPECT_EQ(snapshot_.neighbour(way[2]), links.cell(2));
  EXPECT_TRUE(links.contains(snapshot_.cell(1)));
}

TEST_F(LinkSearch, AsksOnlyOfFacetsThatMayLeadOnOrOfAll) {
  EXPECT_EQ(linked_cells(snapshot_, start_, holds_middle_).size(), 4u);
  EXPECT_EQ(asked_, 3) << "walls and facets before cells that are known are passed over";

  asked_ = 0;
  int walls = 0;
  Link_search<2> links(snapshot_, start_);
  const auto count = [&](const Cell_view<2>&, std::size_t, Half_facet f) {
    EXPECT_TRUE(snapshot_.is_impassable(f));
    ++walls;
  };
  while (links.next()) links.expand_all(holds_middle_, count);
  EXPECT_EQ(asked_, 16);
  EXPECT_EQ(walls, 2) << "from both sides; those of the boundary do not hold the point";
}

TEST_F(LinkSearch, StopsWhereNothingHolds) {
  const auto nothing = [](const Cell_view<2>&, std::size_t) { return false; };
  EXPECT_EQ(linked_cells(snapshot_, start_, nothing), std::vector<Cell>{start_});
}

}  // namespace
}  // namespace cellwalk::detail
