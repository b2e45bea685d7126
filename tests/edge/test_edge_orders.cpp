// SPDX-License-Identifier: LGPL-3.0-or-later
// Sweeps are answers about a geometry: neither the order in which it is listed nor the certificates tried may
// show, in the answer, its time and feature, or the side of walls on which the edge comes to lie.
#include <cellwalk/edge/sweep.h>

#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <numeric>
#include <sstream>

#include "edge/edge_worlds.h"
#include "edge/sweep_judge.h"
#include "edge/thin_worlds.h"
#include "oracle/squares_and_cubes.h"
#include "walk/oracle_trial.h"
#include "walk/reordered.h"

namespace cellwalk::test {
namespace {

enum class Differs { nowhere, start, answer, time, body, kind, feature, normal, chain, count };
constexpr std::array<const char*, static_cast<std::size_t>(Differs::count)> difference_names{
    "none", "start", "answer", "time", "body", "kind", "feature", "normal", "chain"};
using Differences = std::array<int, static_cast<std::size_t>(Differs::count)>;

struct Orders_seen {
  int sweeps = 0, contacts = 0, by_edge = 0, moved = 0, compared = 0;
  /// Edges placed; and those whose first walk takes a wrong side.
  int with_chain = 0, without_chain = 0, found_at_last = 0;
  Differences of_orders{}, of_certificates{};
  std::string first;

  int different() const {
    return std::accumulate(of_orders.begin() + 1, of_orders.end(), 0) +
           std::accumulate(of_certificates.begin() + 1, of_certificates.end(), 0);
  }
};

/// One world in several orders, and an edge in each of them.
template <int D>
class Edge_in_orders {
 public:
  Edge_in_orders(Edge_world<D>& w, std::uint64_t seed, Orders_seen& seen)
      : w_(w), oracle_(w.world.soup), seen_(seen) {
    for (std::uint64_t k = 0; k < orders; ++k)
      worlds_.emplace_back(w.world.soup, k == 0 ? 0 : seed * orders + k);
  }

  void run(int edges, int steps) {
    for (int k = 0; k < edges; ++k) {
      if (!place()) continue;
      for (int step = 0; step < steps; ++step) {
        w_.choose_kind();
        if (!move(w_.target(edges_[0].p))) break;
      }
    }
  }

 private:
  static constexpr std::uint64_t orders = 3;
  struct Edge {
    Particle<D> p, q;
    Chain chain;
  };

  bool place() {
    const Particle<D> p = w_.start();
    if (p.cell == Cell::none) return false;
    const Particle<D> q = w_.end(p);
    if (q.cell == Cell::none) return false;
    bool is_free = true;
    for (std::size_t k = 0; k < orders; ++k) {
      Edge& edge = edges_[k];
      edge.p = p, edge.q = q;
      edge.p.cell = worlds_[k].cell(w_.snapshot.index(p.cell));
      edge.q.cell = worlds_[k].cell(w_.snapshot.index(q.cell));
      const auto found = find_chain(worlds_[k].snapshot, edge.p, edge.q, counts_.walk);
      const bool here = !found.contact;
      if (k == 0) check_existence(edge, here);
      edge.chain = found.chain;
      Differs differs = Differs::nowhere;
      if (k > 0 &&
          (is_free != here || (here && !are_equal(edges_[0].p, edges_[0].chain, k, edge.p, edge.chain))))
        differs = Differs::start;
      note(differs, seen_.of_orders, "order " + std::to_string(k), q.position);
      is_free = (k == 0 || is_free) && here && differs == Differs::nowhere;
    }
    return is_free;
  }

  /// A chain is found if there is one, by trying all ways at the latest.
  void check_existence(const Edge& edge, bool is_found) {
    const bool is_there =
        oracle_.has_chain(edge.p.position, edge.q.position, worlds_[0].original_cell(edge.p.cell),
                          worlds_[0].original_cell(edge.q.cell));
    const bool is_found_at_last = !find_any_chain(w_.snapshot, edge.p, edge.q, counts_.walk).contact;
    EXPECT_EQ(is_found_at_last, is_there) << w_.world.name;
    EXPECT_LE(is_found, is_there) << w_.world.name;
    seen_.found_at_last += is_there && !is_found;
    ++(is_there ? seen_.with_chain : seen_.without_chain);
  }

