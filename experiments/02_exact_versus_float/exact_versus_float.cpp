// SPDX-License-Identifier: LGPL-3.0-or-later
// How often kernels go wrong, judged by the oracle of the tests.
//
//   exact_versus_float -o DIR [--part walks ...] [--motions N] [--seed S] [--threads N] [--commit NAME]
#include <cellwalk/io/json_file.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "common/manifest.h"
#include "walks.h"

namespace {

using namespace cellwalk;
using namespace cellwalk::exact_float;

nlohmann::ordered_json to_json(const Exact_summary& s) {
  return {{"motions", s.motions}, {"by_exact_kernels", s.walks}, {"wrong", s.wrong}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Counts wrong walks and sweeps of exact and rounded kernels");
  std::string folder, commit = "unknown";
  std::vector<std::string> parts{"walks"};
  Run_options walks{{}, 1, 1000};
  std::size_t threads = 1;
  app.add_option("-o,--out", folder, "folder for the tables and manifest.json")->required();
  app.add_option("--part", parts, "what to run")->check(CLI::IsMember({"walks"}));
  app.add_option("--motions", walks.motions, "at each point of the grid")->check(CLI::PositiveNumber);
  app.add_option("--seed", walks.seed, "of everything");
  app.add_option("--threads", threads, "tables do not depend on it")->check(CLI::Range(1, 1024));
  app.add_option("--commit", commit, "what the manifest names as the source");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    walks.folder = folder;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    nlohmann::ordered_json manifest = experiments::manifest(commit);
    manifest["seed"] = walks.seed;
    std::uint64_t wrong = 0;
    const auto runs = [&](const char* part) {
      return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    const auto note = [&](const char* part, const Exact_summary& summary) {
      manifest["exact"][part] = to_json(summary);
      wrong += summary.wrong;
      fmt::print("{}: {} motions, {} by exact kernels, {} of them wrong\n", part, summary.motions,
                 summary.walks, summary.wrong);
    };
    if (runs("walks")) note("walks", run_walks(walks));
    io::write_json(std::filesystem::path(folder) / "manifest.json", manifest);
    return wrong == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "exact_versus_float: {}\n", error.what());
    return 1;
  }
}
