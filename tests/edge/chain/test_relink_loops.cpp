// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains that go round a vertex at which the edge begins, and pass a facet there backwards: valid by the
// definition, but the signs of that facet are negative at first.
#include <cellwalk/environment/gluing.h>
#include <cellwalk/internal/edge/ridge_relink.h>
#include <cellwalk/internal/edge/triangle.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace cellwalk::test {
namespace {

/// Four triangles round the origin. The edge and its way lie in the first one.
TEST(RidgeRelink, AChainAllRoundAVertexIsNotBlocked) {
  Cell_soup<2> soup;
  soup.points = {{0, 0}, {4, 0}, {0, 4}, {-4, 2}, {0, -4}};
  for (const std::array<std::uint32_t, 3>& v :
       {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}})
    add_polygon(soup, v);
  const Snapshot<2> snapshot = Snapshot<2>::compile(soup, glue(soup));
  const auto facet_to = [&](Cell from, std::uint32_t end) {
    for (std::size_t k = 0;; ++k) {
      const Half_facet f = Snapshot<2>::half_facet(from, k);
      const auto loop = snapshot.loop(f);
      if ((loop[0] == 0 && loop[1] == end) || (loop[0] == end && loop[1] == 0)) return f;
    }
  };
  Chain round;
  Cell cell = snapshot.cell(0);
  for (const std::uint32_t end : {2u, 3u, 4u, 1u}) {
    round.push_back(facet_to(cell, end));
    cell = snapshot.neighbour(round.back());
  }
  ASSERT_EQ(cell, snapshot.cell(0));
  const Particle<2> p{{0, 0}, cell, 0, 0}, to{{2, 1}, cell, 2, 0}, q{{1, 1}, cell, 2, 0};
  Walk_counts walk;
  ASSERT_TRUE(is_chain(snapshot, p, q, round, walk));
  Edge_counts counts;
  const std::array visited{cell};
  const auto swept = sweep_triangle<2>(snapshot, {p, to, visited, {}}, q, round, counts, false);
  ASSERT_FALSE(swept.contact);

  Float_point<2> mapped;
  ASSERT_TRUE(snapshot.frame().map(to.position, mapped));
  detail::Certain_line<2> line(snapshot.frame(), to.position, mapped);
  line.lead_to(q.position, false);
  std::vector<detail::Facet_corners<2>> corners, its_corners;
  for (const Half_facet f : round) detail::append_corners<2>(snapshot, f, corners);
  detail::Relink_scratch<2> scratch;
  Chain chain;
  EXPECT_NE(detail::relink_at_ridges<2>(snapshot,
                                        {p.position,
                                         q.position,
                                         line,
                                         false,
                                         true,
                                         {},
                                         false,
                                         Half_facet::none,
                                         {round.data(), round.size()},
                                         corners},
                                        scratch, chain, its_corners),
            detail::Relink_answer::blocked);
}

}  // namespace
}  // namespace cellwalk::test
