// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that are saved and restored at any time, in the worlds of the oracle, do and count what those do
// that were not; bytes that are damaged or of another environment are refused.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/compiled.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/environment_history.h>
#include <cellwalk/internal/kernel/checksum.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body/random_bodies.h"
#include "body/rooms.h"
#include "body/with_regions.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

using Bytes = std::vector<std::byte>;

struct Saved_seen {
  int bodies = 0, calls = 0, restored = 0, in_copies = 0, different = 0;
  int with_faces = 0, blocked = 0, resting = 0, in_regions = 0;
  std::string first;

  void note(const std::string& what) {
    if (++different <= 5) (first += "\n  ") += what;
  }
};

bool is_equal(const Body_counts& a, const Body_counts& b) {
  return std::bit_cast<Count_array<Body_counts>>(a) == std::bit_cast<Count_array<Body_counts>>(b);
}

/// A body, and a twin that is saved and restored between calls.
template <int D>
class Twins {
 public:
  Twins(std::uint64_t number, bool generic, Body_kind kind, Saved_seen& seen)
      : world_(oracle::make_world<D>(number)),
        environment_(Environment<D>::build(world_.soup, {Duplicate_vertices::keep, false})),
        locator_(environment_.snapshot()),
        random_bodies_(world_, environment_.snapshot(), number, generic),
        kind_(kind),
        seen_(seen) {}

  void run(int bodies, int calls) {
    for (int k = 0; k < bodies; ++k) {
      const Body_soup<D> soup = random_bodies_.make(kind_, locator_);
      std::optional<Body<D>> body;
      try {
        body.emplace(environment_.snapshot(), locator_, soup);
      } catch (const Error&) {  // no room there
        continue;
      }
      // All kinds of bodies have regions, so that these are saved.
      have_regions(*body);
      ++seen_.bodies;
      seen_.with_faces += !body->faces().empty();
      follow(*body, calls);
    }
  }

 private:
  void follow(Body<D>& body, int calls) {
    Body<D> twin = body;
    Body_counts counts, twin_counts;
    std::optional<Compiled_environment<D>> copy;
    if (random_bodies_.random().below(3) == 0) {
      copy = std::get<Compiled_environment<D>>(
          open_compiled_copy(compile_to_bytes<D>(environment_, environment_.certify(), {})));
      detail::follow_history(copy->environment, detail::history_of(environment_));
    }
    const Snapshot<D>& of_twin = copy ? copy->environment.snapshot() : environment_.snapshot();
    bool is_in_copy = false;
    for (int k = 0; k < calls; ++k) {
      const std::string name = world_.name + ", call " + std::to_string(k) + ": ";
      const Call<D> call = random_bodies_.call(body.positions(), static_cast<std::size_t>(seen_.calls));
      ++seen_.calls;
      if (k == 0 || random_bodies_.random().below(2) == 0) {
        const Bytes bytes = save(twin);
        twin = restore_body<D>(of_twin, bytes);
        if (save(twin) != bytes) return seen_.note(name + "its bytes");
        ++seen_.restored;
        is_in_copy = copy.has_value();
      }
      seen_.in_copies += is_in_copy;
      const std::uint64_t in_region = counts.in_region;
      const Answer<D> expected = call.ask(body, call.options, counts),
                      answer = call.ask(twin, call.options, twin_counts);
      seen_.blocked += !expected.report.contacts.empty() || !expected.report.blocked.empty();
      seen_.in_regions += counts.in_region != in_region;
      std::string what = difference(answer, expected);
      if (what.empty() && !std::ranges::equal(body.positions(), twin.positions())) what = "where it stands";
      if (what.empty() && !is_equal(counts, twin_counts)) what = "its counts";
      if (what.empty() && !expected.error && save(body) != save(twin)) what = "its registration";
      if (!what.empty()) return seen_.note(name + what);
      if (expected.error) return;
      for (std::uint32_t v = 0; v < body.vertex_count(); ++v)
        if (locator_.locate(body.positions()[v]).dimension < D) {
          ++seen_.resting;
          break;
        }
    }
  }

  const oracle::World<D> world_;
  Environment<D> environment_;
  Locator<D> locator_;
  Random_bodies<D> random_bodies_;
  const Body_kind kind_;
  Saved_seen& seen_;
};

