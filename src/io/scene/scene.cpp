// SPDX-License-Identifier: LGPL-3.0-or-later
// The keys of each part of a scene: environment, particles, catheter, walls and output.
#include <cellwalk/internal/io/scene.h>

#include <nlohmann/json.hpp>

#include "environment_changes.h"
#include "io/files/text.h"
#include "json_node.h"
#include "scene_bodies.h"

namespace cellwalk::io {
namespace {

using detail::Json_node;

constexpr std::uint64_t most_steps = 100'000'000;
constexpr double default_twist = 10;  // degrees a step
constexpr std::uint64_t most_spread = 1000;
constexpr std::uint64_t most_sweeps = 1000;
constexpr std::uint64_t most_rings = 100, most_operations = 1'000'000;
constexpr double most_tension = 0.9, most_compliance = 1e6;

std::string file_name(const Json_node& node) {
  if (node.string().empty()) node.fail("expected the name of a mesh file");
  return node.string();
}

/// Which options there are, and their values, are for those who import.
Import_call::Value import_value(const Json_node& node) {
  if (node.is_boolean()) return node.boolean();
  if (node.is_string()) return node.string();
  if (node.is_array()) return node.numbers();
  if (node.is_object()) node.fail("no option of an import takes an object");
  return node.number();
}

Import_call import_call(const Json_node& node) {
  Import_call result;
  result.cache = ".cellwalk-cache";
  for (const std::string& key : node.keys()) {
    const Json_node value = node.at(key);
    if (key == "import") {
      result.file = file_name(value);
    } else if (key == "obstacle") {
      for (const Json_node& file : value.is_array() ? value.elements() : std::vector<Json_node>{value})
        result.obstacles.push_back(file_name(file));
    } else {
      result.options[key] = import_value(value);
    }
  }
  return result;
}

Environment_source environment_source(const Json_node& node) {
  if (node.is_string()) return file_name(node);
  if (!node.is_object())
    node.fail("expected the name of a mesh file, {\"import\": ...} or {\"generate\": ...}");
  if (node.has("import")) return import_call(node);
  Generator_call generator_call;
  generator_call.generator = node.at("generate").string();
  for (const std::string& key : node.keys())
    if (key != "generate") generator_call.options[key] = node.at(key).numbers();
  return generator_call;
}

template <int D>
std::variant<Particle_start<D>, Particle_cloud> particle_source(const Json_node& node) {
  if (node.has("count")) {
    node.expect_keys({"count", "seed", "speed"});
    return detail::cloud(node);
  }
  node.expect_keys({"position", "velocity", "count", "seed", "speed"});
  if (!node.has("position")) node.fail("expected \"position\" or \"count\"");
  for (const char* key : {"seed", "speed"})
    if (const auto extra = node.find(key)) extra->fail("only for random particles: give \"count\" as well");
  Particle_start<D> start;
  start.position = node.at("position").tuple<D>();
  if (const auto velocity = node.find("velocity")) start.velocity = velocity->tuple<D>();
  return start;
}

/// The curved part of the tip, and the rotation of the base.
template <int D>
void curve(const Json_node& node, Catheter<D>& result) {
  if (const auto steering = node.find("steering")) {
    const std::string word = steering->string();
    if (word != "tip" && word != "twist" && word != "none")
      steering->fail("expected \"tip\", \"twist\" or \"none\"");
    result.steering = word == "tip" ? Steering::tip : word == "twist" ? Steering::twist : Steering::none;
  }
  if (const auto tip = node.find("tip")) {
    tip->expect_keys({"length", "degrees"});
    result.tip_length = tip->at("length").positive();
    result.tip_angle = tip->at("degrees").number_in(0, 360);
  }
  if (result.steering == Steering::twist) {
    if (!node.has("tip")) node.fail("steering by \"twist\" needs a curved \"tip\"");
    result.twist = default_twist;
  }
  if (const auto twist = node.find("twist")) {
    if (result.steering == Steering::tip) twist->fail("only for \"steering\" by \"twist\" or \"none\"");
    result.twist = twist->number_in(result.steering == Steering::none ? -180 : 0, 180);
  }
}

template <int D>
Catheter_end<D> catheter_end(const Json_node& node) {
  if (node.is_array()) return node.tuple<D>();
  if (!node.is_string() || node.string().empty()) node.fail("expected the name of a group, or a point");
  return node.string();
}

/// The ends between which the path is found; none if it is given.
template <int D>
std::optional<Catheter_ends<D>> catheter_ends(const Json_node& node) {
  if (!node.has("from") && !node.has("to")) return {};
  for (const char* key : {"path", "find_route"})
    if (const auto other = node.find(key))
      other->fail("the path is found between \"from\" and \"to\": leave it out");
  return Catheter_ends<D>{catheter_end<D>(node.at("from")), catheter_end<D>(node.at("to"))};
}

template <int D>
Catheter<D> catheter(const Json_node& node) {
  node.expect_keys({"particles", "spacing", "advance", "stiffness", "radius", "path", "find_route", "from",
                    "to", "steering", "tip", "twist"});
  Catheter<D> result;
  result.ends = catheter_ends<D>(node);
  if (result.ends) result.particles = 0, result.spacing = 0;
  if (!result.ends || node.has("spacing")) result.spacing = node.at("spacing").positive();
  result.advance = result.spacing / 2;
  if (const auto n = node.find("particles"))
    result.particles = static_cast<std::uint32_t>(n->integer_in(2, detail::most_particles));
  if (const auto advance = node.find("advance")) result.advance = advance->positive();
  if (const auto stiffness = node.find("stiffness")) result.stiffness = stiffness->number_in(0, 1);
  if (const auto radius = node.find("radius")) result.radius = radius->number_in(0, detail::largest_radius);
  if (const auto find_route = node.find("find_route")) result.find_route = find_route->boolean();
  curve(node, result);
  if (!result.ends) result.path = detail::waypoints<D>(node.at("path"));
  return result;
}

template <int D>
Pulsation<D> pulsation(const Json_node& node) {
  node.expect_keys({"amplitude", "period", "wave", "even", "smooth", "quality_floor"});
  Pulsation<D> result;
  result.amplitude = node.at("amplitude").positive();
  result.period = node.at("period").positive();
  if (const auto wave = node.find("wave")) {
    result.wave = wave->tuple<D>();
    if (!(dot(*result.wave, *result.wave) > 0)) wave->fail("a direction cannot be zero");
  }
  if (const auto even = node.find("even"))
    result.even = static_cast<std::uint32_t>(even->integer_in(0, most_sweeps));
  if (const auto smooth = node.find("smooth"))
    result.smooth = static_cast<std::uint32_t>(smooth->integer_in(0, most_sweeps));
  if (const auto floor = node.find("quality_floor")) result.quality_floor = floor->number_in(0, 1);
  return result;
}

Soft_walls soft(const Json_node& node) {
  node.expect_keys({"compliance", "recovery", "spread"});
  Soft_walls result;
  if (const auto compliance = node.find("compliance")) result.compliance = compliance->positive();
  if (const auto recovery = node.find("recovery")) result.recovery = recovery->number_in(0, 1);
  if (const auto spread = node.find("spread"))
    result.spread = static_cast<std::uint32_t>(spread->integer_in(0, most_spread));
  return result;
}

Tissue_material tissue(const Json_node& node) {
  node.expect_keys({"compliance", "incompressible", "tension", "damping", "yield", "sweeps"});
  Tissue_material result;
  if (const auto compliance = node.find("compliance"))
    result.compliance = compliance->number_in(0, most_compliance);
  if (const auto share = node.find("incompressible")) result.incompressible = share->number_in(0, 1);
  if (const auto tension = node.find("tension")) result.tension = tension->number_in(0, most_tension);
  if (const auto damping = node.find("damping")) result.damping = damping->number_in(0, 1);
  if (const auto yield = node.find("yield")) result.yield = yield->number_in(0, 1);
  if (const auto sweeps = node.find("sweeps"))
    result.sweeps = static_cast<std::uint32_t>(sweeps->integer_in(1, most_sweeps));
  return result;
}

Wall_relaxation relax(const Json_node& node) {
  node.expect_keys({"good_enough", "rings", "rounds", "operations", "tries"});
  Wall_relaxation result;
  if (const auto quality = node.find("good_enough")) result.good_enough = quality->number_in(0, 1);
  const auto count = [&](const char* key, std::uint64_t most, std::uint32_t& to) {
    if (const auto given = node.find(key)) to = static_cast<std::uint32_t>(given->integer_in(1, most));
  };
  count("rings", most_rings, result.rings);
  count("rounds", most_sweeps, result.rounds);
  count("operations", most_operations, result.operations);
  count("tries", most_sweeps, result.tries);
  return result;
}

template <int D>
Scene_walls<D> walls(const Json_node& node) {
  node.expect_keys({"at_contact", "fixed", "pulsation", "soft", "tissue", "motion", "relax"});
  Scene_walls<D> result;
  if (const auto at_contact = node.find("at_contact")) {
    const std::string word = at_contact->string();
    if (word != "push" && word != "stop") at_contact->fail("expected \"push\" or \"stop\"");
    result.push = word == "push";
  }
  if (const auto fixed = node.find("fixed"))
    for (const Json_node& part : fixed->elements()) result.fixed.push_back(detail::shape<D>(part));
  if (const auto p = node.find("pulsation")) result.pulsation = pulsation<D>(*p);
  if (const auto motion = node.find("motion")) {
    result.motion = motion->string();
    if (result.motion.empty()) motion->fail("expected the name of a table");
  }
  if (const auto s = node.find("soft")) result.soft = soft(*s);
  if (const auto t = node.find("tissue")) result.tissue = tissue(*t);
  if (const auto r = node.find("relax")) result.relax = relax(*r);
  if (!result.pulsation && !result.soft && !result.tissue && result.motion.empty())
    node.fail("nothing moves the walls: give \"pulsation\", \"soft\", \"tissue\" or \"motion\"");
  for (const char* key : {"pulsation", "soft"})
    if (result.tissue && node.has(key)) node.at(key).fail("tissue moves by itself: leave one of them out");
  for (const char* key : {"pulsation", "soft", "tissue", "fixed"})
    if (!result.motion.empty() && node.has(key))
      node.at(key).fail("a table, \"motion\", says alone which points move: leave one of them out");
  if (result.relax && result.motion.empty())
    node.at("relax").fail("only cells at points that follow a table, \"motion\", are relaxed: leave it out");
  return result;
}

Picture_request picture(const Json_node& node) {
  node.expect_keys({"width", "height", "toward", "up"});
  Picture_request request;
  if (const auto width = node.find("width")) request.width = static_cast<int>(width->integer_in(16, 16384));
  if (const auto height = node.find("height"))
    request.height = static_cast<int>(height->integer_in(16, 16384));
  const auto direction = [&](const char* key, std::vector<double>& to) {
    const auto given = node.find(key);
    if (!given) return;
    const auto v = given->tuple<3>();
    if (!(length(v) > 0)) given->fail("a direction cannot be zero");
    to.assign(v.begin(), v.end());
  };
  direction("toward", request.toward);
  direction("up", request.up);
  return request;
}

Scene_output output(const Json_node& node) {
  node.expect_keys({"frame_every", "picture", "motion_every"});
  Scene_output result;
  if (const auto every = node.find("frame_every"))
    result.frame_every = static_cast<std::uint32_t>(every->integer_in(0, most_steps));
  if (const auto every = node.find("motion_every"))
    result.motion_every = static_cast<std::uint32_t>(every->integer_in(0, most_steps));
  if (const auto request = node.find("picture")) {
    if (request->is_object())
      result.picture = picture(*request);
    else if (request->boolean())
      result.picture.emplace();
  }
  return result;
}

template <int D>
Scene<D> scene(const Json_node& node) {
  node.expect_keys({"dimension", "title", "environment", "particles", "bodies", "catheter", "walls", "groups",
                    "changes", "gravity", "restitution", "friction", "time_step", "steps", "output"});
  Scene<D> result;
  result.environment = environment_source(node.at("environment"));
  if (const auto title = node.find("title")) result.title = title->string();
  if (const auto particles = node.find("particles"))
    for (const Json_node& p : particles->elements()) result.particles.push_back(particle_source<D>(p));
  if (const auto bodies = node.find("bodies"))
    for (const Json_node& b : bodies->elements()) result.bodies.push_back(detail::body_start<D>(b));
  if (const auto c = node.find("catheter")) result.catheter = catheter<D>(*c);
  if (const auto w = node.find("walls")) result.walls = walls<D>(*w);
  result.changes = detail::changes<D>(node, most_steps);
  if (result.walls && (result.walls->pulsation || result.walls->soft))
    for (std::size_t i = 0; i < result.changes.list.size(); ++i)
      if (result.changes.list[i].kind == Change_kind::cut)
        node.at("changes").elements()[i].at("cut").fail(
            "a cut makes vertices that know nothing of \"pulsation\" or \"soft\": leave these out, or give "
            "\"tissue\"");
  if (result.particles.empty() && result.bodies.empty() && !result.catheter)
    node.fail("nothing moves: give \"particles\", \"bodies\" or \"catheter\"");
  if (const auto gravity = node.find("gravity")) result.gravity = gravity->template tuple<D>();
  if (const auto restitution = node.find("restitution")) result.restitution = restitution->number_in(0, 1);
  if (const auto friction = node.find("friction")) result.friction = friction->number_in(0, 1);
  if (const auto time_step = node.find("time_step")) result.time_step = time_step->positive();
  result.steps = static_cast<std::uint32_t>(node.at("steps").integer_in(1, most_steps));
  if (const auto o = node.find("output")) result.output = output(*o);
  return result;
}

}  // namespace

Any_scene parse_scene(const std::string& name, std::string_view text, const std::filesystem::path& folder) {
  const auto document = detail::parse_json(name, text);
  const Json_node root(*document, name);
  const auto dimension = root.find("dimension");
  Any_scene result;
  if (dimension && dimension->integer_in(2, 3) == 2)
    result = scene<2>(root);
  else
    result = scene<3>(root);
  std::visit(
      [&](auto& s) {
        const auto resolve = [&](auto& source) {
          if (auto* file = std::get_if<std::string>(&source)) *file = (folder / *file).string();
        };
        resolve(s.environment);
        if (auto* call = std::get_if<Import_call>(&s.environment)) {
          for (std::string* file : {&call->file, &call->cache}) *file = (folder / *file).string();
          for (std::string& file : call->obstacles) file = (folder / file).string();
        }
        for (auto& body : s.bodies) resolve(body.source);
        if (s.walls && !s.walls->motion.empty()) s.walls->motion = (folder / s.walls->motion).string();
      },
      result);
  return result;
}

std::string scene_text(const std::filesystem::path& path) { return load(path); }

Any_scene read_scene(const std::filesystem::path& path) {
  return parse_scene(path.string(), scene_text(path), path.parent_path());
}

}  // namespace cellwalk::io
