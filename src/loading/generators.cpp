// SPDX-License-Identifier: LGPL-3.0-or-later
// The values of options passed to each generator, and the table of them all.
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/lattice_map.h>
#include <cellwalk/generators/room.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/loading/generators.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cellwalk {
namespace {

double number(const Generator_values& values, const char* name) { return values.at(name)[0]; }
bool flag(const Generator_values& values, const char* name) { return number(values, name) != 0; }
std::uint64_t seed(const Generator_values& values) {
  return static_cast<std::uint64_t>(number(values, "seed"));
}

template <int D>
std::array<std::uint32_t, D> counts(const Generator_values& values, const char* name) {
  std::array<std::uint32_t, D> numbers;
  for (int i = 0; i < D; ++i) numbers[i] = static_cast<std::uint32_t>(values.at(name)[i]);
  return numbers;
}

template <int D>
Lattice_map<D> placement(const Generator_values& values) {
  const double scale = number(values, "scale");
  if (flag(values, "rotated") && flag(values, "sheared"))
    throw Error(Error_code::usage, "a lattice is either rotated or sheared: leave one of them out");
  if (flag(values, "rotated")) return rotated<D>(scale);
  if (flag(values, "sheared")) return sheared<D>(scale);
  return scaled<D>(scale);
}

template <int D>
Any_soup grid(const Generator_values& values) {
  Grid_options<D> options;
  options.cells = counts<D>(values, "cells");
  options.solid_share = number(values, "solid");
  options.seed = seed(values);
  options.map = placement<D>(values);
  if constexpr (D == 2)
    return square_grid(options);
  else
    return hex_grid(options);
}

template <int D>
Any_soup simplex_grid(const Generator_values& values) {
  Simplex_grid_options<D> options;
  options.cells = counts<D>(values, "cells");
  options.jitter = number(values, "jitter");
  options.seed = seed(values);
  options.map = placement<D>(values);
  if constexpr (D == 2)
    return triangle_grid(options);
  else
    return tetrahedral_grid(options);
}

template <int D>
Any_soup lattice(const Generator_values& values) {
  auto options = mixed_lattice_world<D>(seed(values));
  options.cells = counts<D>(values, "cells");
  options.map = placement<D>(values);
  options.slit_share = number(values, "slits");
  return lattice_world(options);
}

Any_soup vessel(const Generator_values& values) {
  Vessel_options options;
  options.generations = static_cast<int>(number(values, "generations"));
  options.length = number(values, "length");
  options.curvature = number(values, "curvature");
  options.cell_size = number(values, "cell_size");
  options.radius = number(values, "radius");
  options.tissue = number(values, "tissue");
  options.seed = seed(values);
  return branching_vessel(options);
}

Any_soup tube(const Generator_values& values) {
  Bulge_options options;
  options.length = number(values, "length");
  options.bend = number(values, "bend");
  options.bulge_radius = number(values, "bulge_radius");
  options.bulge_offset = number(values, "bulge_offset");
  options.cell_size = number(values, "cell_size");
  options.radius = number(values, "radius");
  options.tissue = number(values, "tissue");
  return bulging_tube(options);
}

Any_soup room(const Generator_values& values) {
  Room_options options;
  options.rooms = counts<2>(values, "rooms");
  options.room_size = counts<2>(values, "room_size");
  options.door = static_cast<std::uint32_t>(number(values, "door"));
  options.obstacles = static_cast<std::uint32_t>(number(values, "obstacles"));
  options.keep_obstacles = flag(values, "keep_obstacles");
  options.square = number(values, "square");
  options.seed = seed(values);
  return room_2d(options);
}

const Generator_option seed_option{"seed", "What is random follows from it", {1}, false, true};

/// The options of every lattice, and further ones.
std::vector<Generator_option> lattice_options(int dimension, double cells,
                                              std::vector<Generator_option> more) {
  const std::size_t axes = static_cast<std::size_t>(dimension);
  std::vector<Generator_option> options{
      {"cells", "Cells along each axis", std::vector<double>(axes, cells), false, true}, seed_option};
  options.insert(options.end(), more.begin(), more.end());
  options.push_back({"scale", "Size of a cell", {1}});
  options.push_back(
      {"rotated", "Turned so that no plane stays parallel to an axis; cells get larger", {0}, true});
  options.push_back({"sheared", "Leaning by half a cell", {0}, true});
  return options;
}

std::vector<Generator> make_table() {
  const Generator_option solid{"solid", "Share of cells that are solid and touch each other nowhere", {0}};
  const Generator_option slits{
      "slits",
      "Share of squares at which a slit begins, two walls in one place; read it with --duplicates keep",
      {0}};
  const Generator_option jitter{"jitter", "Points move by up to this much along each axis, in cells", {0}};
  const Generator_option cell_size{"cell_size", "Size of the lattice it is cut from, in trunk radii", {0.3}};
  const Generator_option radius{"radius", "Of the trunk: scales everything", {1}};
  const Generator_option tissue{
      "tissue",
      "Thickness of solid cells around it, in trunk radii; 0: none, else at least 1.25 cell sizes",
      {0}};
  return {
      {"hexes", "A grid of hexahedra, some of them solid", lattice_options(3, 10, {solid}), grid<3>},
      {"tets", "A grid of cubes cut into tetrahedra", lattice_options(3, 10, {jitter}), simplex_grid<3>},
      {"vessel",
       "A branching vessel, in tetrahedra",
       {{"generations", "How often it forks", {3}, false, true},
        {"length", "Of the trunk, in its radii; branches are shorter and thinner", {7}},
        {"curvature", "How far branches bend sideways, from 0 to 1", {0.35}},
        cell_size,
        radius,
        tissue,
        seed_option},
       vessel},
      {"tube",
       "A bent tube with a bulge, in tetrahedra",
       {{"length", "From end to end, in radii", {14}},
        {"bend", "Height of the bend, as a share of the length", {0.4}},
        {"bulge_radius", "Radius of the bulge, in radii; 0: none", {2}},
        {"bulge_offset", "Of the bulge from the centre line, in radii", {2}},
        cell_size,
        radius,
        tissue},
       tube},
      {"lattice", "Cells of many shapes, membranes, solid and missing cells", lattice_options(3, 4, {slits}),
       lattice<3>},
      {"room2d",
       "2D: rooms with doors and polygonal obstacles",
       {{"rooms", "Along each axis", {3, 2}, false, true},
        {"room_size", "Of a room, in squares", {12, 10}, false, true},
        {"door", "Width of a doorway, in squares", {2}, false, true},
        {"obstacles", "In each room", {3}, false, true},
        {"keep_obstacles", "Keep obstacles as solid cells", {0}, true},
        {"square", "Size of a square", {1}},
        seed_option},
       room},
      {"squares", "2D: a grid of squares, some of them solid", lattice_options(2, 10, {solid}), grid<2>},
      {"triangles", "2D: a grid of squares cut into triangles", lattice_options(2, 10, {jitter}),
       simplex_grid<2>},
      {"lattice2d", "2D: cells of many shapes, membranes, solid and missing cells",
       lattice_options(2, 4, {slits}), lattice<2>},
  };
}

[[noreturn]] void refuse(const std::string& message) { throw Error(Error_code::usage, message); }

std::string names_of(const auto& entries) {
  std::string names;
  for (const auto& entry : entries) names += (names.empty() ? "" : ", ") + entry.name;
  return names;
}

/// The numbers of one option: those given, one repeated for every axis, or the default.
std::vector<double> complete(const Generator_option& option, const Generator_values& values) {
  const auto given = values.find(option.name);
  if (given == values.end()) return option.initial;
  std::vector<double> numbers = given->second;
  if (numbers.size() == 1) numbers.resize(option.initial.size(), numbers[0]);
  if (numbers.size() != option.initial.size())
    refuse(fmt::format("{} takes {} number{}, not {}", option.name,
                       option.initial.size() == 1 ? "1" : "1 or " + std::to_string(option.initial.size()),
                       option.initial.size() == 1 ? "" : "s", given->second.size()));
  for (const double x : numbers) {
    if (!std::isfinite(x)) refuse(option.name + " is not a finite number");
    const bool is_count = x == std::floor(x) && x >= 0 && x <= std::numeric_limits<std::uint32_t>::max();
    if (option.is_integer && !is_count)
      refuse(fmt::format("{} takes a whole number from 0 to 2^32 - 1, not {}", option.name, x));
  }
  return numbers;
}

}  // namespace

const std::vector<Generator>& generators() {
  static const std::vector<Generator> table = make_table();
  return table;
}

Any_soup generate(const std::string& name, const Generator_values& values) {
  const auto& table = generators();
  const auto by_name = [](const std::string& wanted) {
    return [&wanted](const auto& e) { return e.name == wanted; };
  };
  const auto generator = std::find_if(table.begin(), table.end(), by_name(name));
  if (generator == table.end()) refuse("there is no generator " + name + ": take one of " + names_of(table));
  for (const auto& [option, numbers] : values)
    if (std::none_of(generator->options.begin(), generator->options.end(), by_name(option)))
      refuse(fmt::format("{} has no option {}: it takes {}", name, option, names_of(generator->options)));
  Generator_values completed;
  for (const Generator_option& option : generator->options) completed[option.name] = complete(option, values);
  return generator->make(completed);
}

}  // namespace cellwalk
