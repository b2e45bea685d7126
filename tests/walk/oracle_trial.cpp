// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walk/oracle_trial.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace cellwalk::oracle {
namespace {

template <int D>
class Trial {
 public:
  Trial(const std::vector<Walker_under_test<D>>& walkers, const Trial_options<D>& options,
        std::uint64_t world, Tally& tally)
      : walkers_(walkers),
        generic_(options.generic),
        tally_(tally),
        world_number_(world),
        world_(make_world<D>(world)),
        oracle_(world_.soup),
        snapshot_(compile(world_.soup, options)),
        source_(world_, world) {}

  void run(std::size_t motions) {
    for (std::size_t k = 0; k < motions; ++k) move_once();
    tally_.wide += oracle_.wide_traces();
  }

 private:
  static Snapshot<D> compile(Cell_soup<D> soup, const Trial_options<D>& options) {
    if (options.tamper) options.tamper(soup);
    return Snapshot<D>::compile(soup, glue(soup));
  }

  void move_once() {
    const Motion_kind kind = source_.kind(generic_);
    const bool needs_its_start = kind == Motion_kind::in_wall_plane || kind == Motion_kind::along_edge;
    if (!has_particle_ || needs_its_start || source_.random().below(8) == 0) put_particle(kind);
    Case<D> motion;
    motion.from = particle_.position;
    motion.to = source_.target(kind, motion.from, last_);
    motion.start = snapshot_.index(particle_.cell);
    motion.trace = oracle_.trace(motion.from, motion.to);
    motion.truth = judge(motion.trace, motion.start);
    note_truth(motion);
    ++tally_.motions;
    ++tally_.by_kind[static_cast<int>(kind)];
    ++tally_.by_world[world_number_ % world_kinds];
    std::vector<Walked> walked(walkers_.size());
    for (std::size_t w = 0; w < walkers_.size(); ++w) {
      walked[w] = walk(walkers_[w], particle_, motion);
      if (walked[w].verdict != Verdict::right)
        note_fault(walkers_[w].name + ": " + name(walked[w].verdict), motion);
    }
    walk_back(motion, walked);
    follow(motion, walked.front());
  }

  struct Walked {
    Verdict verdict = Verdict::right;
    Walk_result<D> result;
    std::vector<Cell> visited;
    bool has_arrived() const { return verdict == Verdict::right && result.status == Walk_status::arrived; }
  };

  /// Walks with an arbitrary forecast, which must not matter, and judges.
  Walked walk(const Walker_under_test<D>& walker, Particle<D> particle, const Case<D>& motion) {
    Walked w;
    particle.aimed = static_cast<std::uint16_t>(source_.random().below(snapshot_.facet_count(particle.cell)));
    w.result = walker.walk(snapshot_, particle, motion.to, w.visited);
    w.verdict = judge_walk(oracle_, snapshot_, motion, w.result, w.visited, walker.sides);
    ++tally_.verdicts[static_cast<int>(w.verdict)];
    return w;
  }

  void put_particle(Motion_kind kind) {
    for (;;) {
      const Point<D> p = source_.start(kind);
      const Place place = oracle_.place(p);
      if (place.free_cells.empty()) continue;
      particle_.position = last_ = p;
      const std::size_t choice = source_.random().below(place.free_cells.size());
      particle_.cell = snapshot_.cell(place.free_cells[choice]);
      particle_.dimension = static_cast<std::uint16_t>(place.dimensions[choice]);
      has_particle_ = true;
      return;
    }
  }

  void note_fault(const std::string& what, const Case<D>& motion) {
    if (tally_.faults.size() < 5)
      tally_.faults.push_back(what + " in " + world_.name + ": " + describe(motion));
  }

  void note_truth(const Case<D>& motion) {
    const Truth& truth = motion.truth;
    tally_.free += truth.stops.empty();
    tally_.blocked += truth.arrivals.empty();
    tally_.either += !truth.arrivals.empty() && !truth.stops.empty();
    tally_.with_choice += truth.choices > 0;
    if (truth.arrivals.empty()) return;
    const auto& incidences = motion.trace.incidences;
    tally_.touching += std::any_of(incidences.begin(), incidences.end(), [](auto& i) { return !i.passable; });
    tally_.within_wall += std::any_of(incidences.begin(), incidences.end(),
                                      [](auto& i) { return !i.passable && i.first < i.last; });
  }

  /// Counts the branches of a walk, and moves the particle.
  void follow(const Case<D>& motion, const Walked& walked) {
    const auto& [verdict, result, visited] = walked;
    has_particle_ = walked.has_arrived();
    if (verdict != Verdict::right) return;
    for (std::size_t k = 0; k + 1 < visited.size(); ++k) {
      const int visit = motion.trace.visit_of(snapshot_.index(visited[k]));
      const int dimension = motion.trace.visits[visit].dimension_at_last;
      ++(dimension == D - 1 ? tally_.facet_exits : dimension == 0 ? tally_.vertex_exits : tally_.ridge_exits);
    }
    tally_.most_cells = std::max(tally_.most_cells, visited.size());
    if (result.status == Walk_status::contact) {
      tally_.contacts_facet += result.contact->kind == Contact_kind::facet;
      tally_.contacts_edge += result.contact->kind == Contact_kind::edge;
      tally_.contacts_vertex += result.contact->kind == Contact_kind::vertex;
      tally_.contacts_at_once += result.contact->time == 0;
      return;
    }
    tally_.stays += visited.size() == 1;
    ++tally_.arrivals_by_dimension[result.dimension];
    last_ = motion.from;
    particle_.position = motion.to;
    particle_.cell = result.cell;
    particle_.dimension = result.dimension;
  }

