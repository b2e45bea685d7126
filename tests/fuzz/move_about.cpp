// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fuzz/move_about.h"

#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/strategy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "edge/sweep_judge.h"
#include "fuzz/targets.h"
#include "walk/walk_judge.h"

namespace cellwalk::fuzz {
namespace {

Judged judged_totals;

/// True for points on which the oracles' integers stay short.
template <std::size_t D>
bool has_few_digits(const std::array<double, D>& p) {
  constexpr double largest = 0x1p12, unit = 0x1p-54;
  return std::all_of(p.begin(), p.end(),
                     [](double x) { return std::abs(x) <= largest && std::fmod(x, unit) == 0; });
}

template <int D>
class Mover {
 public:
  Mover(const Snapshot<D>& snapshot, const Cell_soup<D>& soup) : snapshot_(snapshot), locator_(snapshot) {
    if (!std::all_of(soup.points.begin(), soup.points.end(), has_few_digits<D>)) return;
    constexpr std::size_t most_cells_of_sweeps = 64;
    walks_.emplace(soup);
    if (soup.cell_count() <= most_cells_of_sweeps) sweeps_.emplace(soup);
  }

  void move_once(Decoder& in) {
    const Point<D> from = some_point(snapshot_, in), to = some_point(snapshot_, in);
    const auto p = particle_at(from, in);
    if (!p) return;
    for (const auto strategy :
         {Walk_strategy::certified, Walk_strategy::exit_rule, Walk_strategy::predictive_simplex})
      walk_once(*p, to, strategy);
    if (const auto q = particle_at(some_point(snapshot_, in), in)) sweep(*p, to, *q, in);
  }

 private:
  /// A particle on any of the sides that a point has.
  std::optional<Particle<D>> particle_at(const Point<D>& x, Decoder& in) {
    const Location<D> here = locator_.locate(x);
    if (walks_ && has_few_digits(x)) {
      const oracle::Place place = walks_->place(x);
      std::vector<std::uint32_t> cells;
      for (const Cell c : here.cells) cells.push_back(snapshot_.index(c));
      const auto is_right_dimension = [&](std::uint32_t cell) {
        const auto number = std::find(place.free_cells.begin(), place.free_cells.end(), cell);
        return number != place.free_cells.end() &&
               here.dimension ==
                   place.dimensions[static_cast<std::size_t>(number - place.free_cells.begin())];
      };
      const bool is_well_placed = cells.empty() || is_right_dimension(cells.front());
      std::sort(cells.begin(), cells.end());
      demand(
          cells == place.free_cells && static_cast<int>(here.sides.size()) == place.sides && is_well_placed,
          "a point is located wrongly");
      ++judged_totals.places;
    }
    if (here.status != Location_status::free) return std::nullopt;
    const std::size_t number = in.below(here.cells.size());
    const Cell cell = here.cells[number];
    demand(in_closure(snapshot_, cell, x), "a located point is not in its cell");
    const auto side = static_cast<std::size_t>(here.side_of_cell[number]);
    return Particle<D>{x, cell, locator_.particles_at(x)[side].dimension,
                       static_cast<std::uint16_t>(in.below(snapshot_.facet_count(cell)))};
  }

  void walk_once(const Particle<D>& p, const Point<D>& to, Walk_strategy strategy) {
    Walk_counts counts;
    std::vector<Cell> visited;
    const Walk_result<D> result = walk(snapshot_, p, to, counts, strategy, {&visited});
    demand(result.status != Walk_status::lost, "an exact walk is lost");
    if (result.status == Walk_status::arrived)
      demand(in_closure(snapshot_, result.cell, to) && !snapshot_.is_solid(result.cell),
             "a walk ends where its target is not");
    else
      demand(result.contact && 0 <= result.contact->time && result.contact->time <= 1,
             "a contact has no time in [0,1]");
    if (!walks_ || !has_few_digits(p.position) || !has_few_digits(to)) return;
    oracle::Case<D> motion{p.position, to, snapshot_.index(p.cell), walks_->trace(p.position, to), {}};
    motion.truth = oracle::judge(motion.trace, motion.start);
    const oracle::Verdict verdict = oracle::judge_walk(*walks_, snapshot_, motion, result, visited);
    demand(verdict == oracle::Verdict::right, std::string(oracle::name(verdict)) + ", strategy " +
                                                  std::to_string(static_cast<int>(strategy)) + ": " +
                                                  describe(motion));
    ++judged_totals.walks;
    judged_totals.walks_blocked += result.status == Walk_status::contact;
  }

  void demand_chain(const Particle<D>& p, const Particle<D>& q, const Chain& chain) {
    Walk_counts counts;
    demand(in_closure(snapshot_, p.cell, p.position), "a particle is not in its cell");
    demand(is_chain(snapshot_, p, q, chain, counts), "an edge does not pass its chain");
    ++judged_totals.chains;
  }

