// SPDX-License-Identifier: LGPL-3.0-or-later
// Counts what ranks would hand to each other, and writes handovers.csv, parts.csv, manifest.json and, if it
// is to be timed, timings.csv.
//
//   scaling -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include "common/main.h"
#include "report.h"

int main(int argc, char** argv) {
  return cellwalk::experiments::run_program(
      argc, argv, "scaling",
      {"Counts what ranks with a part of the environment each would hand over",
       "small scenes: what the test compares", "for the steps; counts do not depend on it", "0: no times"},
      cellwalk::scaling::run);
}
