// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/io/json_file.h>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/manifest.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "search_trials.h"

namespace cellwalk::contact_search {
namespace {

constexpr int least_bits = 2, most_bits = 30, bits_step = 2;
constexpr std::size_t quick_contacts = 150, full_contacts = 2000;

std::vector<Search> all_searches() {
  const auto exhaustive = Contact_search::exhaustive;
  std::vector<Search> searches{
      {"exact"},
      {"exhaustive", Search_options{.method = exhaustive}},
      {"exhaustive_unlimited", Search_options{.method = exhaustive, .below = false}},
      {"exhaustive_traversed", Search_options{.method = exhaustive, .cells = Search_cells::traversed}}};
  const auto add = [&](const char* name, Contact_search method) {
    for (int bits = least_bits; bits <= most_bits; bits += bits_step)
      searches.push_back({name, Search_options{method, std::ldexp(1.0, -bits)}, bits});
  };
  add("dichotomic", Contact_search::dichotomic);
  add("dichotomic_segment", Contact_search::dichotomic_segment);
  return searches;
}

/// Six digits: what differs in the last bits between libraries is not written.
std::string text(double value) { return fmt::format("{:.6g}", value); }

/// Bits of the tolerance, nothing for searches that have none.
std::string bits_of(const Search& search) { return search.bits > 0 ? std::to_string(search.bits) : ""; }

struct Spread {
  double mean, median, most;
};

Spread spread(const Search_tally& tally, double Search_error::*error) {
  std::vector<double> values;
  double sum = 0;
  for (const Search_error& e : tally.errors) {
    values.push_back(e.*error);
    sum += e.*error;
  }
  std::sort(values.begin(), values.end());
  return {sum / static_cast<double>(values.size()), values[values.size() / 2], values.back()};
}

using Tallies = std::vector<std::vector<Search_tally>>;  // of each world

template <class Write>
void for_each_row(const Tallies& tallies, const std::vector<Search>& searches, Write write) {
  for (std::size_t w = 0; w < tallies.size(); ++w)
    for (std::size_t i = 0; i < searches.size(); ++i) write(name_of(worlds[w]), searches[i], tallies[w][i]);
}

void write_errors(const Tallies& tallies, const std::vector<Search>& searches,
                  const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "errors.csv",
                     {"world", "search", "tolerance_bits", "contacts", "same_time", "late", "none_found",
                      "same_feature", "early_mean", "early_median", "early_max", "late_max", "gap_median",
                      "gap_max", "point_median", "point_max", "normal_median", "normal_max"});
  for_each_row(tallies, searches, [&](std::string_view world, const Search& search, const Search_tally& t) {
    const Spread time = spread(t, &Search_error::early), gap = spread(t, &Search_error::gap),
                 point = spread(t, &Search_error::point), normal = spread(t, &Search_error::normal);
    double late = 0;
    for (const Search_error& e : t.errors) late = std::max(late, -e.early);
    out.row(world, search.name, bits_of(search), t.errors.size(), t.same_time, t.late, t.counts.search_misses,
            t.same_feature, text(time.mean), text(time.median), text(time.most), text(late), text(gap.median),
            text(gap.most), text(point.median), text(point.most), text(normal.median), text(normal.most));
  });
  out.commit();
}

void write_costs(const Tallies& tallies, const std::vector<Search>& searches,
                 const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "costs.csv",
                     {"world", "search", "tolerance_bits", "contacts", "search_sweeps", "search_walks",
                      "search_walls", "flooded_cells", "signs", "exact_signs"});
  for_each_row(tallies, searches, [&](std::string_view world, const Search& search, const Search_tally& t) {
    out.row(world, search.name, bits_of(search), t.errors.size(), t.counts.search_sweeps,
            t.counts.search_walks, t.counts.search_walls, t.counts.flooded_cells,
            t.counts.walk.predicates.orientations, t.counts.walk.predicates.fallbacks);
  });
  out.commit();
}

void write_timings(const Tallies& tallies, const std::vector<Search>& searches,
                   const std::filesystem::path& folder) {
  io::Csv_writer out(folder / "timings.csv", {"world", "search", "tolerance_bits", "us_per_contact"});
  for_each_row(tallies, searches, [&](std::string_view world, const Search& search, const Search_tally& t) {
    out.row(world, search.name, bits_of(search), text(t.microseconds));
  });
  out.commit();
}

}  // namespace

void run(const Plan& plan, const std::filesystem::path& folder) {
  const std::vector<Search> searches = all_searches();
  const bool is_timed = plan.rounds > 0;
  if (experiments::is_idle(is_timed)) return;
  Tallies tallies;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    is_timed ? 1 : static_cast<std::size_t>(plan.threads));
    const auto trial = [&](std::size_t w) {
      const std::string_view name = name_of(worlds[w]);
      return contact_search::run(worlds[w], searches,
                                 {experiments::part_seed(plan.seed, name),
                                  plan.quick ? quick_contacts : full_contacts, plan.rounds});
    };
    tallies = experiments::shared_trials(
        std::size(worlds), trial, is_timed ? experiments::Trials::timed : experiments::Trials::on_threads);
  }
  write_errors(tallies, searches, folder);
  write_costs(tallies, searches, folder);
  if (plan.rounds > 0) write_timings(tallies, searches, folder);
  auto manifest = experiments::manifest(plan.commit);
  manifest["quick"] = plan.quick;
  manifest["seed"] = plan.seed;
  manifest["rounds"] = plan.rounds;
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace cellwalk::contact_search
