// SPDX-License-Identifier: LGPL-3.0-or-later
// The files of corpus/TARGET given to the targets, without libFuzzer: seeds of each kind, and every input
// that once was a finding.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "fuzz/move_about.h"
#include "fuzz/moves.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

struct Target {
  std::string name;
  void (*run)(std::string_view bytes);
};

const std::vector<Target> targets{
    {"ovm", ovm},           {"off", off},       {"obj", obj},       {"stl", stl},
    {"ply", ply},           {"poly", poly},     {"wkt", wkt},       {"msh", msh},
    {"foam", foam},         {"vtk", vtk},       {"csv", csv},       {"scene", scene},
    {"record", record},     {"trace", trace},   {"motion", motion}, {"gzip", gzip},
    {"compiled", compiled}, {"forged", forged}, {"build", build},   {"nonconforming", nonconforming},
    {"edits", edits},       {"moves", moves},
#ifdef CELLWALK_FUZZ_MESHING
    {"surface", surface},   {"repair", repair},
#endif
};

/// The files of a target, by name.
std::vector<std::filesystem::path> corpus(const Target& target) {
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(CELLWALK_FUZZ_CORPUS) / target.name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

void run(const Target& target, const std::filesystem::path& file) { target.run(text_of(file)); }

struct Entry {
  const Target* target;
  std::filesystem::path file;
};

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.file.string(); }

std::vector<Entry> all_entries() {
  std::vector<Entry> entries;
  for (const Target& target : targets)
    for (const auto& file : corpus(target)) entries.push_back({&target, file});
  return entries;
}

/// Names of tests have letters, digits and _.
std::string name_of(const testing::TestParamInfo<Entry>& info) {
  std::string name = info.param.target->name + "_" + info.param.file.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class Corpus : public testing::TestWithParam<Entry> {};

TEST_P(Corpus, IsReadOrRefused) { run(*GetParam().target, GetParam().file); }

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(all_entries()), name_of);

TEST(Corpora, HoldWhatIsReadAndWhatIsRefused) {
  for (const Target& target : targets) {
    SCOPED_TRACE(target.name);
    outcomes = {};
    for (const auto& file : corpus(target)) run(target, file);
    EXPECT_GT(outcomes.read, 0u);
    EXPECT_GT(outcomes.refused, 0u);
  }
}

TEST(Corpora, AreJudgedByOracles) {
  for (const char* name : {"build", "edits"}) {
    SCOPED_TRACE(name);
    const auto target =
        std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.name == name; });
    const Judged before = judged();
    for (const auto& file : corpus(*target)) run(*target, file);
    EXPECT_GT(judged().places, before.places + 20);
    EXPECT_GT(judged().walks, before.walks + 20);
    EXPECT_GT(judged().walks_blocked, before.walks_blocked + 5);
    EXPECT_GT(judged().chains, before.chains + 5);
    EXPECT_GT(judged().sweeps, before.sweeps + 5);
    EXPECT_GT(judged().sweeps_blocked, before.sweeps_blocked);
  }
}

TEST(Corpora, MovesOfWallsAreJudged) {
  const Judged_moves before = judged_moves();
  for (const auto& file : corpus({"moves", moves})) moves(text_of(file));
  const Judged_moves& after = judged_moves();
  EXPECT_GT(after.moves, before.moves + 50);
  EXPECT_GT(after.reached, before.reached + 20);
  EXPECT_GT(after.touching, before.touching + 5);
  EXPECT_GT(after.contacts, before.contacts + 5);
  EXPECT_GT(after.pushed, before.pushed);
  EXPECT_GT(after.stopped, before.stopped);
}

}  // namespace
}  // namespace cellwalk::fuzz
