// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wrong.h"

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/repro_file.h>
#include <cellwalk/io/mesh_file.h>

#include <fmt/format.h>

#include <algorithm>

namespace cellwalk::endurance {
namespace {

std::filesystem::path path_of(const Trial& trial, const char* sort) {
  std::filesystem::create_directories(trial.folder);
  std::string name = fmt::format("{} {} {:016x}", sort, trial.population.name(), trial.seed);
  std::replace(name.begin(), name.end(), ' ', '_');
  return trial.folder / name;
}

}  // namespace

template <int D>
void keep_walk(const Trial& trial, const World<D>& world, const Walk_motion<D>& motion,
               const std::string& what) {
  Repro<D> repro;
  repro.soup = soup_of(world.lattice, world.place, world.bits);
  repro.from = motion.from;
  repro.to = motion.to;
  repro.cell = motion.cell;
  repro.note = what;
  io::write_repro(path_of(trial, "walk").replace_extension(".json"), repro);
}

template <int D>
void keep_sweep(const Trial& trial, const World<D>& world, const Edge_sites<D>& move, double radius,
                const std::string& what) {
  const auto path = path_of(trial, radius > 0 ? "thick" : "sweep");
  io::write_ovm(std::filesystem::path(path).replace_extension(".ovm"),
                soup_of(world.lattice, world.place, world.bits));
  std::string header, row;
  for (const auto& [name, site] : {std::pair{'p', &move.a}, {'t', &move.b}, {'q', &move.q}}) {
    const Point<D> x = world.place(*site);
    for (std::size_t i = 0; i < D; ++i) {
      header += fmt::format("{}{},", name, "xyz"[i]);
      row += fmt::format("{:.17g},", x[i]);
    }
  }
  io::write_file(std::filesystem::path(path).replace_extension(".csv"),
                 fmt::format("{}radius\n{}{:.17g}\n", header, row, radius));
  io::write_file(std::filesystem::path(path).replace_extension(".txt"), what + "\n");
}

template void keep_walk(const Trial&, const World<2>&, const Walk_motion<2>&, const std::string&);
template void keep_walk(const Trial&, const World<3>&, const Walk_motion<3>&, const std::string&);
template void keep_sweep(const Trial&, const World<2>&, const Edge_sites<2>&, double, const std::string&);
template void keep_sweep(const Trial&, const World<3>&, const Edge_sites<3>&, double, const std::string&);

}  // namespace cellwalk::endurance
