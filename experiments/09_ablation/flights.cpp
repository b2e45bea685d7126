// SPDX-License-Identifier: LGPL-3.0-or-later
#include "flights.h"

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/strategy.h>

#include <variant>

#include "common/processor_time.h"
#include "random_flights.h"

namespace cellwalk::ablation {
namespace {

/// A way to walk.
struct Way {
  const char* name;
  Walk_result<3> (*move)(const Snapshot<3>&, Particle<3>&, const Point<3>&, Walk_counts&, Walk_strategy,
                         const Walk_options&);
  Walk_strategy strategy;
  bool forecasts = true;  ///< false: what a particle aimed at is forgotten, so that facets come in order
  std::size_t share = 1;  ///< one in so many of the particles fly
};

Walk_result<3> move_by_planes_of_walk(const Snapshot<3>& snapshot, Particle<3>& particle,
                                      const Point<3>& target, Walk_counts& counts, Walk_strategy,
                                      const Walk_options& options) {
  return detail::move_by_walk<Exact>(snapshot, particle, target, counts, options);
}

constexpr Way ways[] = {{"planes", move<Exact, 3>, Walk_strategy::certified},
                        {"planes_no_own_cell_first", move_by_planes_of_walk, Walk_strategy::certified},
                        {"planes_no_forecast", move<Exact, 3>, Walk_strategy::certified, false},
                        {"signs", move<Exact, 3>, Walk_strategy::exit_rule},
                        {"signs_no_forecast", move<Exact, 3>, Walk_strategy::exit_rule, false},
                        {"simplex", move<Exact, 3>, Walk_strategy::predictive_simplex},
                        {"simplex_no_forecast", move<Exact, 3>, Walk_strategy::predictive_simplex, false},
                        {"lazy_signs", move<Lazy, 3>, Walk_strategy::exit_rule, true, 20},
                        {"rational_signs", move<Unfiltered, 3>, Walk_strategy::exit_rule, true, 200}};

Environment<3> environment_of(const Flight_setting& setting) {
  const double n = setting.is_small ? 12 : 46;
  Generator_values values;
  if (setting.world == "hexahedra")
    values = {{"cells", {n}}, {"solid", {0.08}}, {"rotated", {1}}};
  else if (setting.is_small)
    values = {{"generations", {1}}, {"cell_size", {0.4}}};
  const char* name = setting.world == "hexahedra" ? "hexes" : "vessel";
  return Environment<3>::build(std::get<Cell_soup<3>>(generate(name, values)), build_of_generated);
}

struct Flight {
  std::vector<Particle<3>> particles;
  std::vector<std::uint32_t> contacts;  ///< of each
  double seconds = 0;
};

Flight fly(const Snapshot<3>& snapshot, const Way& way, std::vector<Particle<3>> particles,
           const std::vector<Vector<3>>& moves, std::size_t stride, Walk_counts& counts) {
  std::vector<std::uint32_t> contacts(particles.size());
  Walk_options options;
  options.locates_contact = false;
  const double start = experiments::processor_seconds();
  for (std::size_t first = 0; first < moves.size(); first += stride)
    for (std::size_t i = 0; i < particles.size(); ++i) {
      Particle<3>& p = particles[i];
      if (!way.forecasts) p.aimed = 0;
      const Point<3> target = p.position + moves[first + i];
      contacts[i] +=
          way.move(snapshot, p, target, counts, way.strategy, options).status == Walk_status::contact;
    }
  const double seconds = experiments::processor_seconds() - start;
  return {std::move(particles), std::move(contacts), seconds};
}

/// How many particles of a flight end elsewhere than those of another.
std::uint64_t differences(const Flight& flight, const Flight& other) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < flight.particles.size(); ++i)
    count += flight.particles[i].position != other.particles[i].position ||
             flight.particles[i].cell != other.particles[i].cell || flight.contacts[i] != other.contacts[i];
  return count;
}

}  // namespace

std::vector<Flight_row> run_flights(const Flight_setting& setting, int rounds) {
  const Environment<3> environment = environment_of(setting);
  const Snapshot<3>& snapshot = environment.snapshot();
  Random random(setting.seed);
  const std::vector<Particle<3>> all = random_starts(snapshot, setting.particles, random);
  const double length = setting.length * edge_length(snapshot, all);
  const std::vector<Vector<3>> moves = random_moves(length, setting.particles * setting.steps, random);
  const auto flown = [&](const Way& way, Walk_counts& counts) {
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(all.size() / way.share);
    return fly(snapshot, way, {all.begin(), end}, moves, all.size(), counts);
  };
  std::vector<Flight_row> rows;
  Flight expected;
  for (const Way& way : ways) {
    Flight_row& row = rows.emplace_back();
    Flight flight = flown(way, row.counts);
    row.world = setting.world;
    row.way = way.name;
    row.length = setting.length;
    row.cells = snapshot.cell_count();
    row.moves = flight.particles.size() * setting.steps;
    for (const std::uint32_t contacts : flight.contacts) row.blocked += contacts;
    if (rows.size() == 1)
      expected = std::move(flight);
    else
      row.different = differences(flight, expected);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Walk_counts counts;
      const Flight flight = flown(ways[i], counts);
      rows[i].nanoseconds.push_back(1e9 * flight.seconds / static_cast<double>(rows[i].moves));
    }
  return rows;
}

}  // namespace cellwalk::ablation
