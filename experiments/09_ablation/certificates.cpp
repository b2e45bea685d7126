// SPDX-License-Identifier: LGPL-3.0-or-later
#include "certificates.h"

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/simulation/body_replay.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <optional>

#include "common/processor_time.h"

namespace cellwalk::ablation {
namespace {

using real_scenes::Loaded_scene;

/// The bodies of a motion, which are put where the trace has them before each step.
class Motion_by_choice {
 public:
  Motion_by_choice(const Snapshot<3>& snapshot, const Locator<3>& locator, const Body_trace& trace,
                   const Chosen& chosen)
      : snapshot_(snapshot),
        locator_(locator),
        trace_(trace),
        chosen_(chosen),
        options_(body_trace_options(Sweep::triangle, trace)),
        bodies_(trace.bodies.size()),
        reports_(bodies_.size()) {
    options_.clearance = chosen.regions;
    options_.sweep.certificates = chosen.of_edges;
    for (std::size_t b = 0, first = 0; b < bodies_.size(); first += trace.bodies[b++].vertices) {
      first_vertex_.push_back(first);
      degrees_.push_back(answerable_degrees(trace.bodies[b], b));
    }
  }

  void place(std::size_t step) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const auto before = of_body(trace_.before_step(step), b);
      reports_[b].clear();
      if (bodies_[b]) bodies_[b]->step(before, options_, reports_[b], uncounted_);
      if (!bodies_[b] || !std::ranges::equal(bodies_[b]->positions(), before)) {
        const Body_soup<3> soup{{before.begin(), before.end()}, trace_.bodies[b].edges, {}};
        detail::use_certificates(bodies_[b].emplace(snapshot_, locator_, soup), chosen_.of_body, uncounted_);
      }
      reports_[b].clear();
    }
  }
  void step(std::size_t step, Body_counts& counts) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      bodies_[b]->step(of_body(trace_.targets_of_step(step), b), options_, reports_[b], counts);
  }
  void append_answers(std::vector<std::uint8_t>& answers) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      append_body_answers(degrees_[b], reports_[b].blocked, Sweep::triangle, answers);
  }

 private:
  std::span<const Point<3>> of_body(std::span<const Point<3>> of_step, std::size_t b) const {
    return of_step.subspan(first_vertex_[b], trace_.bodies[b].vertices);
  }

  const Snapshot<3>& snapshot_;
  const Locator<3>& locator_;
  const Body_trace& trace_;
  const Chosen& chosen_;
  Body_options options_;
  std::vector<std::size_t> first_vertex_;
  std::vector<std::vector<std::uint32_t>> degrees_;
  std::vector<std::optional<Body<3>>> bodies_;
  std::vector<Step_report<3>> reports_;
  Body_counts uncounted_;
};

/// One round; seconds of the steps alone.
double run_round(Motion_by_choice motion, const Body_trace& trace, Body_counts& counts,
                 std::uint64_t* different) {
  std::vector<std::uint8_t> answers;
  double seconds = 0;
  for (std::size_t s = 0; s < trace.steps; ++s) {
    motion.place(s);
    const double start = experiments::processor_seconds();
    motion.step(s, counts);
    seconds += experiments::processor_seconds() - start;
    if (different) motion.append_answers(answers);
  }
  if (different) *different = count_mismatches(trace, answers, Sweep::triangle);
  return seconds;
}

}  // namespace

std::vector<Chosen> choices() {
  constexpr detail::Body_certificates all;
  detail::Body_certificates no_body_region, no_stars, no_clusters, not_in_place;
  no_body_region.body_region = false;
  no_stars.star_regions = false;
  no_clusters.clusters = false;
  not_in_place.chains_in_place = false;
  std::vector<Chosen> result{{"all", true, all, true},
                             {"no_region_of_the_body", true, no_body_region, true},
                             {"no_regions_of_stars", true, no_stars, true},
                             {"no_clusters", true, no_clusters, true}};
  for (const bool regions : {true, false}) {
    if (!regions) result.push_back({"all", false, all, true});
    result.insert(result.end(), {{"no_chains_in_place", regions, not_in_place, true},
                                 {"no_certificate_of_edges", regions, all, false}});
  }
  return result;
}

std::vector<Certificate_row> run_certificates(const std::string& name, const Loaded_scene& scene,
                                              int rounds) {
  const auto environment = Environment<3>::build(
      scene.soup, {.duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false});
  const Locator<3> locator(environment.snapshot());
  const Body_trace& trace = scene.motion.trace;
  const std::vector<Chosen> sets = choices();
  std::vector<Certificate_row> rows;
  for (const Chosen& chosen : sets) {
    Certificate_row& row = rows.emplace_back(Certificate_row{name, chosen.name, chosen.regions, {}, 0, {}});
    run_round({environment.snapshot(), locator, trace, chosen}, trace, row.counts, &row.different);
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < sets.size(); ++i) {
      Body_counts counts;
      const double seconds =
          run_round({environment.snapshot(), locator, trace, sets[i]}, trace, counts, nullptr);
      rows[i].nanoseconds.push_back(1e9 * seconds / static_cast<double>(trace.moves()));
    }
  return rows;
}

}  // namespace cellwalk::ablation
