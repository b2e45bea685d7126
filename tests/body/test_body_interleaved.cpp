// SPDX-License-Identifier: LGPL-3.0-or-later
// What a body was asked before must not show in what it answers now: sweeps, policies, regions free of walls,
// registering and checking in any order against the same moves without regions, registered after each, and
// against a body made anew where it stands.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/gluing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>

#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Interleaved_seen {
  int bodies = 0, calls = 0, threw = 0, made_anew = 0, different = 0, invalid = 0;
  int by_segments = 0, by_faces = 0, by_rule = 0, single = 0;
  std::size_t contacts = 0, blocked = 0;
  std::string first;
  Body_counts counts, plain_counts;

  void note(const std::string& what) {
    ++different;
    if (first.empty()) first = what;
  }
};

/// What a call answered.
template <int D>
struct Answer {
  Step_report<D> report;
  std::optional<Error_code> error;
};

template <int D>
std::string difference(const Answer<D>& a, const Answer<D>& b) {
  if (a.error != b.error) return "an error";
  const auto &of_a = a.report.contacts, &of_b = b.report.contacts;
  if (of_a.size() != of_b.size()) return "the number of contacts";
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Contact<D>&x = of_a[i], &y = of_b[i];
    if (x.vertex != y.vertex) return "the vertex of a contact";
    if (x.time != y.time) return "the time of a contact";
    if (x.body != y.body || x.kind != y.kind || x.feature != y.feature) return "the feature of a contact";
  }
  const auto equal = [](const Rejected_move<D>& x, const Rejected_move<D>& y) {
    return x.vertex == y.vertex && x.is_vertex_blocked == y.is_vertex_blocked && x.edges == y.edges &&
           x.swept_edges == y.swept_edges;
  };
  if (!std::ranges::equal(a.report.blocked, b.report.blocked, equal)) return "what blocks";
  return {};
}

template <int D>
class Interleaving {
 public:
  /// \param parts of each body, which no edge joins
  Interleaving(std::uint64_t number, bool generic, int parts, Interleaved_seen& seen)
      : world_(oracle::make_world<D>(number)),
        snapshot_(Snapshot<D>::compile(world_.soup, glue(world_.soup))),
        locator_(snapshot_),
        source_(world_, number),
        generic_(generic),
        parts_(parts),
        has_slits_(has_slits(number % oracle::world_kinds)),
        seen_(seen) {}

  void run(int bodies, int calls) {
    for (int k = 0; k < bodies; ++k) {
      const Body_soup<D> soup = make_body();
      std::optional<Body<D>> body;
      try {
        body.emplace(snapshot_, locator_, soup);
      } catch (const Error&) {  // no room there
        continue;
      }
      ++seen_.bodies;
      follow(*body, calls);
    }
  }

 private:
  static bool has_slits(std::uint64_t kind) { return kind == 9 || kind == 10 || kind >= 12; }
  Random& random() { return source_.random(); }
  double eighths(int most) { return (static_cast<double>(random().below(2 * most + 1)) - most) / 8; }

  oracle::Motion_kind kind() {
    using oracle::Motion_kind;
    for (;;) {
      const Motion_kind kind = source_.kind(generic_);
      if (kind != Motion_kind::in_wall_plane && kind != Motion_kind::along_edge) return kind;
    }
  }

  Body_soup<D> make_body() {
    Body_soup<D> soup;
    for (int k = 0; k < parts_; ++k) add_simplex(soup);
    return soup;
  }

  /// A simplex: small, or with corners anywhere. Of several, one that has room.
  void add_simplex(Body_soup<D>& body) {
    for (int tried = 0;; ++tried) {
      const Body_soup<D> simplex = make_simplex();
      if (parts_ > 1 && tried < 20 && !has_room(simplex)) continue;
      const auto first = static_cast<std::uint32_t>(body.points.size());
      body.points.insert(body.points.end(), simplex.points.begin(), simplex.points.end());
      for (const auto& [u, v] : simplex.edges) body.edges.push_back({first + u, first + v});
      for (const auto& [u, v, w] : simplex.faces) body.faces.push_back({first + u, first + v, first + w});
      return;
    }
  }

  bool has_room(const Body_soup<D>& soup) const {
    try {
      Body<D>(snapshot_, locator_, soup);
    } catch (const Error&) {
      return false;
    }
    return true;
  }

