// SPDX-License-Identifier: LGPL-3.0-or-later
#include "case.h"

namespace cellwalk::corpus {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Meeting& m) {
  return {{"move", m.move},       {"time", text(m.time)}, {"rounded", rounded(m.time)},
          {"feature", m.feature}, {"walls", m.walls},     {"wall_kinds", m.wall_kinds}};
}

}  // namespace

template <int D>
std::vector<Vec> pose(const Case<D>& c, std::uint32_t move, const Rational& time) {
  std::vector<Point<D>> points = c.points;
  for (std::uint32_t m = 0; m < move && !c.moves_wall; ++m) points[c.moves[m].vertex] = c.moves[m].to;
  std::vector<Vec> result;
  for (const Point<D>& p : points) result.push_back(exact<D>(p));
  if (c.moves_wall) return result;
  Vec& moved = result[c.moves[move].vertex];
  moved = between(moved, exact<D>(c.moves[move].to), time);
  return result;
}

template <int D>
const char* convention(const Case<D>& c) {
  if (c.at_start) return "start";
  if (c.crossing == Crossing::either) return "choice";
  const bool same = c.touch.has_value() == (c.crossing == Crossing::yes) &&
                    (!c.touch || (c.touch->move == c.crossings[0].move && c.crossings.size() == 1 &&
                                  c.touch->time == c.crossings[0].time));
  return same ? "none" : "touch";
}

template <int D>
Json to_json(const Case<D>& c, const char* kind, const World<D>& world) {
  Json json{{"id", c.id}, {"kind", kind}, {"world", world.name}, {"degeneracy", c.degeneracy}};
  json["near"] = c.near.empty() ? Json() : Json(c.near);
  json["points"] = c.points;
  json["side"] = c.side.empty() ? Json() : Json(c.side);
  json["moves"] = Json::array();
  for (const Move<D>& m : c.moves) json["moves"].push_back({{"vertex", m.vertex}, {"to", m.to}});
  json["at_start"] = c.at_start;
  json["touch"] = c.touch ? to_json(*c.touch) : Json();
  json["crossing"] = crossing_names[static_cast<std::size_t>(c.crossing)];
  json["crossings"] = Json::array();
  for (const Meeting& m : c.crossings) json["crossings"].push_back(to_json(m));
  json["convention"] = convention(c);
  return json;
}

template <int D>
Json to_json(const World<D>& world) {
  Json json{{"name", world.name}, {"dimension", D}, {"vertices", world.soup.points}};
  json["walls"] = json["facets"] = json["membranes"] = json["slits"] = Json::array();
  for (std::size_t i = 0; i < world.walls.size(); ++i) {
    const Wall<D>& wall = world.walls[i];
    json["walls"].push_back(wall.corners);
    json["facets"].push_back(wall.facet);
    if (wall.kind == Wall_kind::membrane) json["membranes"].push_back(i);
    if (wall.kind == Wall_kind::slit) json["slits"].push_back(i);
  }
  return json;
}

template <int D>
Case<D> question(const Json& json) {
  Case<D> c;
  c.id = json.at("id");
  c.points = json.at("points").get<std::vector<Point<D>>>();
  c.moves_wall = json.at("kind") == "moving_wall";
  if (!json.at("side").is_null()) c.side = json.at("side").get<std::vector<Point<D>>>();
  for (const Json& m : json.at("moves"))
    c.moves.push_back({m.at("vertex").get<std::uint32_t>(), m.at("to").get<Point<D>>()});
  return c;
}

#define CELLWALK_INSTANTIATE(D)                                                      \
  template std::vector<Vec> pose<D>(const Case<D>&, std::uint32_t, const Rational&); \
  template const char* convention<D>(const Case<D>&);                                \
  template Json to_json<D>(const Case<D>&, const char*, const World<D>&);            \
  template Json to_json<D>(const World<D>&);                                         \
  template Case<D> question<D>(const Json&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::corpus
