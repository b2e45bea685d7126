// SPDX-License-Identifier: LGPL-3.0-or-later
// The option --version: the program, its optional parts and their versions.
#include <cellwalk/internal/io/build_features.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/internal/ranks/ranks.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <CGAL/version.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "cli/common/command.h"
#include "cli/common/machine.h"
#include "cli/common/viewer_page.h"

namespace cellwalk::cli {
namespace {

/// A part of the program that a build may lack, or that has versions.
struct Part {
  std::string_view name;
  bool present;
  std::string version;  ///< empty if it is absent, or has none of its own
  std::string_view purpose;
};

std::vector<Part> parts() {
  const Mesher_parts mesher = mesher_parts();
  std::vector<Part> all{{"cgal", true, CGAL_VERSION_STR, "map and exact arithmetic"},
                        {"meshing", mesher.meshing, "", "surfaces and polygons to environments (GPL)"},
                        {"tetgen", mesher.tetgen, "", "tetrahedra that keep a surface exactly (AGPL)"}};
  for (const io::Build_feature& feature : io::build_features())
    all.push_back({feature.name, feature.present, feature.version, feature.purpose});
  const std::string mpi = mpi_version();
  all.push_back({"mpi", !mpi.empty(), mpi, "work shared among the processes of mpirun (Open MPI)"});
  all.push_back({"viewer", !viewer_page.empty(), "", "pages that replay a run (three.js)"});
  return all;
}

std::string as_text() {
  std::string text = "cellwalk " CELLWALK_VERSION;
  for (const Part& part : parts())
    text += fmt::format("\n  {:<8} {:<8} {}", part.name,
                        !part.present          ? "no"
                        : part.version.empty() ? "yes"
                                               : part.version,
                        part.purpose);
  return text;
}

nlohmann::ordered_json as_json() {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Part& part : parts())
    all[std::string(part.name)] = {
        {"present", part.present},
        {"version", part.version.empty() ? nullptr : nlohmann::ordered_json(part.version)},
        {"purpose", part.purpose}};
  nlohmann::ordered_json json = machine_json();
  json.erase("cpu");  // a property of the machine, not of the program
  json["parts"] = all;
  return json;
}

}  // namespace

void add_version(CLI::App& app) {
  const auto taken_below = [](const CLI::results_t&) { return true; };
  CLI::Option* const json =
      app.add_option("--json", taken_below, "With --version: print it as JSON, or write that to FILE too")
          ->type_name("[FILE]")
          ->expected(0, 1);
  CLI::Option* const version = app.set_version_flag(
      "--version",
      [json, &app] {
        // CLI11 calls this before it checks for unknown arguments.
        if (const auto unknown = app.remaining(true); !unknown.empty())
          throw Error(Error_code::usage, unknown.front() + " is not known here; see cellwalk --help");
        if (json->count() == 0) return as_text();
        const std::string path = json->results().front();
        if (path.empty()) return as_json().dump(2);
        io::write_json(path, as_json());
        return as_text();
      },
      "Print the version and the optional parts of this build");
  json->needs(version);
}

}  // namespace cellwalk::cli
