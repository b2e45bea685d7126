// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies in the same geometry listed in another order: registered alike, stopped alike, to the bit.
#include <cellwalk/body/body.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "walk/oracle_trial.h"
#include "walk/reordered.h"

namespace cellwalk::test {
namespace {

struct Body_orders_seen {
  int bodies = 0, refused = 0, steps = 0, on_walls = 0;
  int registered_otherwise = 0, contacts_otherwise = 0, stands_elsewhere = 0;
  std::size_t contacts = 0, blocked = 0;
  std::string first;

  int different() const { return registered_otherwise + contacts_otherwise + stands_elsewhere; }
  void note(int& count, const std::string& what) {
    ++count;
    if (different() <= 5) (first += "\n  ") += what;
  }
};

template <int D>
class Body_in_orders {
 public:
  Body_in_orders(std::uint64_t number, bool generic, Body_orders_seen& seen)
      : world_(oracle::make_world<D>(number)),
        oracle_(world_.soup),
        source_(world_, number),
        generic_(generic),
        has_slits_(has_slits(number % oracle::world_kinds)),
        seen_(seen) {
    for (std::uint64_t k = 0; k < orders; ++k) {
      worlds_.push_back(
          std::make_unique<oracle::Reordered_world<D>>(world_.soup, k == 0 ? 0 : number * orders + k));
      locators_.emplace_back(worlds_.back()->snapshot);
    }
  }

  void run(int bodies, int steps) {
    for (int k = 0; k < bodies; ++k) {
      const Body_soup<D> soup = make_body();
      std::vector<Body<D>> in_orders;
      for (std::size_t i = 0; i < orders; ++i) try {
          in_orders.emplace_back(worlds_[i]->snapshot, locators_[i], soup);
        } catch (const Error&) {
        }
      if (in_orders.size() == orders) {
        ++seen_.bodies;
        if (are_on_the_same_sides(in_orders))
          follow(in_orders, steps);
        else
          seen_.note(seen_.registered_otherwise, world_.name + ": on other sides of walls");
      } else {
        ++seen_.refused;
        if (!in_orders.empty())
          seen_.note(seen_.registered_otherwise, world_.name + ": refused in some orders");
      }
    }
  }

 private:
  static constexpr std::uint64_t orders = 3;
  static bool has_slits(std::uint64_t kind) { return kind == 9 || kind == 10 || kind >= 12; }
  Random& random() { return source_.random(); }

  oracle::Motion_kind kind() {
    using oracle::Motion_kind;
    for (;;) {
      const Motion_kind kind = source_.kind(generic_);
      if (kind != Motion_kind::in_wall_plane && kind != Motion_kind::along_edge) return kind;
    }
  }

  Body_soup<D> make_body() {
    Body_soup<D> soup;
    const oracle::Motion_kind of_start = kind();
    const Point<D> first = source_.start(of_start);
    for (std::uint32_t v = 0; v < 3; ++v) {
      const Point<D> x = v == 0 ? first : source_.target(of_start, first, first);
      soup.points.push_back(v == 0 || random().below(2) == 0 ? x : first + 0.125 * (x - first));
      for (std::uint32_t u = 0; u < v; ++u) soup.edges.push_back({u, v});
    }
    if (D == 3 && !has_slits_) soup.faces = {{0, 1, 2}};
    return soup;
  }

  bool are_on_the_same_sides(const std::vector<Body<D>>& bodies) const {
    for (std::size_t v = 0; v < bodies[0].vertex_count(); ++v) {
      const Point<D>& x = bodies[0].positions()[v];
      const oracle::Trace here = oracle_.trace(x, x);
      const std::vector<int> classes = here.classes_at(0);
      const auto side = [&](std::size_t i) {
        const auto cell = worlds_[i]->original_cell(bodies[i].particles()[v].cell);
        return classes[static_cast<std::size_t>(here.visit_of(cell))];
      };
      for (std::size_t i = 1; i < orders; ++i)
        if (side(i) != side(0)) return false;
    }
    return true;
  }

