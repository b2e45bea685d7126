// SPDX-License-Identifier: LGPL-3.0-or-later
// Relinking where what it assumes does not hold, by hand: chains that pass a facet backwards, edges in the
// plane of a wall, vertices that cross a vertex.
#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/environment/gluing.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace cellwalk::test {
namespace {

using detail::Relink_answer;

/// Four triangles round the origin. Their outer sides are walls.
class Fan {
 public:
  const Snapshot<2>& snapshot() const { return snapshot_; }
  Cell cell(std::size_t i) const { return snapshot_.cell(i); }
  /// The facet of a cell from the origin to a point.
  Half_facet facet_to(Cell from, std::uint32_t end) const {
    for (std::size_t k = 0;; ++k) {
      const Half_facet f = Snapshot<2>::half_facet(from, k);
      const auto loop = snapshot_.loop(f);
      if ((loop[0] == 0 && loop[1] == end) || (loop[0] == end && loop[1] == 0)) return f;
    }
  }
  /// What relinking says of the edge to q while its vertex moves.
  Relink_answer answer(const Point<2>& from, const Point<2>& to, const Point<2>& q, const Chain& before,
                       const std::vector<Half_facet>& crossed, bool has_inner_end) const {
    Float_point<2> mapped;
    EXPECT_TRUE(snapshot_.frame().map(to, mapped));
    detail::Certain_line<2> line(snapshot_.frame(), to, mapped);
    line.lead_to(q, false);
    std::vector<detail::Facet_corners<2>> corners, its_corners;
    for (const Half_facet f : before) detail::append_corners<2>(snapshot_, f, corners);
    detail::Relink_scratch<2> scratch;
    Chain chain;
    return detail::relink_at_ridges<2>(snapshot_,
                                       {from,
                                        q,
                                        line,
                                        false,
                                        has_inner_end,
                                        crossed,
                                        false,
                                        Half_facet::none,
                                        {before.data(), before.size()},
                                        corners},
                                       scratch, chain, its_corners);
  }

 private:
  static Snapshot<2> fan() {
    Cell_soup<2> soup;
    soup.points = {{0, 0}, {4, 0}, {0, 4}, {-4, 2}, {0, -4}};
    for (const std::array<std::uint32_t, 3>& v :
         {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}})
      add_polygon(soup, v);
    return Snapshot<2>::compile(soup, glue(soup));
  }
  Snapshot<2> snapshot_ = fan();
};

/// It is valid by the definition, but the signs of a facet are negative at first. The edge and its way lie in
/// the first triangle.
TEST(RidgeRelink, AChainAllRoundAVertexIsNotBlocked) {
  const Fan fan;
  Chain round;
  Cell cell = fan.cell(0);
  for (const std::uint32_t end : {2u, 3u, 4u, 1u}) {
    round.push_back(fan.facet_to(cell, end));
    cell = fan.snapshot().neighbour(round.back());
  }
  ASSERT_EQ(cell, fan.cell(0));
  const Particle<2> p{{0, 0}, cell, 0, 0}, to{{2, 1}, cell, 2, 0}, q{{1, 1}, cell, 2, 0};
  Walk_counts walk;
  ASSERT_TRUE(is_chain(fan.snapshot(), p, q, round, walk));
  Edge_counts counts;
  const std::array visited{cell};
  const auto swept = sweep_triangle<2>(fan.snapshot(), {p, to, visited, {}}, q, round, counts, false);
  ASSERT_FALSE(swept.contact);
  EXPECT_NE(fan.answer(p.position, to.position, q.position, round, {}, true), Relink_answer::blocked);
}

TEST(RidgeRelink, NothingIsSaidOfAnEdgeInThePlaneOfAWall) {
  const Fan fan;
  const Point<2> from{3, 1}, q{1, 3};
  EXPECT_EQ(fan.answer(from, {2.5, 1.5}, q, {}, {}, false), Relink_answer::open);
  EXPECT_EQ(fan.answer(from, {2, 1}, q, {}, {}, true), Relink_answer::free);
}

TEST(RidgeRelink, NothingIsSaidOfAVertexThatCrossesAVertex) {
  const Fan fan;
  const std::vector<Half_facet> crossed{fan.facet_to(fan.cell(0), 2), fan.facet_to(fan.cell(1), 3)};
  const Point<2> q{0.5, 1};
  EXPECT_EQ(fan.answer({1, 1}, {-1, -1}, q, {}, crossed, true), Relink_answer::open);
  EXPECT_EQ(fan.answer({1, 2}, {-1, 1}, q, {}, {crossed.front()}, true), Relink_answer::free);
}

}  // namespace
}  // namespace cellwalk::test