  /// False if the answers differ.
  bool move(const Point<D>& target) {
    target_ = target;
    ++seen_.sweeps;
    std::array<Sweep_result<D>, orders> complete;
    bool agree = true;
    for (const Sweep sweep : {Sweep::three_segments, Sweep::triangle}) {
      Sweep_result<D> first;
      for (std::size_t k = 0; k < orders; ++k) {
        const Sweep_result<D> result = answer(k, {.sweep = sweep});
        if (k == 0) first = result;
        if (sweep == Sweep::triangle) complete[k] = result;
        const Differs differs = k == 0 ? Differs::nowhere : compare(first, k, result);
        note(differs, seen_.of_orders,
             std::string(sweep == Sweep::triangle ? "triangle" : "three segments") + ", order " +
                 std::to_string(k),
             target);
        agree &= differs == Differs::nowhere;
      }
      const Differs differs = compare(first, 0, answer(0, {.sweep = sweep, .certificates = false}));
      note(differs, seen_.of_certificates,
           std::string(sweep == Sweep::triangle ? "triangle" : "three segments") + ", without certificates",
           target);
    }
    seen_.contacts += complete[0].contact.has_value();
    seen_.by_edge += complete[0].contact && complete[0].contact->body == Body_feature::edge;
    if (!agree || complete[0].contact) return agree;
    ++seen_.moved;
    for (std::size_t k = 0; k < orders; ++k) {
      edges_[k].p = complete[k].p;
      edges_[k].chain = complete[k].chain;
    }
    return true;
  }

  Sweep_result<D> answer(std::size_t k, const Sweep_options& options) {
    return sweep_edge(worlds_[k].snapshot, edges_[k].p, target_, edges_[k].q, edges_[k].chain, options,
                      counts_);
  }

  Differs compare(const Sweep_result<D>& first, std::size_t k, const Sweep_result<D>& other) const {
    if (first.contact.has_value() != other.contact.has_value()) return Differs::answer;
    if (!first.contact)
      return are_equal(first.p, first.chain, k, other.p, other.chain) ? Differs::nowhere : Differs::chain;
    const Contact<D>&a = *first.contact, &b = *other.contact;
    if (a.exact_time() != b.exact_time()) return Differs::time;
    if (a.body != b.body) return Differs::body;
    if (a.kind != b.kind) return Differs::kind;
    if (oracle::feature_of(worlds_[0].snapshot, a) != oracle::feature_of(worlds_[k].snapshot, b))
      return Differs::feature;
    constexpr double rounding = 1e-9;
    return length(a.normal - b.normal) > rounding ? Differs::normal : Differs::nowhere;
  }

  oracle::Placed_chain placed(std::size_t k, const Particle<D>& p, const Chain& chain) const {
    oracle::Placed_chain placed{
        worlds_[k].original_cell(p.cell), worlds_[k].original_cell(edges_[k].q.cell), {}};
    for (const Half_facet f : chain) placed.facets.push_back(worlds_[k].original_facet(f));
    return placed;
  }
  bool are_equal(const Particle<D>& p, const Chain& chain, std::size_t k, const Particle<D>& other_p,
                 const Chain& other) const {
    return oracle_.are_equal(p.position, edges_[0].q.position, placed(0, p, chain),
                             placed(k, other_p, other));
  }

  void note(Differs differs, Differences& seen, const std::string& what, const Point<D>& target) {
    ++seen_.compared;
    ++seen[static_cast<std::size_t>(differs)];
    if (differs == Differs::nowhere || !seen_.first.empty()) return;
    std::ostringstream text;
    text << difference_names[static_cast<std::size_t>(differs)] << " in " << w_.world.name << ", " << what
         << std::hexfloat << ": p in cell " << worlds_[0].original_cell(edges_[0].p.cell) << " at";
    for (const double x : edges_[0].p.position) text << ' ' << x;
    text << " to";
    for (const double x : target) text << ' ' << x;
    text << ", q in cell " << worlds_[0].original_cell(edges_[0].q.cell) << " at";
    for (const double x : edges_[0].q.position) text << ' ' << x;
    seen_.first = text.str();
  }