  /// Back from where the first walker arrived. Where every piece of the motion may lie in one cell only,
  /// there and back, the same cells must be visited; but the first one there may hold no more than the start.
  void walk_back(const Case<D>& motion, const std::vector<Walked>& there) {
    if (!there.front().has_arrived()) return;
    Case<D> back;
    back.from = motion.to;
    back.to = motion.from;
    Particle<D> particle;
    particle.position = back.from;
    particle.cell = there.front().result.cell;
    particle.dimension = there.front().result.dimension;
    back.start = snapshot_.index(particle.cell);
    back.trace = oracle_.trace(back.from, back.to);
    back.truth = judge(back.trace, back.start);
    const bool unique = motion.truth.unique_cells && back.truth.unique_cells;
    for (std::size_t w = 0; w < walkers_.size(); ++w) {
      if (!there[w].has_arrived() || there[w].result.cell != particle.cell) continue;
      const Walked walked = walk(walkers_[w], particle, back);
      if (walked.verdict != Verdict::right) note_fault(walkers_[w].name + ": " + name(walked.verdict), back);
      if (!unique) continue;
      std::vector<Cell> expected(there[w].visited.rbegin(), there[w].visited.rend());
      if (expected.size() > 1 && motion.trace.visits[motion.trace.visit_of(motion.start)].last == 0)
        expected.pop_back();
      if (walked.has_arrived() && walked.visited == expected) {
        ++tally_.reversed;
      } else {
        ++tally_.reversed_wrong;
        note_fault(walkers_[w].name + ": another way back", back);
      }
    }
  }

  const std::vector<Walker_under_test<D>>& walkers_;
  const bool generic_;
  Tally& tally_;
  const std::uint64_t world_number_;
  const World<D> world_;
  const Oracle<D> oracle_;
  const Snapshot<D> snapshot_;
  Motion_source<D> source_;
  bool has_particle_ = false;
  Particle<D> particle_;
  Point<D> last_{};
};

}  // namespace

std::size_t Tally::walks() const { return std::accumulate(verdicts.begin(), verdicts.end(), std::size_t{0}); }

std::string Tally::summary() const {
  std::ostringstream text;
  text << motions << " motions, " << walks() << " walks: " << free << " free, " << blocked << " blocked, "
       << either << " either, " << with_choice << " with a choice of side, " << touching << " touching, "
       << within_wall << " within a wall, " << wide << " wide\n  exits: facet " << facet_exits << ", ridge "
       << ridge_exits << ", vertex " << vertex_exits << "; contacts: facet " << contacts_facet << ", edge "
       << contacts_edge << ", vertex " << contacts_vertex << ", at once " << contacts_at_once << "; stays "
       << stays << ", most cells " << most_cells << "\n  arrivals by dimension";
  for (std::size_t n : arrivals_by_dimension) text << ' ' << n;
  text << "; reversed " << reversed << ", wrongly " << reversed_wrong << "\n  verdicts:";
  for (std::size_t v = 0; v < verdicts.size(); ++v)
    if (verdicts[v] > 0) text << ' ' << name(static_cast<Verdict>(v)) << ' ' << verdicts[v];
  return text.str();
}

std::string Tally::first_faults() const {
  std::string text;
  for (const std::string& fault : faults) (text += "\n  ") += fault;
  return text;
}

template <int D>
Tally run_trial(const std::vector<Walker_under_test<D>>& walkers, const Trial_options<D>& options) {
  const std::size_t per_world = options.motions_per_world > 0
                                    ? options.motions_per_world
                                    : std::clamp<std::size_t>(options.motions / 400, 10, 250);
  Tally tally;
  for (std::uint64_t world = options.seed; tally.motions < options.motions; ++world)
    Trial<D>(walkers, options, world, tally).run(std::min(per_world, options.motions - tally.motions));
  return tally;
}

template Tally run_trial(const std::vector<Walker_under_test<2>>&, const Trial_options<2>&);
template Tally run_trial(const std::vector<Walker_under_test<3>>&, const Trial_options<3>&);

std::size_t scaled_count(std::size_t count_in_ci) {
  const char* length = std::getenv("CELLWALK_TEST_LENGTH");
  const double factor = length ? std::atof(length) : 1;
  if (!(factor > 0)) throw std::invalid_argument("CELLWALK_TEST_LENGTH must be a positive number");
  return std::max(std::size_t{1}, static_cast<std::size_t>(static_cast<double>(count_in_ci) * factor));
}

bool is_shortened() {
  constexpr std::size_t many = 1'000'000;
  return scaled_count(many) < many;
}

}  // namespace cellwalk::oracle
