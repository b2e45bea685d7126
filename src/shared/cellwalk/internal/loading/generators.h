// SPDX-License-Identifier: LGPL-3.0-or-later
// All generators by name, with their options: one table for `cellwalk generate`, scenes and Python.
#ifndef CELLWALK_INTERNAL_LOADING_GENERATORS_H
#define CELLWALK_INTERNAL_LOADING_GENERATORS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/records/cell_soup.h>

#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace cellwalk {

using Any_soup = std::variant<Cell_soup<2>, Cell_soup<3>>;

/// Options by name, each a list of numbers. A flag is on if its number is not 0.
using Generator_values = std::map<std::string, std::vector<double>>;

struct Generator_option {
  std::string name;  ///< as in scenes; the command line has - for _
  std::string help;
  std::vector<double> initial;  ///< the default; its length is that of the option
  bool is_flag = false;
  bool is_integer = false;
};

struct Generator {
  std::string name;
  std::string help;
  std::vector<Generator_option> options;
  Any_soup (*make)(const Generator_values& complete);
};

/// All generators, in the order of the help text.
const std::vector<Generator>& generators();

/// Makes the cells of a generator. An option that takes one number for each axis takes a single one for all.
/// \throw Error(usage) for an unknown generator or option, a wrong count of numbers, one that is not finite,
///        or not an integer where one is needed, and as the generator itself does
Any_soup generate(const std::string& name, const Generator_values& values);

/// The options to build generated cells: nothing is split, and equal vertices are kept, as slits.
inline constexpr Build_options build_of_generated{
    .duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false};

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_LOADING_GENERATORS_H
