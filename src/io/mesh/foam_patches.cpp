// SPDX-License-Identifier: LGPL-3.0-or-later
// Lists of dictionaries, of which the entries that are needed are read and all others skipped.
#include "foam_patches.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

constexpr std::size_t dictionary_text = 3;  // bytes: a name and "{}"

/// Calls `entry(key)` for each entry of a dictionary, which takes what follows the key.
template <class Entry>
void for_each_entry(Foam_reader& in, const std::string& name, const Entry& entry) {
  in.expect('{', fmt::format("'{}'", shown(name)));
  while (!in.takes('}')) entry(std::string(in.token(fmt::format("'}}' of '{}'", shown(name)))));
}

/// Calls `dictionary(name)` for each of a list of dictionaries, which takes what follows the name.
template <class Dictionary>
void for_each_dictionary(Foam_reader& in, std::string_view what, const Dictionary& dictionary) {
  const std::size_t count = in.count(what);
  in.expect_room(count, what, dictionary_text);
  if (count == 0) return;
  in.expect('(', what);
  for (std::size_t i = 0; i < count; ++i) {
    if (in.takes(')')) in.fail(fmt::format("announces {} {}, and holds {}", count, what, i));
    dictionary(std::string(in.token("a name")));
  }
  in.expect(')', what);
}

}  // namespace

std::vector<Foam_patch> read_foam_patches(Foam_reader& in, std::size_t internal_faces, std::size_t faces) {
  std::vector<Foam_patch> patches;
  std::size_t end = internal_faces;
  for_each_dictionary(in, "patches", [&](const std::string& name) {
    Foam_patch patch{name, "patch"};
    std::optional<std::size_t> first, size;
    for_each_entry(in, name, [&](const std::string& key) {
      if (key == "type")
        patch.type = in.token("a type");
      else if (key == "startFace")
        first = in.count("faces before it");
      else if (key == "nFaces")
        size = in.count("faces");
      in.skip_entry();
    });
    if (!first || !size) in.fail(fmt::format("the patch '{}' has no startFace or no nFaces", shown(name)));
    patch.first = *first;
    patch.size = *size;
    if (patch.size == 0) patch.first = end;
    if (patch.first < end || patch.first > faces || patch.size > faces - patch.first)
      in.fail(fmt::format("the patch '{}' has {} faces from {} on, where {} to {} are left", shown(name),
                          patch.size, patch.first, end, faces));
    end = patch.first + patch.size;
    patches.push_back(std::move(patch));
  });
  return patches;
}

std::vector<Foam_zone> read_foam_zones(Foam_reader& in, std::string_view key, const Label_range& members) {
  std::vector<Foam_zone> zones;
  for_each_dictionary(in, "zones", [&](const std::string& name) {
    Foam_zone zone{name, {}};
    for_each_entry(in, name, [&](const std::string& entry) {
      if (entry == key) {
        if (const std::string_view type = in.token("'List<label>'"); type != "List<label>")
          in.fail(fmt::format("'{}' where 'List<label>' should be", shown(type)));
        append_labels(in, members, 1, zone.members);
      }
      in.skip_entry();
    });
    zones.push_back(std::move(zone));
  });
  return zones;
}

}  // namespace cellwalk::io