/// Worlds that no other test has.
constexpr std::uint64_t first_world = 5'000'000 * oracle::world_kinds;

template <int D>
void test_twins(Body_kind kind) {
  Saved_seen seen;
  const std::size_t worlds = oracle::scaled_count(2 * oracle::world_kinds);
  for (const bool generic : {true, false})
    for (std::uint64_t i = 0; i < worlds; ++i) Twins<D>(first_world + i, generic, kind, seen).run(4, 10);
  EXPECT_EQ(seen.different, 0) << seen.first;
  const auto in_ci = [&](std::size_t count) { return static_cast<int>(oracle::scaled_count(count)); };
  EXPECT_GE(seen.bodies, in_ci(40));
  EXPECT_GE(seen.restored, in_ci(100));
  EXPECT_GE(seen.in_copies, in_ci(50));
  EXPECT_GE(seen.blocked, in_ci(30));
  EXPECT_GE(seen.in_regions, in_ci(20));
  EXPECT_GE(seen.resting, in_ci(20));
  if (D == 3 && kind == Body_kind::simplex) {
    EXPECT_GE(seen.with_faces, in_ci(10));
  }
}

TEST(SavedBody, SimplicesGoOnAsIfTheyHadNotStopped2) { test_twins<2>(Body_kind::simplex); }
TEST(SavedBody, SimplicesGoOnAsIfTheyHadNotStopped3) { test_twins<3>(Body_kind::simplex); }
TEST(SavedBody, RodsGoOnAsIfTheyHadNotStopped2) { test_twins<2>(Body_kind::rod); }
TEST(SavedBody, RodsGoOnAsIfTheyHadNotStopped3) { test_twins<3>(Body_kind::rod); }
TEST(SavedBody, BlocksGoOnAsIfTheyHadNotStopped2) { test_twins<2>(Body_kind::block); }
TEST(SavedBody, BlocksGoOnAsIfTheyHadNotStopped3) { test_twins<3>(Body_kind::block); }

Body_soup<3> tetrahedron(const Point<3>& corner) {
  Body_soup<3> soup;
  soup.points = {corner, corner + Vector<3>{0.25, 0, 0}, corner + Vector<3>{0, 0.25, 0},
                 corner + Vector<3>{0, 0, 0.25}};
  soup.edges = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  soup.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  return soup;
}

/// The message with which bytes are refused; empty if they are not.
std::string refusal(const Snapshot<3>& snapshot, const Bytes& bytes) {
  try {
    restore_body<3>(snapshot, bytes);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::input) << error.what();
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(SavedBody, FacesKeepTheWallsThatTheyRestOn) {
  const Snapshot<3> snapshot = rooms<3>({3, 1, 1}, {1});
  const Locator<3> locator(snapshot);
  Body<3> body(snapshot, locator, tetrahedron({0.5, 0.25, 0}));  // a face on the floor
  Body<3> twin = restore_body<3>(snapshot, save(body));
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  Body_counts counts, twin_counts;
  for (int k = 0; k < 4; ++k) {
    std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
    for (Point<3>& x : targets) x = x + Vector<3>{0.125, 0, k == 2 ? 0.125 : -0.125};
    Step_report<3> report, of_twin;
    body.step(targets, options, report, counts);
    twin.step(targets, options, of_twin, twin_counts);
    EXPECT_EQ(report.contacts.size(), of_twin.contacts.size());
    EXPECT_EQ(save(body), save(twin));
    twin = restore_body<3>(snapshot, save(twin));
  }
  EXPECT_TRUE(is_equal(counts, twin_counts));
  EXPECT_GT(counts.faces.faces, 0u);
}

TEST(SavedBody, DamagedBytesAreRefused) {
  const Snapshot<3> snapshot = rooms<3>({3, 1, 1}, {1});
  const Locator<3> locator(snapshot);
  const Bytes bytes = save(Body<3>(snapshot, locator, tetrahedron({0.5, 0.25, 0.25})));
  EXPECT_EQ(refusal(snapshot, bytes), "");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i >= 20 && i < 24) continue;  // not used
    Bytes changed = bytes;
    changed[i] ^= std::byte{0x10};
    EXPECT_NE(refusal(snapshot, changed), "") << "byte " << i;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal(snapshot, Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), "")
        << size << " bytes";
  Bytes longer = bytes;
  longer.push_back({});
  EXPECT_NE(refusal(snapshot, longer), "");
}

