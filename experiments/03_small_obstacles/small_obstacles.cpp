// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the experiment and writes sweeps.csv, costs.csv, spikes.csv, floating.csv, manifest.json and, if it is
// to be timed, timings.csv.
//
//   small_obstacles -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include "common/main.h"
#include "report.h"

int main(int argc, char** argv) {
  return cellwalk::experiments::run_program(
      argc, argv, "small_obstacles",
      {"What three segments and edges without faces miss among small obstacles",
       "few trials: what the test compares", "rows at the same time; nothing but times depends on it",
       "timed rounds of each sweep; 0: no times"},
      cellwalk::small_obstacles::run);
}