  Body_soup<D> make_simplex() {
    Body_soup<D> soup;
    const oracle::Motion_kind of_start = kind();
    const Point<D> first = source_.start(of_start);
    const bool small = random().below(2) == 0;
    const double size = cell_size() / 4;
    for (std::uint32_t v = 0; v <= D; ++v) {
      Point<D> x = v == 0 ? first : source_.target(of_start, first, first);
      if (small && v > 0)
        for (std::size_t i = 0; i < D; ++i)
          x[i] = first[i] + size * (generic_ ? random().real(-1, 1) : eighths(8));
      soup.points.push_back(x);
      for (std::uint32_t u = 0; u < v; ++u) soup.edges.push_back({u, v});
    }
    if (D == 3) soup.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    return soup;
  }

  double cell_size() const {
    const auto loop = world_.soup.facet(0);
    return length(world_.soup.points[loop[1]] - world_.soup.points[loop[0]]);
  }

  /// All corners a little the same way, or some of them anywhere.
  std::vector<Point<D>> targets(const Body<D>& body) {
    std::vector<Point<D>> result(body.positions().begin(), body.positions().end());
    if (random().below(3) > 0) {
      if (random().below(4) == 0)
        for (double& x : drift_) x = cell_size() * (generic_ ? random().real(-0.2, 0.2) : eighths(2));
      for (Point<D>& x : result) x = x + drift_;
      return result;
    }
    for (Point<D>& x : result)
      if (random().below(2) == 0) x = source_.target(kind(), x, x);
    return result;
  }

  enum class Call { step, step_at_target, move_vertex };

  Body_options options(Call call) {
    Body_options options;
    const auto sweep = random().below(3);
    options.sweep.sweep = sweep == 0                 ? Sweep::three_segments
                          : sweep == 1 || has_slits_ ? Sweep::triangle
                                                     : Sweep::faces;
    if (random().below(3) == 0) options.policy = Contact_policy::reject;
    options.most_contacts = 1 + static_cast<int>(random().below(4));
    if (call == Call::step_at_target) {
      options.policy = Contact_policy::reject;
      options.edges = Edge_rule::at_target;
      options.reported = seen_.calls % 2 == 0 ? Reported::contacts : Reported::blocked;
    }
    return options;
  }

  Answer<D> call(Body<D>& body, Call call, std::span<const Point<D>> targets, std::uint32_t vertex,
                 const Body_options& options, Body_counts& counts) {
    Answer<D> answer;
    try {
      if (call != Call::move_vertex)
        body.step(targets, options, answer.report, counts);
      else if (auto contact = body.move_vertex(vertex, targets[vertex], options, counts))
        answer.report.contacts.push_back(*contact);
    } catch (const Error& error) {
      answer.error = error.code();
    }
    return answer;
  }

  void follow(Body<D>& body, int calls) {
    Body<D> plain = body;
    for (int k = 0; k < calls; ++k) {
      const auto to = targets(body);
      const auto vertex = static_cast<std::uint32_t>(random().below(to.size()));
      const auto which = random().below(4);
      const Call kind = which < 2 ? Call::step : which == 2 ? Call::step_at_target : Call::move_vertex;
      Body_options some = options(kind);
      const Body_options with_region = some;
      some.clearance = false;
      Body_options here = with_region;
      here.clearance = random().below(4) > 0;
      ++seen_.calls;
      seen_.by_segments += some.sweep.sweep == Sweep::three_segments;
      seen_.by_faces += D == 3 && some.sweep.sweep == Sweep::faces;
      seen_.by_rule += kind == Call::step_at_target;
      seen_.single += kind == Call::move_vertex;
      std::optional<Body<D>> anew = made_anew(body);
      const Answer<D> answer = call(body, kind, to, vertex, here, seen_.counts);
      const Answer<D> expected = call(plain, kind, to, vertex, some, seen_.plain_counts);
      seen_.contacts += expected.report.contacts.size();
      seen_.blocked += expected.report.blocked.size();
      seen_.threw += expected.error.has_value();
      const std::string name = world_.name + ", call " + std::to_string(k) + ": ";
      std::string what = difference(answer, expected);
      if (what.empty() && !std::ranges::equal(body.positions(), plain.positions())) what = "where it stands";
      if (!what.empty()) return seen_.note(name + what);
      if (anew && some.sweep.sweep != Sweep::faces) {
        ++seen_.made_anew;
        what = difference(call(*anew, kind, to, vertex, here, seen_.counts), expected);
        if (what.empty() && !std::ranges::equal(anew->positions(), plain.positions()))
          what = "where it stands";
        if (!what.empty()) return seen_.note(name + what + ", made anew");
      }
      if (expected.error) return;
      if (!disturb(body, name) || !check(plain, name)) return;
    }
  }

