// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes, balls and planes as conditions, and the kinds of changes with their keys.
#include "environment_changes.h"

#include <array>
#include <string>
#include <utility>

namespace cellwalk::io::detail {
namespace {

constexpr std::array<std::pair<const char*, Change_kind>, change_kind_count> kinds{
    {{"open", Change_kind::open},
     {"close", Change_kind::close},
     {"excavate", Change_kind::excavate},
     {"fill", Change_kind::fill},
     {"cut", Change_kind::cut},
     {"sew", Change_kind::sew}}};

template <int D>
Scene_shape<D> box_or_ball(const Json_node& node) {
  if (node.has("box") == node.has("ball")) node.fail("expected either \"box\" or \"ball\"");
  if (const auto box = node.find("box")) {
    const auto corners = box->elements();
    if (corners.size() != 2) box->fail("expected the lower and the upper corner");
    const Scene_box<D> result{corners[0].tuple<D>(), corners[1].tuple<D>()};
    for (std::size_t k = 0; k < D; ++k)
      if (result.lower[k] > result.upper[k])
        box->fail("the first corner is the lower one in all coordinates");
    return result;
  }
  const auto parts = node.at("ball").elements();
  if (parts.size() != 2) node.at("ball").fail("expected the centre and the radius");
  return Scene_ball<D>{parts[0].tuple<D>(), parts[1].positive()};
}

template <int D>
Environment_part<D> conditions(const Json_node& node) {
  if (!node.is_object()) node.fail("expected an object with \"box\", \"ball\" or \"plane\"");
  node.expect_keys({"box", "ball", "plane"});
  Environment_part<D> result;
  if (node.has("box") || node.has("ball")) result.shape = box_or_ball<D>(node);
  if (const auto plane = node.find("plane")) {
    const auto parts = plane->elements();
    if (parts.size() != 2) plane->fail("expected a point of it and its normal");
    result.plane = Scene_plane<D>{parts[0].tuple<D>(), parts[1].tuple<D>()};
    const Vector<D>& normal = result.plane->normal;
    if (!(dot(normal, normal) > 0)) plane->fail("a normal cannot be zero");
  }
  if (!result.shape && !result.plane) node.fail("expected \"box\", \"ball\" or \"plane\"");
  return result;
}

template <int D>
Blade_stroke<D> blade(const Json_node& node) {
  node.expect_keys(D == 3 ? std::initializer_list<std::string_view>{"blade", "sweep", "opening"}
                          : std::initializer_list<std::string_view>{"blade", "opening"});
  Blade_stroke<D> result;
  const Json_node points = node.at("blade");
  for (const Json_node& x : points.elements()) result.points.push_back(x.tuple<D>());
  if (const auto sweep = node.find("sweep")) {
    result.sweep = sweep->tuple<D>();
    if (!(dot(*result.sweep, *result.sweep) > 0)) sweep->fail("a displacement cannot be zero");
  }
  const std::size_t least = D == 3 && !result.sweep ? 3 : 2;
  if (result.points.size() < least)
    points.fail("expected at least " + std::to_string(least) + " points" +
                (least == 3 ? " of a polygon; for a line, give \"sweep\" as well" : ""));
  if (const auto opening = node.find("opening")) result.opening = opening->positive();
  return result;
}

template <int D>
Environment_change<D> change(const Json_node& node, std::uint64_t most_steps) {
  if (most_steps == 0)
    node.expect_keys({"open", "close", "excavate", "fill", "cut", "sew"});
  else
    node.expect_keys({"step", "until", "open", "close", "excavate", "fill", "cut", "sew"});
  Environment_change<D> result;
  std::size_t found = 0;
  for (const auto& [key, kind] : kinds) {
    const auto part = node.find(key);
    if (!part) continue;
    ++found;
    result.kind = kind;
    if (kind == Change_kind::cut) {
      result.blade = blade<D>(*part);
      continue;
    }
    if (!part->is_string()) {
      result.part = conditions<D>(*part);
      continue;
    }
    if (kind == Change_kind::sew) part->fail("a group has no stitches: give \"box\", \"ball\" or \"plane\"");
    result.part.group = part->string();
    if (result.part.group.empty()) part->fail("a group needs a name");
  }
  if (found != 1)
    node.fail("expected one of \"open\", \"close\", \"excavate\", \"fill\", \"cut\" and \"sew\"");
  if (most_steps == 0) return result;
  result.step = result.until = static_cast<std::uint32_t>(node.at("step").integer_in(1, most_steps));
  if (const auto until = node.find("until"))
    result.until = static_cast<std::uint32_t>(until->integer_in(result.step, most_steps));
  return result;
}

}  // namespace

template <int D>
Scene_shape<D> shape(const Json_node& node) {
  node.expect_keys({"box", "ball"});
  return box_or_ball<D>(node);
}

template <int D>
Environment_changes<D> changes(const Json_node& node, std::uint64_t most_steps) {
  Environment_changes<D> result;
  if (const auto groups = node.find("groups"))
    for (const std::string& name : groups->keys()) {
      if (name.empty()) groups->fail("a group needs a name");
      result.groups[name] = conditions<D>(groups->at(name));
    }
  if (const auto list = node.find("changes"))
    for (const Json_node& entry : list->elements()) result.list.push_back(change<D>(entry, most_steps));
  const auto catheter = node.find("catheter");
  const bool has_ends = catheter && (catheter->has("from") || catheter->has("to"));
  if (!result.groups.empty() && result.list.empty() && !has_ends)
    node.at("groups").fail("no change names a group: give \"changes\" as well");
  return result;
}

template Scene_shape<2> shape(const Json_node&);
template Scene_shape<3> shape(const Json_node&);
template Environment_changes<2> changes(const Json_node&, std::uint64_t);
template Environment_changes<3> changes(const Json_node&, std::uint64_t);

}  // namespace cellwalk::io::detail
