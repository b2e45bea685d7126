// SPDX-License-Identifier: LGPL-3.0-or-later
// Values of a scene replaced by KEY=VALUE.
#include <cellwalk/internal/io/scene.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cellwalk::io {
namespace {

using nlohmann::json;

constexpr const char* changed_scene = R"({ // a comment
  "environment": {"generate": "hexes", "cells": [10, 10, 10]}, "steps": 5,
  "bodies": [{"shape": "box", "count": 3}, {"shape": "hexahedron", "count": 4}]})";

json changed(const std::vector<std::string>& changes) {
  return json::parse(change_scene("s.json", changed_scene, changes));
}

TEST(SceneOverrides, ReplaceValues) {
  json expected = json::parse(changed_scene, nullptr, true, true);
  EXPECT_EQ(changed({}), expected);
  expected["environment"]["cells"] = {46, 46, 47};
  expected["bodies"][1]["count"] = 225;
  expected["title"] = "Many = more";
  expected["bodies"][0]["material"]["mode"] = "linear";
  expected["output"]["picture"] = false;
  EXPECT_EQ(changed({"environment.cells=[46,46,47]", "bodies[1].count=225", "title=Many = more",
                     "bodies[0].material.mode=\"linear\"", "output.picture=false"}),
            expected);
  expected["bodies"][0]["count"] = 0.5;
  EXPECT_EQ(changed({"environment.cells=[46,46,47]", "bodies[1].count=7", "bodies[1].count=225",
                     "title=Many = more", "bodies[0]={\"shape\":\"box\"}", "bodies[0].count=0.5",
                     "bodies[0].material.mode=linear", "output={\"picture\":false}"}),
            expected)
      << "one after the other";
}

/// A key of many names.
std::string key_of(std::size_t names) {
  std::string key = "a";
  while (--names > 0) key += ".a";
  return key;
}

TEST(SceneOverrides, MayBeAsDeepAsAFile) {
  const std::string changed = io::change_scene("in", "{}", std::vector{key_of(63) + "=[1]"});
  EXPECT_EQ(io::change_scene("in", changed, {}), changed);
}

TEST(SceneOverrides, AreRefusedWhereTheyMakeNoSense) {
  const std::string nested = "list=" + std::string(100000, '[');
  const std::string deep_key = key_of(100000) + "=1", deep_sum = key_of(63) + "=[[1]]";
  const std::pair<const char*, const char*> refusals[] = {
      {"steps", "steps: no key"},
      {"=5", "=5: no key"},
      {"title=\x80", "a change: is not written in UTF-8"},
      {"a\nb", "a?b: no key"},
      {nested.c_str(),
       "list=[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[...: more than 64 lists and objects within each other"},
      {deep_key.c_str(),
       "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a....: more than 64 lists and objects within each other"},
      {deep_sum.c_str(),
       "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a....: more than 64 lists and objects within each other"},
      {"bodies[2].count=1", "bodies[2].count=1: there is no element 2"},
      {"steps[0]=1", "steps[0]=1: there is no element 0"},
      {"bodies[1=1", "bodies[1=1: ] is missing"},
      {"bodies[-1]=1", "bodies[-1]=1: expected an index in []"},
      {"bodies[1x]=1", "bodies[1x]=1: expected an index in []"},
      {"steps.of=1", "steps.of=1: what the key leads through is not an object"},
      {"bodies.count=1", "bodies.count=1: what the key leads through is not an object"},
      {"environment..cells=1", "environment..cells=1: a key is empty"},
      {"environment.=1", "environment.=1: a key is empty"},
      {"bodies[0].=1", "bodies[0].=1: a key is empty"},
      {"bodies[0]count=1", "bodies[0]count=1: a dot is missing after ]"},
  };
  for (const auto& [change, message] : refusals) {
    try {
      changed({change});
      ADD_FAILURE() << "accepted: " << change;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Error_code::usage);
      EXPECT_EQ(error.what(), std::string(message) + "; give KEY=VALUE, as environment.cells=[10,10,10]");
    }
  }
  const std::vector<std::string> change{"steps=1"};
  EXPECT_THROW(change_scene("s.json", "{", change), Error);
}

}  // namespace
}  // namespace cellwalk::io
