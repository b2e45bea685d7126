// SPDX-License-Identifier: LGPL-3.0-or-later
// Options as Python gives them: words and numbers.
#ifndef CELLWALK_PYTHON_OPTIONS_H
#define CELLWALK_PYTHON_OPTIONS_H

#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/kernel/error.h>

#include <optional>
#include <string>

#include "arrays.h"

namespace cellwalk::python {

inline void check_threads(int threads) {
  if (threads < 0)
    throw Error(Error_code::usage,
                "threads takes a number from 0 (all cores), not " + std::to_string(threads));
}

inline Touch to_touch(const std::string& word) {
  return choose<Touch>(word, "touch", {{"pass", Touch::pass}, {"stop", Touch::stop}});
}

inline Sweep to_sweep(const std::string& word) {
  return choose<Sweep>(
      word, "sweep",
      {{"three_segments", Sweep::three_segments}, {"triangle", Sweep::triangle}, {"faces", Sweep::faces}});
}

struct Sweep_words {
  std::string sweep, touch, search, search_cells;
  double tolerance;
  std::string search_limit = "below";
};

/// \param search the caller's, to which the options refer
/// \throw UsageError for a word that is none, or a tolerance outside (0,1]
inline Sweep_options to_sweep_options(const Sweep_words& words, Search_options& search) {
  Sweep_options options;
  options.sweep = to_sweep(words.sweep);
  options.touch = to_touch(words.touch);
  search.below = choose<bool>(words.search_limit, "search_limit", {{"below", true}, {"none", false}});
  const auto method =
      choose<std::optional<Contact_search>>(words.search, "search",
                                            {{"exact", std::nullopt},
                                             {"dichotomic", Contact_search::dichotomic},
                                             {"dichotomic_segment", Contact_search::dichotomic_segment},
                                             {"exhaustive", Contact_search::exhaustive}});
  search.cells =
      choose<Search_cells>(words.search_cells, "search_cells",
                           {{"flooded", Search_cells::flooded}, {"traversed", Search_cells::traversed}});
  if (!(words.tolerance > 0 && words.tolerance <= 1))
    throw Error(Error_code::usage,
                "tolerance takes a number in (0,1], not " + std::to_string(words.tolerance));
  search.tolerance = words.tolerance;
  if (method) {
    search.method = *method;
    options.search = &search;
  }
  return options;
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_OPTIONS_H
