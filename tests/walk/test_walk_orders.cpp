// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks are answers about a geometry: the order in which its cells, points and facets are listed, and the
// strategy, must not show.
#include <gtest/gtest.h>

#include <iostream>

#include "walk/oracle_trial.h"
#include "walk/reordered.h"

namespace cellwalk::oracle {
namespace {

constexpr std::uint64_t orders = 3;  ///< besides the first one
constexpr std::size_t motions_of_orders = 12'000;
constexpr std::size_t motions_of_world = 60;

enum class Difference { none, status, time, kind, feature, normal, side, dimension, count };
constexpr std::array<const char*, static_cast<std::size_t>(Difference::count)> names{
    "none", "status", "time", "kind", "feature", "normal", "side", "dimension"};

struct Compared {
  std::size_t motions = 0, answers = 0, contacts = 0, choices = 0, starts_on_sides = 0, other_cells = 0;
  std::array<std::size_t, static_cast<std::size_t>(Difference::count)> differences{};
  std::string first;

  std::size_t different() const { return answers - differences[0]; }
};

template <int D>
class Orders {
 public:
  Orders(std::uint64_t number, bool generic, Compared& seen)
      : world_(make_world<D>(number)),
        oracle_(world_.soup),
        source_(world_, number),
        generic_(generic),
        seen_(seen) {
    for (std::uint64_t k = 0; k <= orders; ++k)
      worlds_.emplace_back(world_.soup, k == 0 ? 0 : number * orders + k);
  }

  void run() {
    for (std::size_t k = 0; k < motions_of_world; ++k) move_once();
  }

 private:
  static constexpr std::array strategies{Walk_strategy::certified, Walk_strategy::exit_rule,
                                         Walk_strategy::predictive_simplex};

  void move_once() {
    const Motion_kind kind = source_.kind(generic_);
    if (!has_particle_ || kind == Motion_kind::in_wall_plane || kind == Motion_kind::along_edge ||
        source_.random().below(8) == 0)
      put_particles(kind);
    const Point<D> from = particles_[0].position, to = source_.target(kind, from, last_);
    const Trace trace = oracle_.trace(from, to);
    const Truth truth = judge(trace, worlds_[0].original_cell(particles_[0].cell));
    ++seen_.motions;
    seen_.choices += truth.choices > 0;
    std::array<Walk_result<D>, orders + 1> results;
    bool agree = true;
    for (std::size_t k = 0; k < worlds_.size(); ++k)
      for (const Walk_strategy strategy : strategies) {
        Walk_counts counts;
        const auto result = walk<Exact>(worlds_[k].snapshot, particles_[k], to, counts, strategy);
        if (strategy == Walk_strategy::certified) results[k] = result;
        if (k == 0 && strategy == Walk_strategy::certified) continue;
        agree &= is_alike(results[0], k, result, to, trace, truth);
      }
    // Nor may the cell in which the particle is registered, of those linked where it starts.
    const std::vector<int> linked = trace.classes_at(0);
    const int start = trace.visit_of(worlds_[0].original_cell(particles_[0].cell));
    for (std::size_t v = 0; v < linked.size(); ++v) {
      if (static_cast<int>(v) == start || linked[v] != linked[static_cast<std::size_t>(start)]) continue;
      Particle<D> particle = particles_[0];
      particle.cell = worlds_[0].cell(trace.visits[v].cell);
      Walk_counts counts;
      ++seen_.other_cells;
      agree &=
          is_alike(results[0], 0, walk<Exact>(worlds_[0].snapshot, particle, to, counts), to, trace, truth);
    }
    seen_.contacts += results[0].status == Walk_status::contact;
    has_particle_ = agree && results[0].status == Walk_status::arrived;
    if (!has_particle_) return;
    last_ = from;
    for (std::size_t k = 0; k < worlds_.size(); ++k) {
      particles_[k].position = to;
      particles_[k].cell = results[k].cell;
      particles_[k].dimension = results[k].dimension;
    }
  }

