// SPDX-License-Identifier: LGPL-3.0-or-later
// Questions about points and edges in no cell: two squares of the plane with a membrane between them.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/query/kernel_choice.h>
#include <cellwalk/query/query.h>

#include <gtest/gtest.h>

namespace cellwalk {
namespace {

class QueryAnswers : public testing::Test {
 protected:
  static Environment<2> two_squares() {
    Cell_soup<2> soup;
    soup.points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
    for (const std::array<std::uint32_t, 4>& v :
         {std::array<std::uint32_t, 4>{0, 1, 4, 3}, std::array<std::uint32_t, 4>{1, 2, 5, 4}}) {
      for (std::size_t i = 0; i < 4; ++i)
        soup.add_facet({v[i], v[(i + 1) % 4]}, v[i] == 1 && v[(i + 1) % 4] == 4);
      soup.end_cell();
    }
    return Environment<2>::build(std::move(soup));
  }

  Answer<2> move(const Point<2>& from, const Point<2>& to, Touch touch = Touch::pass) {
    return answer_move(snapshot_, locator_, from, to, touch, counts_);
  }
  Answer<2> sweep(const Edge_motion<2>& motion, const Sweep_options& options = {}) {
    return answer_sweep(snapshot_, locator_, motion, options, counts_);
  }

  Environment<2> environment_ = two_squares();
  const Snapshot<2>& snapshot_ = environment_.snapshot();
  Locator<2> locator_{snapshot_};
  Edge_counts counts_;
};

TEST_F(QueryAnswers, AStartOnAMembraneBelongsToTheSideOnWhichTheMotionGetsFurthest) {
  for (const double x : {0.25, 1.75}) {
    const Answer<2> answer = move({1, 0.5}, {x, 0.5});
    EXPECT_EQ(answer.status, Motion_status::free);
    EXPECT_EQ(snapshot_.index(answer.cell), x < 1 ? 0u : 1u);
  }
  const Answer<2> beyond = move({1, 0.5}, {3, 0.5});
  ASSERT_EQ(beyond.status, Motion_status::contact);
  EXPECT_EQ(beyond.contact->time, 0.5);
  EXPECT_EQ(move({0.5, 0.5}, {1.5, 0.5}).status, Motion_status::contact);
}

TEST_F(QueryAnswers, EveryKernelAnswersPlainMotionsAlike) {
  for (const Kernel_choice kernel :
       {Kernel_choice::exact, Kernel_choice::lazy, Kernel_choice::rational, Kernel_choice::double_precision,
        Kernel_choice::double_tolerance, Kernel_choice::double_scale_free, Kernel_choice::float_precision}) {
    const std::uint64_t before = counts_.walk.walks;
    const auto status = [&](const Point<2>& from, const Point<2>& to) {
      return answer_move(snapshot_, locator_, from, to, Touch::pass, {kernel, Walk_strategy::exit_rule},
                         counts_)
          .status;
    };
    EXPECT_EQ(status({0.25, 0.5}, {0.75, 0.25}), Motion_status::free);
    EXPECT_EQ(status({0.25, 0.5}, {1.75, 0.25}), Motion_status::contact);
    EXPECT_EQ(status({5, 5}, {0, 0}), Motion_status::outside);
    EXPECT_EQ(counts_.walk.walks - before, 2u) << "nothing walks from outside";
  }
}

TEST_F(QueryAnswers, TouchesCountWhereTheyAreAskedFor) {
  EXPECT_EQ(move({0.5, 0.5}, {1, 0.5}).status, Motion_status::free);
  EXPECT_EQ(move({0.5, 0.5}, {1, 0.5}, Touch::stop).status, Motion_status::contact);
}

TEST_F(QueryAnswers, EdgesAreLinkedOnOneSideOrOutside) {
  EXPECT_EQ(sweep({{1, 0.25}, {0.25, 0.25}, {1, 0.75}}).status, Motion_status::free);
  EXPECT_EQ(sweep({{1, 0.25}, {1.75, 0.25}, {1, 0.75}}).status, Motion_status::free);
  EXPECT_EQ(sweep({{0.5, 0.5}, {0.5, 0.75}, {1.5, 0.5}}).status, Motion_status::outside);
  const Answer<2> blocked = sweep({{1, 0.25}, {3, 0.25}, {1, 0.75}});
  ASSERT_EQ(blocked.status, Motion_status::contact);
  EXPECT_EQ(blocked.contact->time, 0.5);
  EXPECT_EQ(blocked.contact->body, Body_feature::vertex);
}

}  // namespace
}  // namespace cellwalk
