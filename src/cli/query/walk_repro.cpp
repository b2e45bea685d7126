// SPDX-License-Identifier: LGPL-3.0-or-later
// The walk from each possible start cell, printed and compared with the exact walk.
#include "walk_repro.h"

#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/io/numbers.h>
#include <cellwalk/internal/io/repro_file.h>
#include <cellwalk/walk/locate.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/common/contact_kind_names.h"
#include "cli/common/environment_file.h"
#include "walk_log.h"

namespace cellwalk::cli {
namespace {

template <std::size_t N>
std::string point_text(const std::array<double, N>& p) {
  std::string decimal, exact;
  for (const double x : p) {
    decimal += ' ' + io::shortest(x);
    exact += ' ' + io::hexadecimal(x);
  }
  return decimal + "  =" + exact;
}

/// The value of a word in a repro file.
template <class T>
T value_of(const char* key, const std::string& word, std::initializer_list<std::pair<const char*, T>> words) {
  for (const auto& [name, value] : words)
    if (word == name) return value;
  throw Error(Error_code::input, fmt::format("{}: unknown word \"{}\"", key, word));
}

/// The cells from which to walk: that of the repro file, or all on whose sides the start may lie.
template <int D>
std::vector<Cell> start_cells(const Repro<D>& record, const Snapshot<D>& snapshot, const Location<D>& start) {
  if (record.cell) {
    const Cell cell = snapshot.cell(*record.cell);
    if (std::find(start.cells.begin(), start.cells.end(), cell) == start.cells.end())
      throw Error(Error_code::outside, fmt::format("the motion does not start in cell {}", *record.cell));
    return {cell};
  }
  if (start.cells.empty()) throw Error(Error_code::outside, "the motion starts in no free cell");
  if (start.sides.size() == 1) return {start.cell};
  return start.cells;
}

template <int D>
void print_motion(const Repro<D>& record) {
  fmt::print("note: {}\ncells: {}\nfrom:{}\nto:{}\n", record.note, record.soup.cell_count(),
             point_text(record.from), point_text(record.to));
}

template <class Kernel, int D>
void walk_again(const Repro<D>& record, const Snapshot<D>& snapshot, Walk_strategy strategy) {
  const Location<D> start = Locator<D>(snapshot).locate(record.from);
  const std::vector<Cell> cells = start_cells(record, snapshot, start);
  print_motion(record);
  for (const Cell cell : cells) {
    const Particle<D> particle{record.from, cell, start.dimension, 0};
    const Logged_walk<D> walked = logged_walk<Kernel>(snapshot, particle, record.to, strategy);
    const Logged_walk<D> exact = logged_walk<Exact>(snapshot, particle, record.to, Walk_strategy::exit_rule);
    fmt::print("from cell {}, kernel {}:\n{}", snapshot.index(cell), record.kernel,
               log_text<Kernel>(snapshot, record.from, record.to, walked));
    fmt::print("from cell {}, kernel exact:\n{}", snapshot.index(cell),
               log_text<Exact>(snapshot, record.from, record.to, exact));
    fmt::print("compared with the exact walk: {}\n", comparison(walked, exact));
  }
}

/// The answer of a motion with a radius, in one line.
template <int D>
std::string thick_answer(const Snapshot<D>& snapshot, const detail::Thick_result<D>& result) {
  if (!result.contact) return "is free";
  const Contact<D>& contact = *result.contact;
  const std::string wall =
      fmt::format("a wall of cell {}: {}, nearest at{}", snapshot.index(snapshot.cell_of(contact.facet)),
                  contact_kind_names[static_cast<std::size_t>(contact.kind)], point_text(contact.point));
  if (result.starts_close) return fmt::format("starts at a distance of {} from {}", contact.distance, wall);
  return fmt::format("is blocked at time {} by {}; normal{}", contact.time, wall, point_text(contact.normal));
}

template <int D>
void sweep_again(const Repro<D>& record, const Snapshot<D>& snapshot) {
  const Location<D> start = Locator<D>(snapshot).locate(record.from);
  const std::vector<Cell> cells = start_cells(record, snapshot, start);
  print_motion(record);
  fmt::print("radius:{}\n", point_text(std::array{record.radius}));
  for (const Cell cell : cells) {
    Edge_counts counts;
    const auto result =
        detail::sweep_thick<D>(snapshot, cell, {record.from, record.to, {}, record.radius}, counts);
    fmt::print("from cell {}: {}; {} cells flooded, {} walls there\n", snapshot.index(cell),
               thick_answer(snapshot, result), counts.flooded_cells, counts.search_walls);
  }
}

template <int D>
void replay(const Repro<D>& record) {
  const auto kernel = value_of("kernel", record.kernel, kernel_names);
  const auto strategy = value_of("strategy", record.strategy, strategy_names);
  if (strategy == Walk_strategy::certified && kernel != Kernel_choice::exact)
    throw Error(Error_code::input, "strategy: certified needs the kernel exact");
  if (record.radius != 0 && kernel != Kernel_choice::exact)
    throw Error(Error_code::input, "kernel: motions with a radius need exact");
  const Environment<D> environment =
      Environment<D>::build(record.soup, {Duplicate_vertices::keep, false, false});
  if (record.radius != 0) return sweep_again(record, environment.snapshot());
  with_kernel(kernel,
              [&](auto policy) { walk_again<decltype(policy)>(record, environment.snapshot(), strategy); });
}

}  // namespace

void walk_repro(const std::string& path) {
  const Any_repro any = io::read_repro(path);
  naming(path, [&] { std::visit([](const auto& record) { replay(record); }, any); });
}

template <int D>
void write_repro_of(io::Atomic_file& file, const Environment<D>& environment, const Query_row<D, 2>& motion,
                    const Walk_method& method, const std::string& note) {
  Repro<D> record;
  record.soup = environment.soup();
  record.from = motion.points[0];
  record.to = motion.points[1];
  record.radius = motion.radius;
  record.note = note;
  for (const auto& [name, value] : kernel_names)
    if (value == method.kernel) record.kernel = name;
  for (const auto& [name, value] : strategy_names)
    if (value == method.strategy) record.strategy = name;
  io::write_repro(file, record);
}

template void write_repro_of<2>(io::Atomic_file&, const Environment<2>&, const Query_row<2, 2>&,
                                const Walk_method&, const std::string&);
template void write_repro_of<3>(io::Atomic_file&, const Environment<3>&, const Query_row<3, 2>&,
                                const Walk_method&, const std::string&);

}  // namespace cellwalk::cli
