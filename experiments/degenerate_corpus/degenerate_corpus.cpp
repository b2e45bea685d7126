// SPDX-License-Identifier: LGPL-3.0-or-later
// Writes the corpus of degenerate motions (docs/corpus.md), or answers it with Cellwalk.
//
//   degenerate_corpus --out DIR
//   degenerate_corpus --in DIR --answers FILE.csv [--touch pass|stop]
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/io/mesh_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>

#include "answers.h"
#include "makers.h"

namespace cellwalk::corpus {
namespace {

// In each dimension.
constexpr std::size_t walks = 220, sweeps = 220, faces = 150, moving_walls = 120;

void write_lines(const std::filesystem::path& file, const std::vector<nlohmann::ordered_json>& lines) {
  io::Atomic_file out(file);
  for (const auto& line : lines) out.write(line.dump() + "\n");
  out.commit();
}

struct Lines {
  std::vector<nlohmann::ordered_json> worlds, walks, sweeps, faces, moving_walls;
};

template <int D>
void add_cases(const std::vector<World<D>>& worlds, const Make_maker<D>& make, const char* kind,
               std::size_t count, std::vector<nlohmann::ordered_json>& lines) {
  for (const auto& placed : make_cases<D>(worlds, make, fmt::format("{}-{}d", kind, D), count))
    lines.push_back(to_json(placed.c, kind, worlds[placed.world]));
}

template <int D>
void add_worlds(const std::filesystem::path& folder, const std::vector<World<D>>& worlds, Lines& lines) {
  for (const World<D>& world : worlds) {
    lines.worlds.push_back(to_json(world));
    io::write_ovm(folder / "worlds" / (world.name + ".ovm"), world.soup);
  }
}

template <int D>
void add_objects(const std::filesystem::path& folder, Lines& lines) {
  const std::vector<World<D>> worlds = make_worlds<D>();
  add_worlds(folder, worlds, lines);
  add_cases<D>(worlds, walk_maker<D>, "walk", walks, lines.walks);
  add_cases<D>(worlds, sweep_maker<D>, "sweep", sweeps, lines.sweeps);
  if constexpr (D == 3) add_cases<3>(worlds, face_maker, "face", faces, lines.faces);
}

template <int D>
void add_moving_walls(const std::filesystem::path& folder, Lines& lines) {
  const std::vector<World<D>> worlds = make_moving_worlds<D>();
  add_worlds(folder, worlds, lines);
  add_cases<D>(worlds, moving_wall_maker<D>, "moving_wall", moving_walls, lines.moving_walls);
}

void make(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "worlds");
  Lines lines;
  add_objects<2>(folder, lines);
  add_objects<3>(folder, lines);
  add_moving_walls<2>(folder, lines);
  add_moving_walls<3>(folder, lines);
  write_lines(folder / "worlds.jsonl", lines.worlds);
  write_lines(folder / "walks.jsonl", lines.walks);
  write_lines(folder / "sweeps.jsonl", lines.sweeps);
  write_lines(folder / "faces.jsonl", lines.faces);
  write_lines(folder / "moving_walls.jsonl", lines.moving_walls);
  fmt::print("{}: {} worlds, {} walks, {} sweeps, {} faces, {} moving walls\n", folder.string(),
             lines.worlds.size(), lines.walks.size(), lines.sweeps.size(), lines.faces.size(),
             lines.moving_walls.size());
}

}  // namespace
}  // namespace cellwalk::corpus

int main(int argc, char** argv) {
  CLI::App app("Writes the corpus of degenerate motions, or answers it with Cellwalk");
  std::string out, in, answers;
  cellwalk::Touch touch = cellwalk::Touch::pass;
  const std::map<std::string, cellwalk::Touch> touches{{"pass", cellwalk::Touch::pass},
                                                       {"stop", cellwalk::Touch::stop}};
  auto* writes = app.add_option("-o,--out", out, "folder for the corpus");
  auto* reads = app.add_option("--in", in, "folder of a corpus")->check(CLI::ExistingDirectory);
  auto* table = app.add_option("--answers", answers, "table for the answers of Cellwalk")->needs(reads);
  app.add_option("--touch", touch, "whether touches are contacts: pass (default) or stop")
      ->transform(CLI::CheckedTransformer(touches))
      ->needs(table);
  reads->needs(table)->excludes(writes);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!out.empty()) cellwalk::corpus::make(out);
    if (!answers.empty()) cellwalk::corpus::answer(in, touch, answers);
    if (out.empty() && answers.empty()) return app.exit(CLI::RequiredError("--out or --in"));
  } catch (const std::exception& e) {
    fmt::print(stderr, "degenerate_corpus: {}\n", e.what());
    return 1;
  }
  return 0;
}
