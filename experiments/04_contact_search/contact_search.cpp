// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs the experiment and writes errors.csv, costs.csv, manifest.json and, if it is to be timed,
// timings.csv.
//
//   contact_search -o DIR [--quick] [--threads N] [--rounds N] [--seed N] [--commit NAME]
#include "common/main.h"
#include "report.h"

int main(int argc, char** argv) {
  return cellwalk::experiments::run_program(
      argc, argv, "contact_search",
      {"Searches for contacts, compared with the exact one", "few contacts: what the test compares",
       "worlds at the same time, unless timed; results do not depend on it",
       "timed rounds of each search; 0: no times"},
      cellwalk::contact_search::run);
}
