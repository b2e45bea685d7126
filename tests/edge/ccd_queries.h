// SPDX-License-Identifier: LGPL-3.0-or-later
// The published collision queries with a static obstacle, and their labels, which count touches.
#ifndef CELLWALK_TESTS_EDGE_CCD_QUERIES_H
#define CELLWALK_TESTS_EDGE_CCD_QUERIES_H

#include <cellwalk/kernel/point.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace cellwalk::test {

/// One row: its name, its labels in the order of their columns, its points in the order of theirs.
struct Ccd_row {
  std::string name;
  std::vector<bool> labels;
  std::vector<Point<3>> points;
};

/// Reads a table of ccd_static: source, index, labels, points; the numbers are exact fractions.
/// \throw std::runtime_error with the line, if the file cannot be read, a row has another number of fields, a
///        label is not 0 or 1 or a number is not a double
std::vector<Ccd_row> read_ccd_rows(const std::string& file, std::size_t labels, std::size_t points);

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_CCD_QUERIES_H
