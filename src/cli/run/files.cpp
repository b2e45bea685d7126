// SPDX-License-Identifier: LGPL-3.0-or-later
// Rows of contacts and frames, written step by step.
#include "files.h"

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <filesystem>
#include <limits>
#include <string>
#include <system_error>

#include "cli/common/contact_kind_names.h"
#include "grids.h"

namespace cellwalk::cli {
namespace {

/// An integer, or an empty field.
std::string field(bool is_there, std::uint32_t value) { return is_there ? std::to_string(value) : ""; }

}  // namespace

template <int D>
Run_files<D>::Run_files(Result_files& place, const Environment<D>& environment, const World<D>& world,
                        const Scene<D>& scene)
    : place_(place),
      environment_(environment),
      every_(scene.output.frame_every),
      time_step_(scene.time_step),
      walls_change_(scene.walls.has_value() || !scene.changes.list.empty()),
      table_(place.table("contacts.csv", {"step", "particle", "time", "x", "y", "z", "kind", "nx", "ny", "nz",
                                          "cell", "body", "vertex", "feature", "number"})) {
  if (every_ == 0) return;
  const std::filesystem::path frames = place.folder() / "frames";
  if (place.is_continued()) {
    if (std::error_code ignored; !std::filesystem::is_directory(frames, ignored))
      throw Error(Error_code::input,
                  frames.string() + ": is missing, and was there at the checkpoint: begin the run again");
    return;
  }
  std::filesystem::create_directory(frames);
  if (!walls_change_) {
    io::write_vtu(place.folder() / "walls.vtu", io::vtu_of_walls(environment_.soup()));
    place.note("walls.vtu");
  }
  write_frame(world);
  before_ = body_positions(world);
}

template <int D>
void Run_files<D>::record(const World<D>& world, bool is_last) {
  // In the plane the third coordinates are left empty, as the writer does with numbers that are not finite.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const Run_contact<D>& c : world.contacts()) {
    const Point<D>& x = c.contact.point;
    const Vector<D>& normal = c.contact.normal;
    const auto feature = static_cast<std::size_t>(c.contact.body),
               kind = static_cast<std::size_t>(c.contact.kind);
    const double z = D == 3 ? x[D - 1] : nothing, nz = D == 3 ? normal[D - 1] : nothing;
    ++contacts_[kind];
    if (c.body) ++body_contacts_[feature][kind];
    table_.row(c.step, field(!c.body, c.particle), c.contact.time, x[0], x[1], z, contact_kind_names[kind],
               normal[0], normal[1], nz, c.cell, field(c.body.has_value(), c.body.value_or(0)),
               field(c.body.has_value(), c.contact.vertex), c.body ? feature_names[feature] : "",
               field(c.body.has_value(), c.contact.feature));
  }
  if (every_ == 0) return;
  since_frame_.insert(since_frame_.end(), world.contacts().begin(), world.contacts().end());
  if (is_last || world.steps_done() % every_ == 0) write_frame(world);
  before_ = body_positions(world);
}

template <int D>
void Run_files<D>::write_frame(const World<D>& world) {
  const double time = world.steps_done() * time_step_;
  const auto add = [&](const char* part, const io::Vtu_grid& grid) {
    const std::string file = fmt::format("frames/{}_{:05}.vtu", part, frames_);
    io::write_vtu(place_.folder() / file, grid);
    place_.note(file);
    entries_.push_back({time, part, file});
  };
  const bool has_bodies = !world.bodies().empty();
  if (!has_bodies || !world.particles().empty()) add("particles", particles_grid(world, since_frame_));
  if (has_bodies) add("bodies", bodies_grid(world, since_frame_, before_, time_step_));
  add("contacts", contacts_grid(since_frame_));
  if (walls_change_)
    add("walls", io::vtu_of_walls(environment_.soup()));
  else
    entries_.push_back({time, "walls", "walls.vtu"});
  since_frame_.clear();
  ++frames_;
}

template <int D>
void Run_files<D>::finish() {
  table_.commit();
  if (every_ != 0) io::write_file(place_.folder() / "run.pvd", io::pvd_text(entries_));
}

template class Run_files<2>;
template class Run_files<3>;

}  // namespace cellwalk::cli