  /// What must change nothing.
  bool disturb(Body<D>& body, const std::string& name) {
    switch (random().below(6)) {
      case 0:
        body.refresh(seen_.counts);
        break;
      case 1:
        body.leave_region(seen_.counts);
        break;
      case 2:
        return check(body, name);
      case 3: {
        const Body<D> copy = body;
        body = copy;
        break;
      }
      default:
        break;
    }
    return true;
  }

  bool check(Body<D>& body, const std::string& name) {
    body.refresh(seen_.counts);
    try {
      body.validate();
    } catch (const Error& error) {
      ++seen_.invalid;
      seen_.note(name + error.what());
      return false;
    }
    return true;
  }

  /// A body without faces that is registered where this one stands; in general position only, where there is
  /// one way to do it.
  std::optional<Body<D>> made_anew(const Body<D>& body) {
    if (!generic_ || random().below(3) > 0) return {};
    Body_soup<D> soup;
    soup.points.assign(body.positions().begin(), body.positions().end());
    soup.edges.assign(body.edges().begin(), body.edges().end());
    for (const Point<D>& x : soup.points)
      if (locator_.locate(x).dimension != D) return {};  // it stopped at a wall
    return Body<D>(snapshot_, locator_, soup);
  }

  const oracle::World<D> world_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  oracle::Motion_source<D> source_;
  const bool generic_;
  const int parts_;
  const bool has_slits_;  ///< among which no faces are swept
  Interleaved_seen& seen_;
  Vector<D> drift_{};
};

/// Worlds that no other test has.
constexpr std::uint64_t first_interleaved_world = 3'000'000 * oracle::world_kinds;

/// Of so many parts, a body has regions for parts of it.
constexpr int many_parts = 12;

template <int D>
void test_interleaved(int parts) {
  const std::size_t worlds = oracle::scaled_count(4 * oracle::world_kinds);
  for (const bool generic : {true, false}) {
    Interleaved_seen seen;
    for (std::uint64_t number = 0; number < worlds; ++number)
      Interleaving<D>(first_interleaved_world + number, generic, parts, seen).run(parts == 1 ? 12 : 2, 16);
    std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.bodies << " bodies, "
              << seen.calls << " calls (" << seen.by_segments << " by three segments, " << seen.by_faces
              << " by faces, " << seen.by_rule << " with edges at their targets, " << seen.single
              << " of one vertex), " << seen.contacts << " contacts, " << seen.blocked
              << " blocked; in regions " << seen.counts.in_region << " of " << seen.counts.moves
              << " moves, caught up " << seen.counts.catch_ups << "; made anew " << seen.made_anew
              << ", refused " << seen.threw << "; different " << seen.different << ", invalid "
              << seen.invalid << "\n";
    EXPECT_EQ(seen.different, 0) << seen.first;
    if (worlds < 4 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.bodies, parts == 1 ? 100 : 50);
    EXPECT_GT(seen.contacts, 1'000u);
    EXPECT_GT(seen.blocked, 300u);
    EXPECT_GT(seen.counts.in_region, 200u);
    EXPECT_GT(seen.counts.catch_ups, 100u);
    if (generic && parts == 1) {
      EXPECT_GT(seen.made_anew, 100);
    }
  }
}

TEST(BodyInterleaved, NothingAskedBeforeShows2) { test_interleaved<2>(1); }
TEST(BodyInterleaved, NothingAskedBeforeShows3) { test_interleaved<3>(1); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfManyParts2) { test_interleaved<2>(many_parts); }
TEST(BodyInterleaved, NothingAskedBeforeShowsOfManyParts3) { test_interleaved<3>(many_parts); }

}  // namespace
}  // namespace cellwalk::test
