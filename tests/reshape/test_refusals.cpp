// SPDX-License-Identifier: LGPL-3.0-or-later
// A change that is refused, by a result or an error, leaves all as it was, to the byte, and the epoch: bodies
// that are not listed go on.
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "oracle/seed.h"
#include "reshape/random_change.h"
#include "reshape/state_digest.h"
#include "walk/oracle_trial.h"

namespace cellwalk {
namespace {

/// Certificates that moves withdrew, made or not, are made anew before other changes, also one that is none.
template <int D>
void restore(Reshaping<D>& reshaping, std::uint32_t point) {
  EXPECT_THROW(reshaping.merge_vertices(point, point), Error);
}

template <int D>
void refuse_many(std::size_t worlds) {
  std::array<std::size_t, test::Random_change<D>::names.size()> refused{}, made{};
  for (std::uint64_t number = 0; number < std::max(oracle::scaled_count(worlds), worlds / 2); ++number) {
    SCOPED_TRACE("world " + std::to_string(number));
    test::Toggle_world<D> world(number, number % 3 == 0);
    world.populate(6, 6);
    for (int phase = 0; phase < 3; ++phase) {
      Body_counts uncounted;
      for (const auto& body : world.bodies) body->leave_region(uncounted);
      Reshaping<D> reshaping(world.environment, world.residents(), {.at_contact = At_contact::hold});
      for (int k = 0; k < 30; ++k) {
        const test::Random_change<D> change(world);
        restore(reshaping, change.u);
        const std::string before = test::digest(world.environment, world.residents());
        bool is_made = false;
        try {
          is_made = change.make(reshaping);
        } catch (const Error& e) {
          EXPECT_EQ(e.code(), Error_code::usage) << e.what();
        }
        ++(is_made ? made : refused)[change.kind];
        restore(reshaping, change.u);
        if (!is_made) {
          ASSERT_EQ(before == test::digest(world.environment, world.residents()), true)
              << change.names[change.kind];
        }
      }
      reshaping.finish();
      ASSERT_NO_THROW(world.environment.certify());
      for (const auto& body : world.bodies) ASSERT_NO_THROW(body->validate());
      world.step_bodies();
    }
  }
  for (std::size_t k = 0; k < refused.size(); ++k) {
    std::printf("%s %zu of %zu refused, ", test::Random_change<D>::names[k], refused[k],
                refused[k] + made[k]);
    if (k != 0 && k != 2) {
      EXPECT_GT(refused[k], 2u) << test::Random_change<D>::names[k];
    }
  }
  std::printf("\n");
}

TEST(Refusals, ChangeNothing2D) { refuse_many<2>(12); }
TEST(Refusals, ChangeNothing3D) { refuse_many<3>(8); }

/// A body that is not listed goes on while all is refused.
TEST(Refusals, LetABodyGoOnThatIsNotListed) {
  Environment<3> environment = test::simplex_grid<3>(3);
  const Snapshot<3>& s = environment.snapshot();
  const Locator<3> locator(s);
  const Body_soup<3> soup{{{0.5, 0.6, 1.4}, {2.4, 2.3, 1.6}}, {{0, 1}}, {}};
  Body<3> listed(s, locator, soup), other(s, locator, soup);
  Body_counts counts;
  std::size_t refused = 0;
  const std::uint64_t epoch = s.epoch();
  {
    Reshaping<3> reshaping(environment, {{&listed}, {}});
    for (const Half_facet f : listed.chain(0)) {
      refused += !reshaping.close(f).is_made;
      refused += !reshaping.fill(s.cell_of(f)).is_made;
      const auto loop = s.loop(f);
      refused += !reshaping.merge_vertices(loop[0], loop[1]).is_made;
      refused += !reshaping.split_edge(loop[0], loop[1], s.point(loop[0])).is_made;
      EXPECT_THROW(reshaping.split_vertex(loop[0], std::array{s.cell_of(f)}, s.point(loop[1])), Error);
    }
    EXPECT_EQ(s.epoch(), epoch);
    EXPECT_NO_THROW(other.refresh(counts));
  }
  EXPECT_GT(refused, 8u);
  EXPECT_NO_THROW(other.refresh(counts));
}

}  // namespace
}  // namespace cellwalk