/// Words are changed, with a checksum that fits: what is restored can be used, if only to end in an Error.
TEST(SavedBody, ForgedBytesAreRefusedOrUsed) {
  const Snapshot<3> snapshot = rooms<3>({3, 1, 1}, {1});
  const Locator<3> locator(snapshot);
  Body<3> body(snapshot, locator, tetrahedron({0.5, 0.25, 0}));  // a face on the floor
  Body_counts counts;
  Step_report<3> report;
  Body_options options;
  options.sweep.sweep = Sweep::faces;
  std::vector<Point<3>> targets(body.positions().begin(), body.positions().end());
  for (Point<3>& x : targets) x = x + Vector<3>{0.125, 0.125, 0.125};
  body.step(targets, options, report, counts);
  const Bytes bytes = save(body);
  constexpr std::size_t head = 32, at_checksum = 24;
  int refused = 0, used = 0;
  for (std::size_t i = head; i + 4 <= bytes.size(); i += 2)
    for (const std::uint32_t value : {0u, 1u, 3u, 5u, 7u, 1u << 31, ~0u}) {
      Bytes changed = bytes;
      std::memcpy(changed.data() + i, &value, sizeof value);
      const std::uint64_t checksum = detail::checksum(std::span(changed).subspan(head));
      std::memcpy(changed.data() + at_checksum, &checksum, sizeof checksum);
      std::optional<Body<3>> restored;
      try {
        restored.emplace(restore_body<3>(snapshot, changed));
      } catch (const Error& error) {
        ASSERT_EQ(error.code(), Error_code::input) << error.what();
        ++refused;
        continue;
      }
      ++used;
      try {
        restored->step(targets, options, report, counts);
        restored->validate();
      } catch (const Error&) {  // regions that do not hold what they should
      }
    }
  EXPECT_GT(refused, 500);
  EXPECT_GT(used, 500);
}

TEST(SavedBody, OtherVersionsDimensionsAndEnvironmentsAreRefused) {
  const Snapshot<3> snapshot = rooms<3>({3, 1, 1}, {1}), other = rooms<3>({4, 1, 1}, {1}),
                    same_size = rooms<3>({3, 1, 1}, {0});
  const Locator<3> locator(snapshot);
  const Bytes bytes = save(Body<3>(snapshot, locator, tetrahedron({0.5, 0.25, 0.25})));
  EXPECT_TRUE(has(refusal(other, bytes), "in another environment"));
  EXPECT_TRUE(has(refusal(same_size, bytes), "does not fit this environment"));
  const auto with = [&](std::size_t place, std::uint32_t value) {
    Bytes changed = bytes;
    std::memcpy(changed.data() + place, &value, sizeof value);
    return changed;
  };
  EXPECT_TRUE(has(refusal(snapshot, with(8, 99)), "in version 99 of the format"));
  EXPECT_TRUE(has(refusal(snapshot, with(12, 0x04030201)), "another byte order"));
  EXPECT_TRUE(has(refusal(snapshot, with(0, 0)), "no saved body"));
  const Snapshot<2> flat = rooms<2>({3, 3});
  try {
    restore_body<2>(flat, bytes);
    FAIL() << "a body of 3D was restored in the plane";
  } catch (const Error& error) {
    EXPECT_TRUE(has(error.what(), "saved in 3D"));
  }
}

TEST(SavedBody, BodiesFromBeforeAnEditAreNotSaved) {
  Environment<3> environment = Environment<3>::build(hex_grid({.cells = {2, 1, 1}}));
  const Locator<3> locator(environment.snapshot());
  const Body<3> body(environment.snapshot(), locator, tetrahedron({0.25, 0.25, 0.25}));
  const Bytes bytes = save(body);
  for (std::size_t f = 0; f < 6; ++f) {
    const Half_facet facet = Snapshot<3>::half_facet(environment.snapshot().cell(0), f);
    if (environment.snapshot().neighbour(facet) != Cell::none) environment.set_impassable(facet, true);
  }
  EXPECT_THROW(save(body), Error);
  EXPECT_TRUE(has(refusal(environment.snapshot(), bytes), "or before an edit"));
}

}  // namespace
}  // namespace cellwalk::test
