// SPDX-License-Identifier: LGPL-3.0-or-later
// The options of an import by name: a line for each.
#include <cellwalk/internal/loading/import_call.h>
#include <cellwalk/internal/loading/mesher.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace cellwalk {
namespace {

using Import_value = Import_call::Value;

/// Sets an option to a value; false if it is none of this option.
using Set_option = bool (*)(Import_options&, const Import_value&);

/// \param to a number, or an optional one
template <class To>
bool set_number(To& to, const Import_value& value, double least) {
  const double* number = std::get_if<double>(&value);
  if (number == nullptr || *number < least) return false;
  to = *number;
  return true;
}

bool set_flag(bool& to, const Import_value& value) {
  const bool* flag = std::get_if<bool>(&value);
  if (flag != nullptr) to = *flag;
  return flag != nullptr;
}

template <class To>
bool set_word(To& to, const Import_value& value, std::initializer_list<std::pair<const char*, To>> meanings) {
  const std::string* word = std::get_if<std::string>(&value);
  for (const auto& [known, meaning] : meanings)
    if (word != nullptr && *word == known) {
      to = meaning;
      return true;
    }
  return false;
}

constexpr double above_0 = std::numeric_limits<double>::denorm_min();

struct Named_option {
  const char* name;
  const char* expected;
  Set_option set;
};

constexpr Named_option named_options[] = {
    {"mesher", "\"tetgen\" or \"mesh3\"",
     [](Import_options& o, const Import_value& v) {
       return set_word(o.mesher.mesher, v, {{"tetgen", Mesher::tetgen}, {"mesh3", Mesher::mesh3}});
     }},
    {"quality", "a number of at least 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.quality, v, 0); }},
    {"cell_size", "a number greater than 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.cell_size, v, above_0); }},
    {"distance", "a number greater than 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.distance, v, above_0); }},
    {"keep_obstacles", "true or false",
     [](Import_options& o, const Import_value& v) { return set_flag(o.mesher.keep_obstacles, v); }},
    {"strict", "true or false",
     [](Import_options& o, const Import_value& v) { return set_flag(o.mesher.is_strict, v); }},
    {"inside", "\"auto\", \"solid\" or a point [x, y, z]",
     [](Import_options& o, const Import_value& v) {
       const auto* point = std::get_if<std::vector<double>>(&v);
       if (point == nullptr) return set_word(o.mesher.repair.is_solid, v, {{"auto", false}, {"solid", true}});
       if (point->size() != 3) return false;
       o.mesher.repair.inside = {{(*point)[0], (*point)[1], (*point)[2]}};
       return true;
     }},
    {"seam", "a number of at least 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.repair.seam, v, 0); }},
    {"weld", "a number of at least 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.repair.weld, v, 0); }},
    {"max_move", "a number of at least 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.repair.max_move, v, 0); }},
    {"sheets", "\"keep\", \"open\" or \"refuse\"",
     [](Import_options& o, const Import_value& v) {
       return set_word(o.mesher.repair.sheets, v,
                       {{"keep", Sheets::keep}, {"open", Sheets::open}, {"refuse", Sheets::refuse}});
     }},
    {"conform", "\"exact\", \"off\" or a number greater than 0",
     [](Import_options& o, const Import_value& v) {
       return set_number(o.conform, v, above_0) ||
              set_word<std::optional<double>>(o.conform, v, {{"exact", 0.0}, {"off", std::nullopt}});
     }},
    {"time_limit", "a number greater than 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.mesher.time_limit, v, above_0); }},
    {"tissue", "a number greater than 0",
     [](Import_options& o, const Import_value& v) { return set_number(o.tissue, v, above_0); }},
    {"split", "true or false",
     [](Import_options& o, const Import_value& v) { return set_flag(o.build.split, v); }},
    {"simplicial", "true or false",
     [](Import_options& o, const Import_value& v) { return set_flag(o.build.simplicial, v); }},
    {"duplicates", "\"refuse\", \"merge\" or \"keep\"",
     [](Import_options& o, const Import_value& v) {
       return set_word(o.build.duplicates, v,
                       {{"refuse", Duplicate_vertices::refuse},
                        {"merge", Duplicate_vertices::merge},
                        {"keep", Duplicate_vertices::keep}});
     }},
};

}  // namespace

const char* option_of_repair(const Repair_options& options) {
  const Repair_options usual;
  if (!options.inside.empty() || options.is_solid) return "--inside";
  if (options.seam != usual.seam) return "--seam";
  if (options.weld != usual.weld) return "--weld";
  if (options.max_move != usual.max_move) return "--max-move";
  return options.sheets != usual.sheets ? "--sheets" : nullptr;
}

Import_options import_options(const Import_call& call) {
  Import_options options;
  options.obstacles = call.obstacles;
  for (const auto& [name, value] : call.options) {
    const auto* option =
        std::ranges::find_if(named_options, [&key = name](const Named_option& o) { return o.name == key; });
    if (option == std::end(named_options)) {
      std::vector<std::string> known{"import", "obstacle"};
      for (const Named_option& o : named_options) known.emplace_back(o.name);
      std::ranges::sort(known);
      throw Error(Error_code::input,
                  fmt::format("{}: unknown key; known here: {}", name, fmt::join(known, ", ")));
    }
    if (!option->set(options, value))
      throw Error(Error_code::input, fmt::format("{}: expected {}", name, option->expected));
  }
  return options;
}

}  // namespace cellwalk