  Edge_world<D>& w_;
  const oracle::Chain_oracle<D> oracle_;
  Orders_seen& seen_;
  std::vector<oracle::Reordered_world<D>> worlds_;
  std::array<Edge, orders> edges_;
  Point<D> target_{};
  Edge_counts counts_;
};

void report(const std::string& name, const Orders_seen& seen) {
  std::cout << name << ": " << seen.sweeps << " sweeps, " << seen.contacts << " contacts, " << seen.by_edge
            << " of the edge, " << seen.moved << " moves; placed " << seen.with_chain << " with a chain ("
            << seen.found_at_last << " found by trying all ways), " << seen.without_chain << " without; "
            << seen.compared << " answers compared; orders differ in";
  for (std::size_t d = 1; d < difference_names.size(); ++d)
    std::cout << ' ' << difference_names[d] << ' ' << seen.of_orders[d];
  std::cout << "; certificates in";
  for (std::size_t d = 1; d < difference_names.size(); ++d)
    std::cout << ' ' << difference_names[d] << ' ' << seen.of_certificates[d];
  std::cout << '\n';
}

/// Worlds that no other test has.
constexpr std::uint64_t first_world_of_orders = 2'000'000 * oracle::world_kinds;

template <int D>
void test_orders() {
  const std::size_t worlds = oracle::scaled_count(2 * oracle::world_kinds);
  for (const bool generic : {true, false}) {
    Orders_seen seen;
    for (std::uint64_t number = first_world_of_orders; number < first_world_of_orders + worlds; ++number) {
      Edge_world<D> w(number, generic);
      Edge_in_orders<D>(w, number, seen).run(24, 5);
    }
    report(std::to_string(D) + (generic ? "D, generic" : "D, degenerate"), seen);
    EXPECT_EQ(seen.different(), 0) << seen.first;
    if (worlds < 2 * oracle::world_kinds) continue;  // too few to meet everything
    EXPECT_GT(seen.sweeps, 1'000);
    EXPECT_GT(seen.contacts, 400);
    EXPECT_GT(seen.by_edge, 80);
    EXPECT_GT(seen.moved, 400);
  }
}

TEST(EdgeOrders, DoNotShow2) { test_orders<2>(); }
TEST(EdgeOrders, DoNotShow3) { test_orders<3>(); }

template <int D>
void test_sliding_orders() {
  const std::size_t worlds = oracle::scaled_count(12);
  Orders_seen seen;
  for (std::uint64_t number = 0; number < worlds; ++number) {
    Edge_world<D> w(sheets<D>(number), number, false);
    w.slides = true;
    Edge_in_orders<D>(w, number + 1, seen).run(24, 5);
  }
  report(std::to_string(D) + "D, sliding", seen);
  EXPECT_EQ(seen.different(), 0) << seen.first;
}

TEST(EdgeOrders, DoNotShowWhereEdgesSlide2) { test_sliding_orders<2>(); }
TEST(EdgeOrders, DoNotShowWhereEdgesSlide3) { test_sliding_orders<3>(); }

/// An edge at the rim of a membrane turns into its plane, its moving end along another rim, and may pass the
/// membrane on both sides. The certificate of the same cell takes the lower one, the events the upper one.
TEST(EdgeOrders, CertificatesTakeTheSameSideOfAMembrane3) {
  Cell_soup<3> cubes = oracle::make_cubes(3, 3, 2);
  const std::uint32_t below = 4, above = 13;
  oracle::set_wall(cubes, below, above);
  const Snapshot<3> snapshot = Snapshot<3>::compile(cubes, glue(cubes));
  const oracle::Chain_oracle<3> oracle(cubes);
  const Point<3> target{1.5, 2, 1};
  const Particle<3> p{{1, 2, 1}, snapshot.cell(below), 0}, q{{1, 1.25, 1}, snapshot.cell(below), 1};
  Walk_counts walks;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  Particle<3> to = p;
  ASSERT_FALSE(move(snapshot, to, target, walks, {&visited, &crossed}).contact);
  std::vector<oracle::Placed_chain> chains;
  for (const bool has_certificates : {true, false}) {
    Edge_counts counts;
    const auto swept =
        sweep_triangle<3>(snapshot, {p, to, visited, crossed}, q, {}, counts, has_certificates);
    ASSERT_FALSE(swept.contact);
    chains.push_back({snapshot.index(to.cell), below, soup_chain(cubes, snapshot, swept.chain)});
  }
  EXPECT_TRUE(oracle.are_equal(target, q.position, chains[0], chains[1]));
}

}  // namespace
}  // namespace cellwalk::test
