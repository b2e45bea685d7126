// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies of a run: read or generated before it, reported after it.
#ifndef CELLWALK_CLI_RUN_BODIES_H
#define CELLWALK_CLI_RUN_BODIES_H

#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/records/body_soup.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "cli/common/counts_json.h"
#include "files.h"

namespace cellwalk::cli {

/// The bodies of a scene, one for each entry, before they are placed.
template <int D>
struct Scene_bodies {
  std::vector<Body_soup<D>> shapes;
  std::vector<std::string> notes;  ///< parts that the readers left out or interpreted, with the scene's key
};

/// \throw Error(input) naming the file of a body, or the scene and its key
template <int D>
Scene_bodies<D> load_bodies(const Scene<D>& scene, const std::string& scene_name);

/// The numbers of bodies and of their parts, the catheter included.
struct Body_sizes {
  std::size_t bodies = 0, vertices = 0, edges = 0, faces = 0, guided = 0, arrived = 0;
  bool have_radii = false;
};
template <int D>
Body_sizes sizes_of(const World<D>& world, const Scene<D>& scene);

/// Sizes, contacts and notes.
nlohmann::ordered_json bodies_json(const Body_sizes& sizes, const Body_contacts& contacts,
                                   const std::vector<std::string>& notes);
/// The share of edge checks that each certificate decided.
nlohmann::ordered_json shares_json(const Edge_counts& counts);
/// Counts, and the share of vertex moves and edge checks that each certificate decided.
nlohmann::ordered_json to_json(const Body_counts& counts);

/// For people: contacts by feature, and the ways in which moves of vertices and checks of edges were decided.
std::string describe_contacts(const Body_contacts& contacts);
std::string describe_moves(const Body_counts& counts);
std::string describe_edges(const Edge_counts& e);

extern template Scene_bodies<2> load_bodies(const Scene<2>&, const std::string&);
extern template Scene_bodies<3> load_bodies(const Scene<3>&, const std::string&);
extern template Body_sizes sizes_of(const World<2>&, const Scene<2>&);
extern template Body_sizes sizes_of(const World<3>&, const Scene<3>&);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_BODIES_H