  void sweep(const Particle<D>& p, const Point<D>& to, const Particle<D>& q, Decoder& in) {
    Edge_counts counts;
    const Chain_result<D> edge = find_any_chain(snapshot_, p, q, counts.walk);
    if (edge.contact) return;
    demand_chain(p, q, edge.chain);
    const std::uint8_t certificates = in.byte();
    Sweep_options options;
    // The bits that these have had in inputs found so far.
    options.certificates = certificates / 4 % 2 == 0;
    judge_triangle(p, to, q, edge.chain, options.certificates);
    options.sweep = in.flag() ? Sweep::triangle : Sweep::three_segments;
    options.touch = in.flag() ? Touch::stop : Touch::pass;
    Search_options search;
    options.search = take_search(in, search);
    const Sweep_result<D> result = sweep_edge(snapshot_, p, to, q, edge.chain, options, counts);
    if (result.contact)
      demand(Exact_time() <= result.contact->exact_time() && result.contact->exact_time() <= Exact_time(1),
             "a contact has no time in [0,1]");
    else
      demand(result.p.position == to, "an edge that is free is not where it went");
    demand_chain(result.p, q, result.chain);
  }

  /// The complete sweep against the oracle of chains.
  void judge_triangle(const Particle<D>& from, const Point<D>& target, const Particle<D>& q,
                      const Chain& before, bool certificates) {
    Edge_counts counts;
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    Particle<D> to = from;
    const Walk_result<D> walked = move(snapshot_, to, target, counts.walk, {&visited, &crossed});
    const bool blocked = walked.status != Walk_status::arrived;
    if (blocked) {
      to.position = target;
      to.cell = visited.back();
    }
    const Vertex_path<D> path{from, to, visited, crossed, blocked};
    const Sweep_result<D> result = sweep_triangle<D>(snapshot_, path, q, before, counts, certificates);
    if (!blocked && !result.contact) demand_chain(to, q, result.chain);
    if (!sweeps_ || !has_few_digits(from.position) || !has_few_digits(target) || !has_few_digits(q.position))
      return;
    const auto motion = test::motion_of(sweeps_->soup(), snapshot_, path, q, before);
    try {
      const oracle::Outcomes outcomes = sweeps_->judge(motion);
      const auto fault = test::fault_of(*sweeps_, motion, outcomes, snapshot_, result);
      demand(fault == test::Sweep_fault::none,
             std::string("a sweep: ") + test::fault_names[static_cast<std::size_t>(fault)]);
    } catch (const std::length_error&) {
      return;  // more chains than the oracle follows
    }
    ++judged_totals.sweeps;
    judged_totals.sweeps_blocked += result.contact.has_value();
  }

  const Snapshot<D>& snapshot_;
  Locator<D> locator_;
  std::optional<oracle::Oracle<D>> walks_;         // of environments whose coordinates have few digits
  std::optional<oracle::Chain_oracle<D>> sweeps_;  // and few cells
};

}  // namespace

const Judged& judged() { return judged_totals; }

template <int D>
Point<D> some_point(const Snapshot<D>& snapshot, Decoder& in) {
  const auto vertex = [&] {
    return snapshot.point(static_cast<std::uint32_t>(in.below(snapshot.points().size())));
  };
  switch (in.byte() % 8) {
    case 0:
      return vertex();
    case 1: {
      const Point<D> a = vertex();
      return combination<D>(a, vertex(), 0.5);
    }
    case 2: {  // within a facet
      const Cell c = snapshot.cell(in.below(snapshot.cell_count()));
      const auto loop = snapshot.loop(snapshot.half_facet(c, in.below(snapshot.facet_count(c))));
      const Point<D> a = combination<D>(snapshot.point(loop[0]), snapshot.point(loop[1]),
                                        static_cast<double>(in.below(9)) / 8);
      return combination<D>(a, snapshot.point(loop.back()), static_cast<double>(in.below(9)) / 8);
    }
    case 3: {  // next to a vertex
      Point<D> p = vertex();
      for (double& x : p) {
        const int up = static_cast<int>(in.byte() % 3) - 1;
        if (up != 0) x = std::nextafter(x, up * std::numeric_limits<double>::infinity());
      }
      return p;
    }
    case 4: {  // on the line through two vertices, often beyond them
      const Point<D> a = vertex(), b = vertex();
      return combination<D>(a, b, (static_cast<double>(in.byte()) - 128) / 16);
    }
    case 5: {  // within a cell
      const auto cell = snapshot.view(snapshot.cell(in.below(snapshot.cell_count())));
      Point<D> p = cell.point(in.below(cell.vertex_count()));
      for (int i = 0; i < D; ++i)
        p = combination<D>(p, cell.point(in.below(cell.vertex_count())),
                           static_cast<double>(in.below(8)) / 8);
      return p;
    }
    default: {
      Point<D> p;
      for (double& x : p) x = in.coordinate();
      return p;
    }
  }
}

template <int D>
void move_about(const Snapshot<D>& snapshot, const Cell_soup<D>& soup, Decoder& in, std::size_t most) {
  if (in.is_empty()) return;
  Mover<D> mover(snapshot, soup);
  for (std::size_t i = 0; i < most && !in.is_empty(); ++i) mover.move_once(in);
}

template Point<2> some_point(const Snapshot<2>&, Decoder&);
template Point<3> some_point(const Snapshot<3>&, Decoder&);
template void move_about(const Snapshot<2>&, const Cell_soup<2>&, Decoder&, std::size_t);
template void move_about(const Snapshot<3>&, const Cell_soup<3>&, Decoder&, std::size_t);

}  // namespace cellwalk::fuzz
