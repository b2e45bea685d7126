// SPDX-License-Identifier: LGPL-3.0-or-later
// The path of a catheter between two places, how far it came, and why no farther.
#include "catheter.h"

#include <cellwalk/internal/simulation/centre_line.h>
#include <cellwalk/internal/simulation/change_schedule.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/common/progress.h"

namespace cellwalk::cli {
namespace {

/// Why a catheter did not arrive: a word, and a sentence.
struct Reason {
  const char* word;
  std::string text;
};

template <int D>
Reason why_short(const Rod<D>& rod) {
  if (rod.is_held()) return {"walls", "walls hold it back"};
  if (rod.is_all_inside()) return {"length", "all of it is inside: it needs more particles"};
  return {"steps", fmt::format("the steps were over: it needs about {} more", rod.steps_left())};
}

}  // namespace

template <int D>
void lay_catheter(Scene<D>& scene, const std::string& scene_name, const Snapshot<D>& snapshot,
                  const Groups<D>& groups) {
  if (!scene.catheter || !scene.catheter->ends) return;
  const Progress progress("finding the centre line of the catheter");
  try {
    lay_along_centre_line(snapshot, all_groups(snapshot, scene.changes, groups), *scene.catheter);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", scene_name, error.what()));
  }
}

template <int D>
nlohmann::ordered_json catheter_json(const Rod<D>& rod) {
  nlohmann::ordered_json result{{"arrived", rod.has_arrived()},
                                {"travelled", rod.travelled()},
                                {"tip", rod.tip()},
                                {"waypoint", rod.next_waypoint()},
                                {"path", rod.waypoints()},
                                {"length_inside", rod.length_inside()},
                                {"twist", rod.twist()},
                                {"steps_waited", rod.steps_waited()}};
  if (!rod.has_arrived()) result["held_by"] = why_short(rod).word;
  return result;
}

template <int D>
std::string describe_catheter(const Rod<D>& rod) {
  const std::string inside =
      fmt::format("{} vertices, {:.4g} long inside, ", rod.body().vertex_count(), rod.length_inside());
  if (rod.has_arrived())
    return inside + fmt::format("arrived at the last of {} waypoints", rod.waypoints().size());
  return inside + fmt::format("on its way to waypoint {} of {}, after {:.3g} % of the path, at ({:.6g}); {}",
                              rod.next_waypoint() + 1, rod.waypoints().size(), 100 * rod.travelled(),
                              fmt::join(rod.tip(), ", "), why_short(rod).text);
}

template void lay_catheter(Scene<2>&, const std::string&, const Snapshot<2>&, const Groups<2>&);
template void lay_catheter(Scene<3>&, const std::string&, const Snapshot<3>&, const Groups<3>&);
template nlohmann::ordered_json catheter_json(const Rod<2>&);
template nlohmann::ordered_json catheter_json(const Rod<3>&);
template std::string describe_catheter(const Rod<2>&);
template std::string describe_catheter(const Rod<3>&);

}  // namespace cellwalk::cli