  bool is_alike(const Walk_result<D>& first, std::size_t k, const Walk_result<D>& result, const Point<D>& to,
                const Trace& trace, const Truth& truth) {
    const Difference difference = compare(first, k, result, trace, truth);
    ++seen_.answers;
    ++seen_.differences[static_cast<std::size_t>(difference)];
    if (difference == Difference::none) return true;
    if (seen_.first.empty()) {
      Case<D> motion;
      motion.from = particles_[0].position, motion.to = to;
      motion.start = worlds_[0].original_cell(particles_[0].cell);
      motion.trace = trace, motion.truth = truth;
      seen_.first = std::string(names[static_cast<std::size_t>(difference)]) + " in " + world_.name +
                    ", order " + std::to_string(k) + ": " + describe(motion);
    }
    return false;
  }

  /// All in the same cell.
  void put_particles(Motion_kind kind) {
    for (;;) {
      const Point<D> p = source_.start(kind);
      const Place place = oracle_.place(p);
      if (place.free_cells.empty()) continue;
      seen_.starts_on_sides += place.sides > 1;
      const std::size_t choice = source_.random().below(place.free_cells.size());
      for (std::size_t k = 0; k < worlds_.size(); ++k)
        particles_[k] = {p, worlds_[k].cell(place.free_cells[choice]),
                         static_cast<std::uint16_t>(place.dimensions[choice]), 0};
      last_ = p;
      has_particle_ = true;
      return;
    }
  }

  Difference compare(const Walk_result<D>& first, std::size_t k, const Walk_result<D>& other,
                     const Trace& trace, const Truth& truth) const {
    if (first.status != other.status) return Difference::status;
    int event = trace.last_event();
    if (first.contact) {
      // Times and normals of walks are rounded, within 4 ulp and a little more.
      constexpr double rounding = 1e-12;
      const auto &a = *first.contact, &b = *other.contact;
      const std::uint32_t cell = worlds_[0].original_cell(first.cell);
      for (const Stop& stop : truth.stops)
        if (stop.cell == cell) event = stop.event;
      const auto& time = trace.events[static_cast<std::size_t>(event)];
      if (!is_within_4_ulp(a.time, time) || !is_within_4_ulp(b.time, time)) return Difference::time;
      if (a.kind != b.kind) return Difference::kind;
      if (feature_of(worlds_[0].snapshot, a) != feature_of(worlds_[k].snapshot, b))
        return Difference::feature;
      if (length(a.normal - b.normal) > rounding) return Difference::normal;
    } else if (first.dimension != other.dimension) {
      return Difference::dimension;
    }
    const std::vector<int> classes = trace.classes_at(event);
    const int one = trace.visit_of(worlds_[0].original_cell(first.cell)),
              two = trace.visit_of(worlds_[k].original_cell(other.cell));
    const bool are_linked = one >= 0 && two >= 0 && classes[static_cast<std::size_t>(one)] >= 0 &&
                            classes[static_cast<std::size_t>(one)] == classes[static_cast<std::size_t>(two)];
    return are_linked ? Difference::none : Difference::side;
  }

  const World<D> world_;
  const Oracle<D> oracle_;
  Motion_source<D> source_;
  const bool generic_;
  Compared& seen_;
  std::vector<Reordered_world<D>> worlds_;
  std::array<Particle<D>, orders + 1> particles_;
  bool has_particle_ = false;
  Point<D> last_{};
};

template <int D>
Compared compare_orders(bool generic) {
  Compared seen;
  const std::size_t total = scaled_count(motions_of_orders);
  for (std::uint64_t number = 6'000'000; seen.motions < total; ++number)
    Orders<D>(number, generic, seen).run();
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.motions << " motions, "
            << seen.contacts << " contacts, " << seen.choices << " with a choice of side; " << seen.answers
            << " answers compared, " << seen.different() << " differ:";
  for (std::size_t d = 1; d < names.size(); ++d) std::cout << ' ' << names[d] << ' ' << seen.differences[d];
  std::cout << '\n';
  EXPECT_EQ(seen.different(), 0u) << seen.first;
  EXPECT_GT(seen.contacts, seen.motions / 5);
  if (!generic) {
    EXPECT_GT(seen.choices, seen.motions / 200);
    EXPECT_GT(seen.starts_on_sides, seen.motions / 100);
    EXPECT_GT(seen.other_cells, seen.motions / 2);
  }
  return seen;
}

TEST(WalkOrders, DoNotShow2) {
  for (const bool generic : {true, false}) compare_orders<2>(generic);
}
TEST(WalkOrders, DoNotShow3) {
  for (const bool generic : {true, false}) compare_orders<3>(generic);
}

}  // namespace
}  // namespace cellwalk::oracle
