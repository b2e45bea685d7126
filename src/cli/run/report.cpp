// SPDX-License-Identifier: LGPL-3.0-or-later
// The contents of run.json, and the sentences of the summary.
#include "report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "bodies.h"
#include "catheter.h"
#include "cli/common/contact_kind_names.h"
#include "cli/common/counts_json.h"
#include "cli/common/environment_file.h"
#include "cli/common/printable.h"
#include "trace.h"

namespace cellwalk::cli {

using nlohmann::ordered_json;

template <int D>
std::string caption(const Run_input<D>& input, const Run_parts<D>& parts) {
  const World<D>& world = parts.world;
  const std::string title = input.scene.title.empty() ? "" : input.scene.title + ": ";
  const auto& by_kind = parts.files.contacts();
  std::string text = title;
  if (const Rod<D>* rod = world.catheter())
    text += fmt::format("catheter of {} vertices, ", rod->body().vertex_count());
  if (!world.particles().empty()) text += fmt::format("{} free particles, ", world.particles().size());
  if (const std::size_t count = world.bodies().size() - input.scene.catheter.has_value(); count > 0)
    text += fmt::format("{} {}, ", count, count == 1 ? "body" : "bodies");
  return text + fmt::format("{} steps, {} contacts", input.steps(), by_kind[0] + by_kind[1] + by_kind[2]);
}

template <int D>
ordered_json report(const Run_input<D>& input, const Run_parts<D>& parts) {
  const World<D>& world = parts.world;
  const Run_files<D>& files = parts.files;
  ordered_json result{{"dimension", D}, {"steps", input.steps()}, {"time_step", input.scene.time_step}};
  result["environment"] = cli::to_json(input.certificate, D);
  result["particles"] = {{"free", world.particles().size()}};
  // An object from the start: a null that becomes one is broken if its memory fails.
  ordered_json kinds = ordered_json::object();
  for (std::size_t k = 0; k < 3; ++k) kinds[contact_kind_names[k]] = files.contacts()[k];
  result["contacts"] = kinds;
  if (!world.bodies().empty())
    result["bodies"] = bodies_json(sizes_of(world, input.scene), files.body_contacts(), input.notes);
  if (const Rod<D>* rod = world.catheter()) result["catheter"] = catheter_json(*rod);
  if (parts.walls) result["walls"] = parts.walls->report();
  if (parts.changes) result["changes"] = parts.changes->report();
  result["frames"] = files.frame_count();
  if (parts.motion)
    result["motion"] = {{"every", parts.motion->every()}, {"records", parts.motion->frame_count()}};
  result["validated"] = true;  // World::validate has returned
  result["counts"] = to_json(world.counts());
  if (!world.bodies().empty()) result["body_counts"] = to_json(world.body_counts());
  // Everything needed to repeat the run, and nothing that differs between machines or days: the scene as it
  // was run, too.
  constexpr bool throws = true, skips_comments = true;
  result["manifest"] = {
      {"cellwalk", CELLWALK_VERSION},
      {"scene", ordered_json::parse(input.options.scene_text, nullptr, throws, skips_comments)}};
  if (!world.bodies().empty())
    result["manifest"]["sweep"] = sweep_names[static_cast<std::size_t>(input.options.body.sweep.sweep)];
  return result;
}

template <int D>
std::string summary(const Run_input<D>& input, const Run_parts<D>& parts, const std::string& not_drawn) {
  const World<D>& world = parts.world;
  const Run_files<D>& files = parts.files;
  const Run_options& options = input.options;
  const Certificate& certificate = input.certificate;
  std::string text =
      fmt::format("{}: {}D, {} steps of {}\n", options.scene, D, input.steps(), input.scene.time_step);
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  const auto& contacts = files.contacts();
  line("environment", fmt::format("{} cells, {} walls, certified", certificate.cells, certificate.walls));
  for (std::size_t i = 0; i < input.import_lines.size(); ++i)
    line(i == 0 ? "imported" : "", input.import_lines[i]);
  if (!world.particles().empty()) line("particles", fmt::format("{} free", world.particles().size()));
  const Body_sizes sizes = sizes_of(world, input.scene);
  if (sizes.bodies > 0)
    line("bodies", fmt::format("{}, with {} vertices, {} edges, {} faces", sizes.bodies, sizes.vertices,
                               sizes.edges, sizes.faces));
  line("contacts",
       fmt::format("{} ({} with facets, {} with edges, {} with vertices)",
                   contacts[0] + contacts[1] + contacts[2], contacts[2], contacts[1], contacts[0]));
  if (sizes.bodies > 0) {
    line("of bodies", describe_contacts(files.body_contacts()));
    line("moves", describe_moves(world.body_counts()));
    line("edges", describe_edges(world.body_counts().edges));
  }
  if (sizes.guided > 0)
    line("guided", fmt::format("{} of {} bodies at the end of their paths", sizes.arrived, sizes.guided));
  if (const Rod<D>* rod = world.catheter()) line("catheter", describe_catheter(*rod));
  if (parts.walls) line("walls", parts.walls->describe());
  if (parts.changes) line("changes", parts.changes->describe());
  line("validated",
       sizes.bodies > 0
           ? fmt::format(
                 "every particle and vertex lies in its cell, no edge crosses a wall{}, by exact predicates",
                 sizes.have_radii ? " or is nearer to one than its radius" : "")
           : "every particle lies in its cell, by exact predicates");
  std::string written = "run.json, contacts.csv";
  if (parts.walls) written += input.scene.walls->soft ? ", walls.csv, forces.csv" : ", walls.csv";
  if (parts.changes) written += ", changes.csv";
  if (files.frame_count() > 0) written += fmt::format(", run.pvd ({} frames)", files.frame_count());
  if (parts.motion) written += ", motion.gz";
  if (parts.picture && not_drawn.empty()) written += ", picture.png";
  line("written", fmt::format("{}: {}", options.folder, written));
  if (!not_drawn.empty()) line("no picture", not_drawn);
  if (!options.record.empty()) line("recorded", options.record);
  return text;
}

std::string not_written(const Run_settings& began, const Run_options& now) {
  std::string text;
  const auto line = [&](const std::string& name, const std::string& given, const char* option,
                        const char* inside) {
    if (!name.empty() && given.empty())
      text += fmt::format("  {:<12}{}: lies outside of {}, and {} was not given again; copy {}\n",
                          "not written", printable(name), now.folder, option,
                          (std::filesystem::path(now.folder) / inside).string());
  };
  line(began.record, now.record, "--record", kept_trace_name);
  line(began.json, now.json, "--json", "run.json");
  return text;
}

template ordered_json report(const Run_input<2>&, const Run_parts<2>&);
template ordered_json report(const Run_input<3>&, const Run_parts<3>&);
template std::string summary(const Run_input<2>&, const Run_parts<2>&, const std::string&);
template std::string summary(const Run_input<3>&, const Run_parts<3>&, const std::string&);
template std::string caption(const Run_input<2>&, const Run_parts<2>&);
template std::string caption(const Run_input<3>&, const Run_parts<3>&);

}  // namespace cellwalk::cli
