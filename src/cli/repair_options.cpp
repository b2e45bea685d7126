// SPDX-License-Identifier: LGPL-3.0-or-later
// Options for surfaces with defects.
#include "cli/repair_options.h"

#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "cli/common/command.h"

namespace cellwalk::cli {
namespace {

/// Reads "X,Y,Z".
Point<3> point_of(const std::string& text) {
  Point<3> p;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? text.find(',', begin) : text.size();
    const std::string number = text.substr(begin, end == std::string::npos ? end : end - begin);
    if (end == std::string::npos || !CLI::detail::lexical_cast(number, p[k]) || !is_finite(p))
      throw Error(Error_code::usage,
                  fmt::format("--inside: '{}' is neither auto, solid, nor a point X,Y,Z", text));
    begin = end + 1;
  }
  return p;
}

}  // namespace

void add_repair_options(CLI::App& command, Mesher_options& options, std::string& names) {
  if (!mesher_parts().meshing) return;
  CLI::Option* const strict = command.add_flag(
      "--strict", options.is_strict,
      "Refuse surfaces that are open, not manifold or cross themselves, and cells that do not conform");
  command
      .add_option_function<std::vector<std::string>>(
          "--inside",
          [&options](const std::vector<std::string>& values) {
            for (const std::string& value : values) {
              const bool is_word = value == "solid" || value == "auto";
              if (is_word && values.size() > 1)
                throw Error(
                    Error_code::usage,
                    fmt::format("--inside {} goes with no other --inside: give it alone, or give points",
                                value));
              if (value == "solid")
                options.repair.is_solid = true;
              else if (value != "auto")
                options.repair.inside.push_back(point_of(value));
            }
          },
          "The free space: auto: what the surface encloses, or the lumen of a thick wall; solid: always what "
          "it encloses; a point: the space around it, up to the narrowest places on the ways out. Several "
          "points for one space")
      ->allow_extra_args(false)
      ->excludes(strict)
      ->default_str("auto")
      ->type_name("auto|solid|X,Y,Z");
  command
      .add_option("--names", names,
                  "Names of caps and mouths: a JSON file of names with points, {\"inlet\": [x, y, z], ...}; "
                  "each goes to the nearest one")
      ->excludes(strict)
      ->type_name("FILE");
  const auto part = [&](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)
        ->check(number_from(0, "from 0 to below 1", std::nextafter(1.0, 0.0)))
        ->excludes(strict)
        ->type_name("REL")
        ->capture_default_str();
  };
  part("--seam", options.repair.seam, "Join points of borders nearer than this part of the surface's size");
  part("--weld", options.repair.weld,
       "Join any points nearer than this part of the size, if no mesher takes them apart; 0: never");
  part("--max-move", options.repair.max_move,
       "Refuse a surface whose walls would lie farther from it than this part of its size");
  add_choice(command, "--sheets", options.repair.sheets,
             {{"keep", Sheets::keep}, {"open", Sheets::open}, {"refuse", Sheets::refuse}},
             "Facets inside, or given on both sides: membranes, nothing, or a reason to refuse the surface");
}

}  // namespace cellwalk::cli
