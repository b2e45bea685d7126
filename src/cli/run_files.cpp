// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/run_files.h"

#include <cellwalk/io/atomic_file.h>

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "cli/kind_names.h"

namespace cellwalk::cli {
namespace {

using io::in_space;

template <int D>
void append_vector(std::vector<double>& values, const std::array<double, D>& v) {
  const Point<3> p = in_space(v);
  values.insert(values.end(), p.begin(), p.end());
}

/// Particles as vertices, and the catheter as a line through its particles.
template <int D>
io::Vtu_grid particles_grid(const World<D>& world, const std::vector<Contact_record<D>>& contacts) {
  io::Vtu_grid grid;
  const auto particles = world.particles();
  std::vector<double> velocity;
  std::vector<std::int64_t> number(particles.size()), met(particles.size(), 0), catheter(particles.size(), 0);
  std::iota(number.begin(), number.end(), 0);
  for (const Contact_record<D>& c : contacts) ++met[c.particle];
  std::vector<std::uint32_t> line;
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    grid.points.push_back(in_space(particles[i].position));
    append_vector<D>(velocity, world.velocities()[i]);
    const std::uint32_t vertex[] = {i};
    grid.add_cell(io::Vtu_cell::vertex, vertex);
    if (i < world.free_count()) continue;
    catheter[i] = 1;
    line.push_back(i);
  }
  if (line.size() > 1) grid.add_cell(io::Vtu_cell::polyline, line);
  grid.point_data.push_back({"particle", 1, std::move(number)});
  grid.point_data.push_back({"catheter", 1, std::move(catheter)});
  grid.point_data.push_back({"contacts", 1, std::move(met)});
  grid.point_data.push_back({"velocity", 3, std::move(velocity)});
  return grid;
}

/// Contacts as vertices with their normals.
template <int D>
io::Vtu_grid contacts_grid(const std::vector<Contact_record<D>>& contacts) {
  io::Vtu_grid grid;
  std::vector<std::int64_t> step, particle, kind;
  std::vector<double> normal;
  for (const Contact_record<D>& c : contacts) {
    const std::uint32_t vertex[] = {static_cast<std::uint32_t>(grid.points.size())};
    grid.points.push_back(in_space(c.point));
    grid.add_cell(io::Vtu_cell::vertex, vertex);
    step.push_back(c.step);
    particle.push_back(c.particle);
    kind.push_back(static_cast<std::int64_t>(c.kind));
    append_vector<D>(normal, c.normal);
  }
  grid.point_data.push_back({"step", 1, std::move(step)});
  grid.point_data.push_back({"particle", 1, std::move(particle)});
  grid.point_data.push_back({"kind", 1, std::move(kind)});
  grid.point_data.push_back({"normal", 3, std::move(normal)});
  return grid;
}

}  // namespace

template <int D>
Run_files<D>::Run_files(std::filesystem::path folder, const Cell_soup<D>& soup, const World<D>& world,
                        const Scene<D>& scene)
    : folder_(std::move(folder)),
      every_(scene.output.frame_every),
      time_step_(scene.time_step),
      table_(folder_ / "contacts.csv",
             {"step", "particle", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cell"}) {
  if (every_ == 0) return;
  std::filesystem::create_directory(folder_ / "frames");
  io::write_vtu(folder_ / "walls.vtu", io::vtu_of_walls(soup));
  write_frame(world);
}

template <int D>
void Run_files<D>::record(const World<D>& world, bool is_last) {
  // In the plane the third coordinates are left empty, as the writer does with what is not finite.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const Contact_record<D>& c : world.contacts()) {
    ++contacts_[static_cast<std::size_t>(c.kind)];
    const double z = D == 3 ? c.point[D - 1] : nothing, nz = D == 3 ? c.normal[D - 1] : nothing;
    table_.row(c.step, c.particle, c.time, c.point[0], c.point[1], z,
               kind_names[static_cast<std::size_t>(c.kind)], c.normal[0], c.normal[1], nz, c.cell);
  }
  if (every_ == 0) return;
  since_frame_.insert(since_frame_.end(), world.contacts().begin(), world.contacts().end());
  if (is_last || world.steps_done() % every_ == 0) write_frame(world);
}

template <int D>
void Run_files<D>::write_frame(const World<D>& world) {
  const double time = world.steps_done() * time_step_;
  const auto add = [&](const char* part, const io::Vtu_grid& grid) {
    const std::string file = fmt::format("frames/{}_{:05}.vtu", part, frames_);
    io::write_vtu(folder_ / file, grid);
    entries_.push_back({time, part, file});
  };
  add("particles", particles_grid(world, since_frame_));
  add("contacts", contacts_grid(since_frame_));
  entries_.push_back({time, "walls", "walls.vtu"});
  since_frame_.clear();
  ++frames_;
}

template <int D>
void Run_files<D>::finish() {
  table_.commit();
  if (every_ != 0) io::write_file(folder_ / "run.pvd", io::pvd_text(entries_));
}

template class Run_files<2>;
template class Run_files<3>;

}  // namespace cellwalk::cli
