// SPDX-License-Identifier: LGPL-3.0-or-later
// The loading of bodies, and their counts of moves, edges and contacts in words and as JSON.
#include "bodies.h"

#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/generators/body_of_shape.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <numeric>
#include <optional>
#include <utility>

#include "cli/common/contact_kind_names.h"
#include "cli/common/counts_json.h"

namespace cellwalk::cli {
namespace {

using nlohmann::ordered_json;

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

double percent(std::uint64_t part, std::uint64_t whole) { return 100 * share(part, whole); }

std::uint64_t sum(const std::array<std::uint64_t, 3>& by_kind) {
  return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0});
}

}  // namespace

template <int D>
Scene_bodies<D> load_bodies(const Scene<D>& scene, const std::string& scene_name) {
  Scene_bodies<D> result;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string key = fmt::format("bodies[{}]", i);
    if (const auto* file = std::get_if<std::string>(&scene.bodies[i].source)) {
      io::Body_file<D> read = io::read_body<D>(*file);
      result.shapes.push_back(std::move(read.body));
      for (const std::string& note : read.report.notes) result.notes.push_back(key + ": " + note);
      if (const auto& radius = scene.bodies[i].edge_radius; radius && !result.shapes.back().radii.empty())
        result.notes.push_back(
            fmt::format("{}: edge_radius {} instead of the radii of {}", key, *radius, *file));
      continue;
    }
    try {
      result.shapes.push_back(generate_body(std::get<Body_shape<D>>(scene.bodies[i].source)));
    } catch (const Error& error) {
      // A shape is input here, whatever it would be in a call.
      throw Error(Error_code::input, fmt::format("{}: {}: {}", scene_name, key, error.what()));
    }
  }
  return result;
}

template <int D>
Body_sizes sizes_of(const World<D>& world, const Scene<D>& scene) {
  Body_sizes sizes;
  sizes.bodies = world.bodies().size();
  for (std::size_t i = 0; i < sizes.bodies; ++i) {
    const Moving_body<D>& moving = world.bodies()[i];
    sizes.vertices += moving.body().vertex_count();
    sizes.edges += moving.body().edges().size();
    sizes.faces += moving.body().faces().size();
    sizes.have_radii |= detail::Body_access<D>::has_radii(moving.body());
    const std::optional<std::size_t> entry = world.entry_of(i);
    if (!entry) continue;
    sizes.guided += scene.bodies[*entry].guided.has_value();
    sizes.arrived += world.has_arrived(i);
  }
  return sizes;
}

ordered_json bodies_json(const Body_sizes& sizes, const Body_contacts& contacts,
                         const std::vector<std::string>& notes) {
  ordered_json result{
      {"count", sizes.bodies}, {"vertices", sizes.vertices}, {"edges", sizes.edges}, {"faces", sizes.faces}};
  if (sizes.guided > 0) result["guided"] = {{"count", sizes.guided}, {"arrived", sizes.arrived}};
  for (std::size_t f = 0; f < contacts.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      result["contacts"][feature_names[f]][contact_kind_names[k]] = contacts[f][k];
  if (!notes.empty()) result["notes"] = notes;
  return result;
}

ordered_json shares_json(const Edge_counts& c) {
  return {{"same_cell", share(c.same_cell, c.edges)},
          {"same_chain", share(c.same_chain, c.edges)},
          {"relinked", share(c.relinked, c.edges)},
          {"event_sweeps", share(c.event_sweeps, c.edges)}};
}

ordered_json to_json(const Body_counts& c) {
  ordered_json result = to_json<Body_counts>(c);
  result["edges"] = to_json(c.edges);
  result["shares"] = {{"in_region", share(c.in_region, c.moves)}};
  result["shares"].update(shares_json(c.edges));
  if (c.faces.faces > 0) result["faces"] = to_json(c.faces);
  result["walks"] = to_json(c.edges.walk);
  return result;
}

std::string describe_contacts(const Body_contacts& contacts) {
  return fmt::format("{} of vertices, {} of edges, {} of faces", sum(contacts[0]), sum(contacts[1]),
                     sum(contacts[2]));
}

std::string describe_moves(const Body_counts& c) {
  return fmt::format("{} of vertices, {:.1f} % of them in regions free of walls, without a test", c.moves,
                     percent(c.in_region, c.moves));
}

std::string describe_edges(const Edge_counts& e) {
  return fmt::format(
      "{} checked: {:.1f} % in one cell, {:.1f} % along the same "
      "chain, {:.1f} % round ridges, {:.1f} % by their events",
      e.edges, percent(e.same_cell, e.edges), percent(e.same_chain, e.edges), percent(e.relinked, e.edges),
      percent(e.event_sweeps, e.edges));
}

template Scene_bodies<2> load_bodies(const Scene<2>&, const std::string&);
template Scene_bodies<3> load_bodies(const Scene<3>&, const std::string&);
template Body_sizes sizes_of(const World<2>&, const Scene<2>&);
template Body_sizes sizes_of(const World<3>&, const Scene<3>&);

}  // namespace cellwalk::cli