  void follow(std::vector<Body<D>>& bodies, int steps) {
    for (const Point<D>& x : bodies[0].positions()) seen_.on_walls += locators_[0].locate(x).sides.size() > 1;
    for (int step = 0; step < steps; ++step) {
      std::vector<Point<D>> to(bodies[0].positions().begin(), bodies[0].positions().end());
      for (Point<D>& x : to)
        if (random().below(3) > 0) x = source_.target(kind(), x, x);
      const bool by_rule = random().below(3) == 0;
      Body_options options;
      const auto sweep = random().below(3);
      options.sweep.sweep = sweep == 0                 ? Sweep::three_segments
                            : sweep == 1 || has_slits_ ? Sweep::triangle
                                                       : Sweep::faces;
      const bool rejects = random().below(2) == 0;
      options.rule = by_rule ? Step_rule::reject_at_target : rejects ? Step_rule::reject : Step_rule::slide;
      options.reports_blocked = seen_.steps % 2 != 0;
      options.clearance = random().below(2) == 0;
      ++seen_.steps;
      Step_report<D> first;
      bool refused = false;
      for (std::size_t i = 0; i < orders; ++i) {
        Step_report<D> report;
        Body_counts counts;
        bool is_refused = false;
        try {
          bodies[i].step(to, options, report, counts);
        } catch (const Error&) {  // a wall pierces a face that was not swept before
          is_refused = true;
        }
        if (i == 0) refused = is_refused;
        if (is_refused != refused)
          return seen_.note(seen_.contacts_otherwise, world_.name + ": refused in some orders");
        if (i == 0) {
          seen_.contacts += report.contacts.size();
          seen_.blocked += report.blocked.size();
          first = std::move(report);
          continue;
        }
        const std::string name = world_.name + ", order " + std::to_string(i) + ", step " +
                                 std::to_string(step) +
                                 (by_rule   ? ", edges at their targets"
                                  : rejects ? ", rejected"
                                            : "");
        const std::string what = difference(first.contacts, report.contacts, i);
        if (!what.empty()) return seen_.note(seen_.contacts_otherwise, name + what);
        if (!are_alike(first.blocked, report.blocked))
          return seen_.note(seen_.contacts_otherwise, name + ": blocked");
        if (!std::ranges::equal(bodies[0].positions(), bodies[i].positions()))
          return seen_.note(seen_.stands_elsewhere, name + ": stands elsewhere");
      }
      if (refused) return;
    }
  }

  std::string difference(const std::vector<Contact<D>>& some, const std::vector<Contact<D>>& others,
                         std::size_t order) const {
    if (some.size() != others.size()) return ": as many contacts";
    for (std::size_t c = 0; c < some.size(); ++c) {
      const Contact<D>&x = some[c], &y = others[c];
      if (some[c].vertex != others[c].vertex) return ": the vertex of a contact";
      if (x.exact_time() != y.exact_time()) return ": the time of a contact";
      if (x.body != y.body || x.feature != y.feature) return ": what of the body is met";
      if (x.kind != y.kind) return ": the kind of what it meets";
      if (x.normal != y.normal) return ": the normal of a contact";
      // Of features of one kind that a face meets at the same time, that of the lowest half-facet is named.
      if (x.body == Body_feature::face) continue;
      if (oracle::feature_of(worlds_[0]->snapshot, x) != oracle::feature_of(worlds_[order]->snapshot, y))
        return ": what it meets";
      if (x.point != y.point) return ": the point of a contact";
    }
    return {};
  }

  bool are_alike(const std::vector<Rejected_move<D>>& some,
                 const std::vector<Rejected_move<D>>& others) const {
    return std::equal(some.begin(), some.end(), others.begin(), others.end(),
                      [](const auto& x, const auto& y) {
                        return x.vertex == y.vertex && x.is_vertex_blocked == y.is_vertex_blocked &&
                               x.edges == y.edges && x.swept_edges == y.swept_edges;
                      });
  }

  const oracle::World<D> world_;
  const oracle::Oracle<D> oracle_;
  oracle::Motion_source<D> source_;
  const bool generic_;
  const bool has_slits_;  ///< among which no faces are swept
  Body_orders_seen& seen_;
  std::vector<std::unique_ptr<oracle::Reordered_world<D>>> worlds_;
  std::vector<Locator<D>> locators_;
};

template <int D>
void test_body_orders() {
  const std::size_t worlds = oracle::scaled_count(4 * oracle::world_kinds);
  constexpr std::uint64_t first_world = 4'000'000 * oracle::world_kinds;
  for (const bool generic : {true, false}) {
    Body_orders_seen seen;
    for (std::uint64_t number = 0; number < worlds; ++number)
      Body_in_orders<D>(first_world + number, generic, seen).run(12, 8);
    std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.bodies << " bodies, "
              << seen.on_walls << " vertices on walls with several sides, " << seen.refused << " refused, "
              << seen.steps << " steps, " << seen.contacts << " contacts, " << seen.blocked
              << " blocked; registered otherwise " << seen.registered_otherwise << ", other contacts "
              << seen.contacts_otherwise << ", stands elsewhere " << seen.stands_elsewhere << "\n";
    EXPECT_EQ(seen.different(), 0) << seen.first;
    if (worlds < 4 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.bodies, 100);
    EXPECT_GT(seen.contacts, 500u);
    EXPECT_GT(seen.blocked, 100u);
    if (!generic) {
      EXPECT_GT(seen.on_walls, 30);
    }
  }
}

TEST(BodyOrders, DoNotShow2) { test_body_orders<2>(); }
TEST(BodyOrders, DoNotShow3) { test_body_orders<3>(); }

}  // namespace
}  // namespace cellwalk::test
